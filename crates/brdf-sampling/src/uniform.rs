//! Directions uniform over the hemisphere: the yardstick nothing should lose against.

use brdf::{DirectionSample, DirectionSampler};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// pdf = 1 / (2 pi) above the horizon.
#[derive(Clone, Copy, Debug, Default)]
pub struct Uniform;

impl DirectionSampler for Uniform {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        (wo.z > 0.0).then(|| DirectionSample {
            wi: uniform_hemisphere(u),
            pdf: 1.0 / TAU,
        })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wo.z > 0.0 && wi.z > 0.0 {
            1.0 / TAU
        } else {
            0.0
        }
    }
}

/// Archimedes: the height is uniform. z = 1 - u.x is never 0 because u.x < 1.
pub(crate) fn uniform_hemisphere(u: DVec2) -> DVec3 {
    let z = 1.0 - u.x;
    let s = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let (sp, cp) = (TAU * u.y).sin_cos();
    DVec3::new(s * cp, s * sp, z)
}
