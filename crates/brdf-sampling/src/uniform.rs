//! Directions uniform over the hemisphere: the yardstick nothing should lose against.

use crate::lane_math::sin_cos_turns;
use brdf::{DirectionSample, DirectionSampler, LANES, Lanes3, SampleLanes};
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

    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        let mut wi = Lanes3::ZERO;
        for k in 0..LANES {
            let z = 1.0 - u[0][k];
            let s = (u[0][k] * (1.0 + z)).max(0.0).sqrt();
            let (sin, cos) = sin_cos_turns(u[1][k]);
            (wi.x[k], wi.y[k], wi.z[k]) = (s * cos, s * sin, z);
        }
        SampleLanes {
            wi,
            pdf: self.pdf_lanes(&wi, wo),
        }
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            let above = (wi.z[k] > 0.0) & (wo.z[k] > 0.0);
            out[k] = if above {
                1.0 / std::f32::consts::TAU
            } else {
                0.0
            };
        }
        out
    }
}

/// Archimedes: the height is uniform. z = 1 - u.x is never 0 because u.x < 1.
pub(crate) fn uniform_hemisphere(u: DVec2) -> DVec3 {
    let z = 1.0 - u.x;
    let s = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let (sp, cp) = (TAU * u.y).sin_cos();
    DVec3::new(s * cp, s * sp, z)
}
