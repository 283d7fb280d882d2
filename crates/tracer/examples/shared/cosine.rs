//! The usual sampler of diffuse surfaces, in a few lines.

use brdf::{DirectionSample, DirectionSampler};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Density cos / pi.
pub(crate) struct Cosine;

impl DirectionSampler for Cosine {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let (sin, cos) = (2.0 * PI * u.y).sin_cos();
        let (r, z) = (u.x.sqrt(), (1.0 - u.x).sqrt());
        let wi = DVec3::new(r * cos, r * sin, z);
        (wo.z > 0.0 && z > 0.0).then_some(DirectionSample { wi, pdf: z / PI })
    }
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wo.z > 0.0 { wi.z.max(0.0) / PI } else { 0.0 }
    }
}
