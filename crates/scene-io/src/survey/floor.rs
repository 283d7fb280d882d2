//! The least variance that any one density can have over all channels.

use brdf::{Brdf, DirectionSampler};
use glam::{DVec2, DVec3};
use sampling::{PointSet, Points};

/// Points a viewer, a power of two.
const POINTS: u32 = 1 << 14;

/// J* = (int sqrt(mean_c (g_c / a_c)^2) dwi)^2 - 1 for the viewer `wo`: the relative variance, mean over channels, of
/// the density that has the least (docs/sampling.md, Several channels). Channels that reflect nothing do not count.
///
/// Integrated over Sobol' points through `sampler`, whose samples normalise each channel themselves: the mean of
/// sqrt(mean_c x_c^2) of numbers x_c with mean 1 is at least 1, so that the result is never negative.
pub(super) fn colour_floor(brdf: &dyn Brdf<3>, sampler: &dyn DirectionSampler, wo: DVec3) -> f64 {
    let points = Points::new(PointSet::Sobol, 0);
    let weights: Vec<[f64; 3]> = (0..POINTS)
        .filter_map(|k| {
            let u = points.get2(0, k, 0).map(f64::from);
            let s = sampler.sample(wo, DVec2::from(u))?;
            let f = brdf.eval(s.wi, wo);
            Some(f.map(|v| v.max(0.0) * s.wi.z.max(0.0) / s.pdf))
        })
        .collect();
    let n = weights.len() as f64;
    let albedo = [0, 1, 2].map(|c| weights.iter().map(|w| w[c]).sum::<f64>() / n);
    let lit = albedo.iter().filter(|a| **a > 0.0).count();
    if lit == 0 {
        return 0.0;
    }
    let size = |w: &[f64; 3]| {
        let shares = w.iter().zip(albedo).filter(|(_, a)| *a > 0.0);
        let squares: f64 = shares.map(|(v, a)| (v / a).powi(2)).sum();
        (squares / lit as f64).sqrt()
    };
    let mean = weights.iter().map(size).sum::<f64>() / n;
    (mean * mean - 1.0).max(0.0)
}
