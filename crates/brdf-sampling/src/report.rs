//! The figures by which samplers of one material are compared.

use crate::target::Target;
use crate::variance::{RelativeVariance, relative_variance_for};
use brdf::{DirectionSampler, direction};
use glam::DVec3;
use rayon::prelude::*;

/// Viewers at which a report shows the relative variance, degrees.
pub const SHOWN_DEG: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0];
/// Viewers over which it is averaged.
pub const OFF_GRID: usize = 24;

/// Elevation in degrees of viewer `k` of [`OFF_GRID`]: 1.37 to 84.4 in even steps that no grid of tables has.
#[must_use]
pub fn off_grid_deg(k: usize) -> f64 {
    1.37 + 3.61 * k as f64
}

/// A viewer: azimuth 0 for isotropic targets, else the azimuths of all viewers fill the circle evenly.
fn viewer(target: &Target<'_>, theta_deg: f64, k: usize) -> DVec3 {
    let turns = if target.symmetry.isotropic {
        0.0
    } else {
        // golden section
        (0.21 + k as f64 * 0.618_033_988_75).fract()
    };
    direction(theta_deg.to_radians(), std::f64::consts::TAU * turns)
}

/// What [`sampler_report`] finds, all by the sampler's own samples.
#[derive(Clone, Debug, PartialEq)]
pub struct SamplerReport {
    /// Elevation of the viewer in degrees, and what was measured there: [`SHOWN_DEG`].
    pub shown: Vec<(f64, RelativeVariance)>,
    /// Relative variance, mean over the [`OFF_GRID`] viewers.
    pub mean: f64,
    /// Standard error of `mean`.
    pub std_error: f64,
    /// The largest relative variance among these viewers.
    pub worst: f64,
    /// Largest weight over the mean weight among their samples: grows slowly with the number of samples.
    pub max_weight: f64,
    /// Fraction of samples that carry nothing, mean over these viewers.
    pub wasted: f64,
    /// Expected proposals a sample, mean over these viewers; 1 for all but rejection.
    pub tries_per_sample: f64,
    /// Directional albedo, mean over these viewers.
    pub albedo: f64,
    /// Bytes of tables.
    pub bytes: usize,
}

/// Draws `samples` independent directions for each of 31 viewers; rayon over viewers, the same numbers on any number of
/// threads.
#[must_use]
pub fn sampler_report(
    target: Target<'_>,
    sampler: &dyn DirectionSampler,
    samples: usize,
) -> SamplerReport {
    let angles: Vec<f64> = SHOWN_DEG
        .into_iter()
        .chain((0..OFF_GRID).map(off_grid_deg))
        .collect();
    let all: Vec<(f64, RelativeVariance, f64)> = angles
        .par_iter()
        .enumerate()
        .map(|(k, &deg)| {
            let wo = viewer(&target, deg, k);
            let found = relative_variance_for(target, sampler, wo, samples);
            (deg, found, sampler.tries_per_sample(wo))
        })
        .collect();
    let (shown, off_grid) = all.split_at(SHOWN_DEG.len());
    let mean = |f: &dyn Fn(&RelativeVariance) -> f64| {
        off_grid.iter().map(|(_, v, _)| f(v)).sum::<f64>() / OFF_GRID as f64
    };
    let largest = |f: &dyn Fn(&RelativeVariance) -> f64| {
        off_grid.iter().map(|(_, v, _)| f(v)).fold(0.0, f64::max)
    };
    SamplerReport {
        shown: shown.iter().map(|(deg, v, _)| (*deg, *v)).collect(),
        mean: mean(&|v| v.value),
        std_error: (mean(&|v| v.std_error.powi(2)) / OFF_GRID as f64).sqrt(),
        worst: largest(&|v| v.value),
        max_weight: largest(&|v| v.max_weight),
        wasted: mean(&|v| v.wasted),
        tries_per_sample: off_grid.iter().map(|(_, _, t)| t).sum::<f64>() / OFF_GRID as f64,
        albedo: mean(&|v| v.albedo),
        bytes: sampler.bytes(),
    }
}
