//! Wavelengths for paths: drawn by what an eye sees of them, several at once [Wilkie2014].

use crate::{Observer, Viewing};

/// A density of wavelengths proportional to 1/cosh^2(0.0072 (l - 538 nm)) within a range [Radziszewski2009]: near to
/// what the three colour-matching functions ask for together.
///
/// A path carries C wavelengths that are C equal steps of the quantile apart ([`Self::rotated`]): each is distributed
/// like this, and the C of them are stratified. The estimate is the mean over them of contribution/pdf. That is
/// multiple importance sampling over which of the wavelengths led the path: in the quantile all C rotations have
/// density 1, so the balance heuristic gives the wavelength c the weight q(X|l_c)/sum_k q(X|l_k) for a path X of
/// density q; where q does not depend on wavelength, as in gonio, that is 1/C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WavelengthDensity {
    low: f64,
    span: f64,
}

/// 1/nm.
const A: f64 = 0.0072;
/// nm.
const CENTRE_NM: f64 = 538.0;

impl WavelengthDensity {
    /// Over the range of an observer.
    #[must_use]
    pub fn new(observer: &Observer) -> Self {
        let [from, to] = observer.range_nm().map(|nm| (A * (nm - CENTRE_NM)).tanh());
        Self {
            low: from,
            span: to - from,
        }
    }

    /// The density at a wavelength, per nm; not zero outside of the range.
    #[must_use]
    pub fn pdf(&self, lambda_nm: f64) -> f64 {
        A / (A * (lambda_nm - CENTRE_NM)).cosh().powi(2) / self.span
    }

    /// The part of the density below a wavelength: the inverse of [`Self::quantile`].
    #[must_use]
    pub fn cumulative(&self, lambda_nm: f64) -> f64 {
        ((A * (lambda_nm - CENTRE_NM)).tanh() - self.low) / self.span
    }

    /// The wavelength, nm, below which the part `u` in [0, 1] lies.
    #[must_use]
    pub fn quantile(&self, u: f64) -> f64 {
        CENTRE_NM + (self.low + u * self.span).atanh() / A
    }

    /// `C` wavelengths: that of `u` in [0, 1) and those 1/C, 2/C, .. further, round.
    #[must_use]
    pub fn rotated<const C: usize>(&self, u: f64) -> [f64; C] {
        std::array::from_fn(|c| self.quantile((u + c as f64 / C as f64).fract()))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Illuminant, Outside, Spectrum};
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
    fn moments<const C: usize>(viewing: &Viewing, reflectance: &Spectrum) -> [[f64; 2]; 3] {
        let d = WavelengthDensity::new(&EYE);
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
    fn expectation_is_the_exact_colour() {
        let knots = vec![400.0, 450.0, 530.0, 700.0];
        let r = Spectrum::new(knots, vec![0.1, 0.9, 0.2, 0.5], Outside::Hold).unwrap();
        for light in [Illuminant::D65, Illuminant::F11] {
            let viewing = Viewing::new(&light.spectrum(), &EYE);
            let exact = viewing.xyz(&r);
            let [one, eight] = [moments::<1>(&viewing, &r), moments::<8>(&viewing, &r)];
            for c in 0..3 {
                // 4096 midpoints of a function with kinks
                assert_relative(one[c][0], exact[c], 1e-5, "one");
                assert_relative(eight[c][0], exact[c], 1e-5, "eight");
            }
        }
    }

    #[test]
    fn eight_rotations_leave_little_noise() {
        // docs/colour.md: the noise of X, Y, Z from wavelengths alone, a flat reflectance under D65
        let flat = Spectrum::constant(1.0);
        let viewing = Viewing::standard();
        let by_count = [
            moments::<1>(&viewing, &flat),
            moments::<4>(&viewing, &flat),
            moments::<8>(&viewing, &flat),
        ];
        for (count, m) in [1, 4, 8].iter().zip(&by_count) {
            println!("C = {count}: {:.4} {:.4} {:.4}", m[0][1], m[1][1], m[2][1]);
        }
        for c in 0..3 {
            assert!(
                by_count[2][c][1] < 0.02,
                "C = 8, channel {c}: {}",
                by_count[2][c][1]
            );
            assert!(by_count[2][c][1] < 0.2 * by_count[1][c][1], "channel {c}");
        }
    }
}
