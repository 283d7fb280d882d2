//! The wavelengths that paths carry in hero sampling.

use super::channels::Channels;
use brdf::{HERO, ROTATIONS, RotatedTable};
use spectrum::{Basis, Bins, Spectrum};
use std::sync::Arc;
use tracer::{Hero, HeroEmission};

/// Where the density 1/cosh^2(A (lambda - B)), an approximation of what the eye sees, is highest, nm, and how narrow
/// it is, 1/nm [RadziszewskiPbrt2009].
const PEAK_NM: f64 = 538.0;
const NARROW: f64 = 0.0072;
/// What the observer sees, nm.
const RANGE_NM: [f64; 2] = [360.0, 830.0];

/// Bins of equal probability, `HERO * ROTATIONS` of them: from 0.5 nm wide at the peak to 8 nm in the far red.
pub(super) fn basis() -> Basis {
    let n = HERO * ROTATIONS;
    let [from, to] = RANGE_NM.map(|nm| (NARROW * (nm - PEAK_NM)).tanh());
    let edge = |k: usize| {
        let u = from + (to - from) * (k as f64 / n as f64);
        PEAK_NM + u.atanh() / NARROW
    };
    let edges = (0..=n).map(edge).collect();
    // ascending and finite: the visible range alone would be left otherwise
    Basis::Bins(Bins::new(edges).unwrap_or_else(|_| Bins::visible(n)))
}

/// Values of the bins of [`basis`] by rotation: rotation r carries the bins r, r + ROTATIONS, ..
pub(super) fn rotated(values: &[f64]) -> RotatedTable {
    std::array::from_fn(|r| {
        std::array::from_fn(|c| values.get(c * ROTATIONS + r).map_or(0.0, |v| *v as f32))
    })
}

/// The middle of each bin, nm.
pub(super) fn wavelengths(basis: &Basis) -> [[f64; HERO]; ROTATIONS] {
    let centres: Vec<f64> = match basis {
        Basis::Bins(bins) => bins.centres_nm().collect(),
        _ => Vec::new(),
    };
    std::array::from_fn(|r| {
        std::array::from_fn(|c| centres.get(c * ROTATIONS + r).copied().unwrap_or(PEAK_NM))
    })
}

/// Films of linear sRGB: each rotation stands for all [`ROTATIONS`].
pub(super) fn mode(channels: &Channels) -> Hero {
    let n = ROTATIONS as f64;
    let of = |r: usize, c: usize| {
        let weights = channels.to_srgb().get(c * ROTATIONS + r);
        weights.map_or([0.0; 3], |w| w.map(|v| (n * v) as f32))
    };
    Hero::new(Arc::new(std::array::from_fn(|r| {
        std::array::from_fn(|c| of(r, c))
    })))
}

/// A light of this power.
pub(super) fn emission(channels: &Channels, power: &Spectrum) -> HeroEmission {
    HeroEmission::Table(Arc::new(rotated(&channels.emission(power))))
}

#[cfg(test)]
mod tests {
    use super::super::light::daylight;
    use super::*;

    #[test]
    fn rotations_share_the_visible_range() {
        let lambda_nm = wavelengths(&basis());
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
        let channels = Channels::new(basis(), &daylight());
        let white = channels.emission(&daylight());
        let total: [f64; 3] = std::array::from_fn(|c| {
            let all = white.iter().zip(channels.to_srgb());
            all.map(|(v, w)| v * w[c]).sum()
        });
        for v in total {
            assert!((v - 1.0).abs() < 1e-9, "{total:?}");
        }
    }
}
