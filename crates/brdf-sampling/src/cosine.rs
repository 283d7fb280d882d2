//! Directions in proportion to the cosine: exact for a Lambertian surface.

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
        let mut wi = Lanes3::ZERO;
        for k in 0..LANES {
            let r = u[0][k].max(0.0).sqrt();
            let (sin, cos) = sin_cos_turn(u[1][k]);
            wi.x[k] = r * cos;
            wi.y[k] = r * sin;
            wi.z[k] = (1.0 - u[0][k]).max(0.0).sqrt().max(MIN_COS as f32);
        }
        SampleLanes {
            pdf: self.pdf_lanes(&wi, wo),
            wi,
        }
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        std::array::from_fn(|k| {
            let pdf = wi.z[k].max(0.0) * std::f32::consts::FRAC_1_PI;
            if wo.z[k] > 0.0 { pdf } else { 0.0 }
        })
    }
}

/// Sine and cosine of 2 pi u for u in [0, 1]; absolute error below 3e-7, without a call.
#[inline(always)]
fn sin_cos_turn(u: f32) -> (f32, f32) {
    // the nearest quarter turn, and Taylor polynomials over the eighth on either side
    let q = (4.0 * u + 0.5) as i32;
    let x = std::f32::consts::TAU * (u - 0.25 * q as f32);
    let z = x * x;
    let s =
        x + x * z * (-1.666_666_6e-1 + z * (8.333_332e-3 + z * (-1.984_087_5e-4 + z * 2.752_5e-6)));
    let c = 1.0 + z * (-0.5 + z * (4.166_666_6e-2 + z * (-1.388_888_6e-3 + z * 2.476_9e-5)));
    let (s, c) = if q & 1 == 1 { (c, s) } else { (s, c) };
    let s = if q & 2 == 2 { -s } else { s };
    let c = if (q + 1) & 2 == 2 { -c } else { c };
    (s, c)
}

/// The lowest cosine a sampler returns: keeps densities proportional to it positive.
const MIN_COS: f64 = 1e-12;

/// Malley's method in polar form: sin^2 theta = u.x, phi = 2 pi u.y.
pub(crate) fn cosine_hemisphere(u: DVec2) -> DVec3 {
    let s = u.x.max(0.0).sqrt();
    let (sp, cp) = (TAU * u.y).sin_cos();
    DVec3::new(s * cp, s * sp, (1.0 - u.x).max(0.0).sqrt().max(MIN_COS))
}

/// cos theta_i / pi above the horizon.
#[inline]
pub(crate) fn cosine_pdf(wi: DVec3) -> f64 {
    wi.z.max(0.0) * FRAC_1_PI
}

#[cfg(test)]
mod tests {
    use super::{Cosine, sin_cos_turn};
    use brdf::{DirectionSampler, LANES, Lanes3};
    use glam::{DVec2, Vec3};

    #[test]
    fn sine_and_cosine_of_a_turn() {
        for k in 0..=100_000 {
            let u = k as f32 / 100_000.0;
            let (s, c) = sin_cos_turn(u);
            let (es, ec) = (std::f64::consts::TAU * f64::from(u)).sin_cos();
            let error = (f64::from(s) - es).abs().max((f64::from(c) - ec).abs());
            assert!(error < 3e-7, "at {u}: off by {error:e}");
        }
    }

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
