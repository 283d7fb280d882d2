//! The wavelengths that paths carry in hero sampling.

use super::channels::Channels;
use super::light::LightSum;
use brdf::{HERO, ROTATIONS, rotated};
use spectrum::{Basis, Bins, Observer, Spectrum, WavelengthDensity};
use std::sync::Arc;
use tracer::{Hero, HeroEmission};

/// Bins of equal probability under the density that suits the lights, and a wavelength for each; under daylight from 0.5
/// nm wide at the peak to 8 nm in the far red.
pub(super) struct HeroChannels {
    pub(super) channels: Channels,
    /// The middle of each bin by probability, nm, by rotation.
    pub(super) lambda_nm: [[f64; HERO]; ROTATIONS],
}

impl HeroChannels {
    pub(super) fn new(lights: &LightSum) -> Self {
        let density = WavelengthDensity::for_light(&Observer::CIE_1931, &lights.shape());
        let n = HERO * ROTATIONS;
        let at = |u: f64| density.quantile(u / n as f64);
        let edges = (0..=n).map(|k| at(k as f64)).collect();
        // ascending and finite: the visible range alone would be left otherwise
        let bins = Bins::new(edges).unwrap_or_else(|_| Bins::visible(n));
        let lambda_nm =
            std::array::from_fn(|r| std::array::from_fn(|c| at((c * ROTATIONS + r) as f64 + 0.5)));
        Self {
            channels: Channels::new(Basis::Bins(bins), &lights.reference()),
            lambda_nm,
        }
    }

    /// Films of linear sRGB: each rotation stands for all [`ROTATIONS`].
    pub(super) fn mode(&self) -> Hero {
        let n = ROTATIONS as f64;
        let of = |r: usize, c: usize| {
            let weights = self.channels.to_srgb().get(c * ROTATIONS + r);
            weights.map_or([0.0; 3], |w| w.map(|v| (n * v) as f32))
        };
        Hero::new(Arc::new(std::array::from_fn(|r| {
            std::array::from_fn(|c| of(r, c))
        })))
    }

    /// A light of this power.
    pub(super) fn emission(&self, power: &Spectrum) -> HeroEmission {
        HeroEmission::Table(Arc::new(rotated(&self.channels.emission(power))))
    }
}

#[cfg(test)]
mod tests {
    use super::super::light::daylight;
    use super::*;
    use spectrum::Illuminant;

    fn under(power: Spectrum) -> HeroChannels {
        let mut lights = LightSum::default();
        lights.add(power);
        HeroChannels::new(&lights)
    }

    #[test]
    fn rotations_share_the_visible_range() {
        let lambda_nm = under(daylight()).lambda_nm;
        let mut all = lambda_nm.as_flattened().to_vec();
        all.sort_by(f64::total_cmp);
        assert_eq!(all.len(), HERO * ROTATIONS);
        assert!(all[0] > 360.0 && all[all.len() - 1] < 830.0, "{all:?}");
        let widest = all.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
        assert!(widest < 9.0, "{widest} nm");
        for own in lambda_nm {
            assert!(own.is_sorted(), "{own:?}");
            let visible = own.iter().filter(|nm| (420.0..680.0).contains(*nm)).count();
            assert!(visible >= 4, "{own:?}");
        }
    }

    #[test]
    fn the_mean_over_rotations_is_the_colour_of_the_light() {
        let hero = under(daylight());
        let white = hero.channels.emission(&daylight());
        let total: [f64; 3] = std::array::from_fn(|c| {
            let all = white.iter().zip(hero.channels.to_srgb());
            all.map(|(v, w)| v * w[c]).sum()
        });
        for v in total {
            assert!((v - 1.0).abs() < 1e-9, "{total:?}");
        }
    }

    /// Relative variance of X, Y, Z of white over the rotations.
    fn noise(hero: &HeroChannels) -> [f64; 3] {
        let xyz = hero.channels.to_xyz();
        let of = |r: usize, c: usize| -> f64 { (0..HERO).map(|k| xyz[k * ROTATIONS + r][c]).sum() };
        std::array::from_fn(|c| {
            let n = ROTATIONS as f64;
            let mean = (0..ROTATIONS).map(|r| of(r, c)).sum::<f64>() / n;
            let square = (0..ROTATIONS).map(|r| of(r, c).powi(2)).sum::<f64>() / n;
            square / (mean * mean) - 1.0
        })
    }

    #[test]
    fn lines_are_met_by_every_rotation() {
        // docs/colour.md: 0.36, 0.43 and 0.46 under F11 with the density of daylight
        for (light, limit) in [
            (Illuminant::F11, [0.003, 0.004, 0.03]),
            (Illuminant::F2, [0.003, 0.001, 0.03]),
            (Illuminant::D65, [0.001, 0.0002, 0.006]),
        ] {
            let found = noise(&under(light.spectrum()));
            println!("{light}: {found:?}");
            assert!((0..3).all(|c| found[c] < limit[c]), "{light}: {found:?}");
        }
    }

    #[test]
    fn a_weak_lamp_with_lines_counts_beside_strong_daylight() {
        let mut lights = LightSum::default();
        lights.add(daylight().scaled(1e3));
        lights.add(Illuminant::F11.spectrum().scaled(1e-6));
        let hero = HeroChannels::new(&lights);
        let near = |nm: f64| {
            hero.lambda_nm
                .as_flattened()
                .iter()
                .filter(|l| (*l - nm).abs() < 5.0)
                .count()
        };
        // the green line of F11, 11 nm away from where it has little
        assert!(
            near(546.0) > 2 * near(565.0),
            "{} and {}",
            near(546.0),
            near(565.0)
        );
    }
}
