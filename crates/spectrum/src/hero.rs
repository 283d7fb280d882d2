//! Wavelengths for paths: drawn by what an eye sees of them, several at once [Wilkie2014].

use crate::{Observer, Outside, Spectrum, Viewing};

/// A density of wavelengths within a range: 1/cosh^2(0.0072 (l - 538 nm)), near to what the three colour-matching
/// functions ask for together [Radziszewski2009], for a light with lines times how much brighter it is than around.
///
/// In t = tanh(0.0072 (l - 538 nm)) the first factor is constant. The second is tabulated there, linear between knots,
/// so that the cumulative density is a parabola between them and is inverted exactly.
///
/// A path carries C wavelengths that are C equal steps of the quantile apart ([`Self::rotated`]): each is distributed
/// like this, and the C of them are stratified. The estimate is the mean over them of contribution/pdf. That is
/// multiple importance sampling over which of the wavelengths led the path: in the quantile all C rotations have
/// density 1, so the balance heuristic gives the wavelength c the weight q(X|l_c)/sum_k q(X|l_k) for a path X of
/// density q; where q does not depend on wavelength, as in gonio, that is 1/C.
#[derive(Clone, Debug, PartialEq)]
pub struct WavelengthDensity {
    knots: Vec<Knot>,
}

/// The density up to a value of t.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    t: f64,
    /// Density in t.
    density: f64,
    /// Part of the whole below t.
    below: f64,
}

/// 1/nm.
const A: f64 = 0.0072;
/// nm.
const CENTRE_NM: f64 = 538.0;
/// What counts as around a wavelength: means over this width, taken twice, nm. Of 60, 80 and 120 nm this left the least
/// noise under F2 and F11.
const AROUND_NM: f64 = 80.0;
/// How many rotations [`WavelengthDensity::white_noise`] looks at.
const LOOKS: u32 = 512;

impl WavelengthDensity {
    /// Over the range of an observer, for light that is the same at all wavelengths.
    #[must_use]
    pub fn new(observer: &Observer) -> Self {
        let [from, to] = observer.range_nm();
        Self::tabulated(&[(from, 1.0), (to, 1.0)])
    }

    /// Over the range of an observer, for this light: the one of [`Self::new`] and [`Self::for_lines`] under which
    /// [`Self::white_noise`] is less.
    #[must_use]
    pub fn for_light(observer: &Observer, light: &Spectrum) -> Self {
        let even = Self::new(observer);
        let Some(lines) = Self::for_lines(observer, light) else {
            return even;
        };
        let viewing = Viewing::new(light, observer);
        let noise = |d: &Self| d.white_noise(&viewing, observer);
        if noise(&lines) < noise(&even) {
            lines
        } else {
            even
        }
    }

    /// Times the light over its mean around each wavelength: lines are met as often as they are bright, and the parts of
    /// the spectrum keep the shares the eye gives them. Zero where the light is; `None` for light that is dark or
    /// negative.
    #[must_use]
    pub fn for_lines(observer: &Observer, light: &Spectrum) -> Option<Self> {
        let range = observer.range_nm();
        let around = box_means(&box_means(light, range)?, range)?;
        let mut knots: Vec<f64> = (around.lambda_nm().iter().chain(light.lambda_nm()))
            .copied()
            .filter(|nm| (range[0]..=range[1]).contains(nm))
            .collect();
        knots.sort_unstable_by(f64::total_cmp);
        knots.dedup();
        let relative = |nm: f64| match light.at(nm) {
            0.0 => 0.0,
            power if power < 0.0 => f64::NAN,
            power => power / around.at(nm),
        };
        let rows: Vec<_> = knots.into_iter().map(|nm| (nm, relative(nm))).collect();
        let wrong = |v: f64| !(v >= 0.0 && v.is_finite());
        if rows.iter().any(|(_, v)| wrong(*v)) || rows.iter().all(|(_, v)| *v == 0.0) {
            return None;
        }
        Some(Self::tabulated(&rows))
    }

