//! Directions in proportion to the cosine: exact for a Lambertian surface.

use crate::lane_math;
use brdf::{DirectionSample, DirectionSampler, LANES, Lanes3, SampleLanes};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, TAU};

/// pdf = cos theta_i / pi.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cosine;

impl DirectionSampler for Cosine {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        (wo.z > 0.0).then(|| {
            let wi = cosine_hemisphere(u);
            DirectionSample {
                wi,
                pdf: cosine_pdf(wi),
            }
        })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wo.z > 0.0 { cosine_pdf(wi) } else { 0.0 }
    }

    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        let wi = lane_math::cosine_hemisphere(&u[0], &u[1]);
        SampleLanes {
            wi,
            pdf: self.pdf_lanes(&wi, wo),
        }
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            let above = wo.z[k] > 0.0;
            let pdf = wi.z[k].max(0.0) * std::f32::consts::FRAC_1_PI;
            out[k] = if above { pdf } else { 0.0 };
        }
        out
    }
}

/// The lowest cosine a sampler returns: keeps densities proportional to it positive.
const MIN_COS: f64 = 1e-12;

/// Malley's method in polar form: sin^2 theta = u.x, phi = 2 pi u.y.
#[inline(always)]
pub(crate) fn cosine_hemisphere(u: DVec2) -> DVec3 {
    let s = u.x.max(0.0).sqrt();
    let (sp, cp) = (TAU * u.y).sin_cos();
    DVec3::new(s * cp, s * sp, (1.0 - u.x).max(0.0).sqrt().max(MIN_COS))
}

/// cos theta_i / pi above the horizon.
#[inline(always)]
pub(crate) fn cosine_pdf(wi: DVec3) -> f64 {
    wi.z.max(0.0) * FRAC_1_PI
}

#[cfg(test)]
mod tests {
    use super::Cosine;
    use brdf::{DirectionSampler, LANES, Lanes3};
    use glam::{DVec2, Vec3};

    #[test]
    fn packets_agree_with_the_scalar_form() {
        let mut wo = Lanes3::ZERO;
        (0..LANES).for_each(|k| wo.set(k, Vec3::Z));
        wo.set(3, Vec3::NEG_Z);
        let u = [0, 1].map(|c| std::array::from_fn(|k| (k + c) as f32 / LANES as f32));
        let s = Cosine.sample_lanes(&wo, &u);
        for k in 0..LANES {
            let at = DVec2::new(f64::from(u[0][k]), f64::from(u[1][k]));
            match Cosine.sample(wo.get(k).as_dvec3(), at) {
                Some(exact) => {
                    let off = (exact.wi - s.wi.get(k).as_dvec3()).length();
                    let ratio = f64::from(s.pdf[k]) / exact.pdf;
                    // rounding of f32, doubled by the root near the horizon
                    assert!(
                        off < 1e-6 && (ratio - 1.0).abs() < 1e-5,
                        "{k}: {off:e} {ratio}"
                    );
                }
                None => assert!(s.pdf[k] <= 0.0, "{k}: sampled below the horizon"),
            }
        }
    }
}