    fn tabulated(rows: &[(f64, f64)]) -> Self {
        let mut knots: Vec<Knot> = Vec::with_capacity(rows.len());
        for &(nm, density) in rows {
            let t = (A * (nm - CENTRE_NM)).tanh();
            let below = knots
                .last()
                .map_or(0.0, |k| k.below + 0.5 * (k.density + density) * (t - k.t));
            knots.push(Knot { t, density, below });
        }
        let whole = knots.last().map_or(1.0, |k| k.below);
        for knot in &mut knots {
            knot.density /= whole;
            knot.below /= whole;
        }
        Self { knots }
    }

    /// The two knots around what `key` finds; the outermost beyond the ends.
    fn around(&self, key: impl Fn(&Knot) -> bool) -> [Knot; 2] {
        let last = self.knots.len() - 1;
        let k = self.knots.partition_point(key).clamp(1, last);
        [self.knots[k - 1], self.knots[k]]
    }

    /// The density at a wavelength of the range, per nm.
    #[must_use]
    pub fn pdf(&self, lambda_nm: f64) -> f64 {
        let x = A * (lambda_nm - CENTRE_NM);
        let t = x.tanh();
        let [a, b] = self.around(|k| k.t <= t);
        let slope = (b.density - a.density) / (b.t - a.t);
        // dt/dl = A/cosh^2
        (a.density + slope * (t - a.t)) * A / x.cosh().powi(2)
    }

    /// The part of the density below a wavelength of the range: the inverse of [`Self::quantile`].
    #[must_use]
    pub fn cumulative(&self, lambda_nm: f64) -> f64 {
        let t = (A * (lambda_nm - CENTRE_NM)).tanh();
        let [a, b] = self.around(|k| k.t <= t);
        let (x, slope) = (t - a.t, (b.density - a.density) / (b.t - a.t));
        a.below + (a.density + 0.5 * slope * x) * x
    }

    /// The wavelength, nm, below which the part `u` in [0, 1] lies.
    #[must_use]
    pub fn quantile(&self, u: f64) -> f64 {
        // parts of no light are passed over: the first knot above u
        let [a, b] = self.around(|k| k.below <= u);
        let (rest, slope) = (u - a.below, (b.density - a.density) / (b.t - a.t));
        // density x + slope x^2/2 = rest, in the form that does not cancel
        let root = (a.density * a.density + 2.0 * slope * rest).max(0.0).sqrt();
        let sum = a.density + root;
        let x = if sum > 0.0 { 2.0 * rest / sum } else { 0.0 };
        CENTRE_NM + (a.t + x).min(b.t).atanh() / A
    }

    /// `C` wavelengths: that of `u` in [0, 1) and those 1/C, 2/C, .. further, round.
    #[must_use]
    pub fn rotated<const C: usize>(&self, u: f64) -> [f64; C] {
        std::array::from_fn(|c| self.quantile((u + c as f64 / C as f64).fract()))
    }

    /// Relative variances of X, Y and Z of white, added up: what eight wavelengths a path leave of noise, by quadrature.
    #[must_use]
    pub fn white_noise(&self, viewing: &Viewing, observer: &Observer) -> f64 {
        let seen = |k: u32| {
            let nm = self.rotated::<8>((f64::from(k) + 0.5) / f64::from(LOOKS));
            let weights = self.xyz_weights(nm, viewing, observer);
            weights
                .iter()
                .fold([0.0; 3], |sum, w| std::array::from_fn(|c| sum[c] + w[c]))
        };
        let (mut mean, mut square) = ([0.0; 3], [0.0; 3]);
        for xyz in (0..LOOKS).map(seen) {
            for c in 0..3 {
                mean[c] += xyz[c] / f64::from(LOOKS);
                square[c] += xyz[c] * xyz[c] / f64::from(LOOKS);
            }
        }
        let variance = |c: usize| square[c] / (mean[c] * mean[c]) - 1.0;
        // a light without blue, say, has no noise there
        (0..3).filter(|&c| mean[c] > 0.0).map(variance).sum()
    }

    /// What one unit of reflectance at each of `C` wavelengths adds to XYZ, so that the expectation over `u` of the sum
    /// is [`Viewing::xyz`]: light times colour-matching function/(C pdf), with Y = 1 for white.
    #[must_use]
    pub fn xyz_weights<const C: usize>(
        &self,
        lambda_nm: [f64; C],
        viewing: &Viewing,
        observer: &Observer,
    ) -> [[f64; 3]; C] {
        lambda_nm.map(|nm| {
            let k = viewing.light().at(nm) / (C as f64 * self.pdf(nm) * viewing.white_y());
            observer.at(nm).map(|v| v * k)
        })
    }
}

/// Means over [`AROUND_NM`] by 1 nm, of what is within the range; `None` if it is not finite.
fn box_means(spectrum: &Spectrum, [from, to]: [f64; 2]) -> Option<Spectrum> {
    let mean = |nm: f64| {
        let half = 0.5 * AROUND_NM;
        spectrum.mean([(nm - half).max(from), (nm + half).min(to)])
    };
    let knots: Vec<f64> = (0..=(to - from) as u32)
        .map(|k| from + f64::from(k))
        .collect();
    let means = knots.iter().map(|nm| mean(*nm)).collect();
    Spectrum::new(knots, means, Outside::Hold).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Illuminant;
    use testkit::{assert_close, assert_relative};

    const EYE: Observer = Observer::CIE_1931;

    #[test]
    fn density_integrates_to_one_and_is_that_of_the_quantile() {
        let d = WavelengthDensity::new(&EYE);
        let steps = 4700;
        let sum: f64 = (0..steps)
            .map(|k| d.pdf(360.05 + 0.1 * f64::from(k)) * 0.1)
            .sum();
        assert_close(sum, 1.0, 1e-7, "total");
        // a published renderer's constants for the same density [Pharr2023, 4.5.4]
        assert_relative(d.pdf(538.0), 0.0039398042, 1e-7, "peak");
        for u in [0.0, 0.1, 0.5, 0.97, 1.0] {
            assert_close(d.cumulative(d.quantile(u)), u, 1e-13, "inverse");
        }
        assert_close(d.quantile(0.0), 360.0, 1e-10, "first");
        assert_close(d.quantile(1.0), 830.0, 1e-9, "last");
    }

    #[test]
    fn rotations_are_apart_by_equal_parts() {
        let d = WavelengthDensity::new(&EYE);
        let mut parts = d.rotated::<8>(0.3).map(|nm| d.cumulative(nm));
        parts.sort_by(f64::total_cmp);
        for (k, part) in parts.iter().enumerate() {
            assert_close(*part, 0.05 + 0.125 * k as f64, 1e-12, "part");
        }
    }

    /// Mean and relative variance of X, Y, Z over u, by quadrature.
    fn moments<const C: usize>(
        d: &WavelengthDensity,
        viewing: &Viewing,
        reflectance: &Spectrum,
    ) -> [[f64; 2]; 3] {
        let steps = 4096;
        let (mut mean, mut square) = ([0.0; 3], [0.0; 3]);
        for k in 0..steps {
            let nm = d.rotated::<C>((f64::from(k) + 0.5) / f64::from(steps));
            let weights = d.xyz_weights(nm, viewing, &EYE);
            for c in 0..3 {
                let x: f64 = (0..C).map(|j| weights[j][c] * reflectance.at(nm[j])).sum();
                mean[c] += x / f64::from(steps);
                square[c] += x * x / f64::from(steps);
            }
        }
        std::array::from_fn(|c| [mean[c], square[c] / mean[c].powi(2) - 1.0])
    }

    #[test]
    fn for_a_light_density_and_quantile_go_together() {
        for light in [Illuminant::D65, Illuminant::F11, Illuminant::A] {
            let spectrum = light.spectrum();
            let d = WavelengthDensity::for_lines(&EYE, &spectrum).unwrap();
            let steps = 4700;
            let middle = |k: i32| 360.05 + 0.1 * f64::from(k);
            let sum: f64 = (0..steps).map(|k| d.pdf(middle(k)) * 0.1).sum();
            assert_close(sum, 1.0, 1e-4, "total");
            for k in 0..=997 {
                let u = f64::from(k) / 997.0;
                assert_close(d.cumulative(d.quantile(u)), u, 1e-12, "inverse");
            }
        }
    }

    #[test]
    fn lines_are_met_and_the_dark_between_them_is_not() {
        let knots = vec![449.0, 450.0, 451.0, 599.0, 600.0, 601.0];
        let lines =
            Spectrum::new(knots, vec![0.0, 1.0, 0.0, 0.0, 1.0, 0.0], Outside::Zero).unwrap();
        let d = WavelengthDensity::for_light(&EYE, &lines);
        for k in 0..1000 {
            let nm = d.quantile((f64::from(k) + 0.5) / 1000.0);
            assert!(lines.at(nm) > 0.0, "{nm} nm is dark");
        }
        for dark in [Spectrum::constant(0.0), Spectrum::constant(-1.0)] {
            assert!(WavelengthDensity::for_lines(&EYE, &dark).is_none());
            assert_eq!(
                WavelengthDensity::for_light(&EYE, &dark),
                WavelengthDensity::new(&EYE)
            );
        }
    }

    #[test]
    fn expectation_is_the_exact_colour() {
        let knots = vec![400.0, 450.0, 530.0, 700.0];
        let r = Spectrum::new(knots, vec![0.1, 0.9, 0.2, 0.5], Outside::Hold).unwrap();
        for light in [Illuminant::D65, Illuminant::F11] {
            let spectrum = light.spectrum();
            let viewing = Viewing::new(&spectrum, &EYE);
            let exact = viewing.xyz(&r);
            for d in [
                WavelengthDensity::new(&EYE),
                WavelengthDensity::for_lines(&EYE, &spectrum).unwrap(),
            ] {
                let [one, eight] = [
                    moments::<1>(&d, &viewing, &r),
                    moments::<8>(&d, &viewing, &r),
                ];
                for c in 0..3 {
                    // 4096 midpoints of a function with kinks
                    assert_relative(one[c][0], exact[c], 2e-5, "one");
                    assert_relative(eight[c][0], exact[c], 2e-5, "eight");
                }
            }
        }
    }

    #[test]
    fn eight_rotations_leave_little_noise() {
        // docs/colour.md: the noise of X, Y, Z from wavelengths alone, of grey and of a red
        let flat = Spectrum::constant(1.0);
        let red = crate::LinearUplift::spectrum([0.5, 0.1, 0.05]);
        let lights = [
            Illuminant::D65,
            Illuminant::A,
            Illuminant::F2,
            Illuminant::F11,
        ];
        for light in lights {
            let spectrum = light.spectrum();
            let viewing = Viewing::new(&spectrum, &EYE);
            let even = WavelengthDensity::new(&EYE);
            let chosen = WavelengthDensity::for_light(&EYE, &spectrum);
            for (name, r) in [("flat", &flat), ("red", &red)] {
                let show = |what: &str, m: [[f64; 2]; 3]| {
                    let [x, y, z] = m.map(|m| m[1]);
                    println!("{light} {name} {what}: {x:.2e} {y:.2e} {z:.2e}");
                    [x, y, z]
                };
                let before = show("even, C = 8", moments::<8>(&even, &viewing, r));
                show("chosen, C = 1", moments::<1>(&chosen, &viewing, r));
                show("chosen, C = 4", moments::<4>(&chosen, &viewing, r));
                let after = show("chosen, C = 8", moments::<8>(&chosen, &viewing, r));
                let lines = matches!(light, Illuminant::F2 | Illuminant::F11);
                assert_eq!(chosen != even, lines, "{light}");
                for c in 0..3 {
                    assert!(after[c] < 0.03, "{light} {name}, {c}: {}", after[c]);
                    // smooth lights are left alone
                    assert!(lines || (after[c] - before[c]).abs() == 0.0, "{light} {c}");
                }
                if light == Illuminant::F11 {
                    let less = |c: usize| after[c] < 0.1 * before[c];
                    assert!((0..3).all(less), "{name}: {after:?} after {before:?}");
                }
            }
        }
    }
}
