//! Materials and small scenes the tests share.

use brdf::{Brdf, DirectionSample, DirectionSampler, LANES, Lanes3, Paired, SampleLanes};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use tracer::{Camera, Description, Film, Object, Scene, Settings, Shape};

/// The same reflectance everywhere: albedo / pi.
#[derive(Clone, Copy, Debug)]
pub struct Lambert(pub f64);

impl Brdf<1> for Lambert {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 1] {
        [if wi.z > 0.0 && wo.z > 0.0 { self.0 / PI } else { 0.0 }]
    }
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; 1] {
        let f = (self.0 / PI) as f32;
        [std::array::from_fn(|k| if wi.z[k] > 0.0 && wo.z[k] > 0.0 { f } else { 0.0 })]
    }
}

/// Directions in proportion to the cosine.
#[derive(Clone, Copy, Debug)]
pub struct Cosine;

impl DirectionSampler for Cosine {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let (r, phi) = (u.x.sqrt(), 2.0 * PI * u.y);
        let wi = DVec3::new(r * phi.cos(), r * phi.sin(), (1.0 - u.x).max(0.0).sqrt());
        (wo.z > 0.0 && wi.z > 0.0).then_some(DirectionSample { wi, pdf: wi.z / PI })
    }
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z > 0.0 && wo.z > 0.0 { wi.z / PI } else { 0.0 }
    }
}

/// A Lambert surface with some gloss: (1 - g) albedo / pi + g times a cosine lobe about the normal's half vector.
#[derive(Clone, Copy, Debug)]
pub struct Glossy;

impl Brdf<1> for Glossy {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 1] {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return [0.0];
        }
        let h = (wi + wo).normalize();
        [0.3 / PI + 1.5 * h.z.powi(60)]
    }
}

/// Lambert with cosine sampling.
pub fn grey(albedo: f64) -> Box<Paired<Lambert, Cosine>> {
    Box::new(Paired {
        brdf: Lambert(albedo),
        sampler: Cosine,
    })
}

/// A camera at `eye` that looks at `target`, y up, with a narrow view.
pub fn camera(eye: [f64; 3], target: [f64; 3], fov: f64) -> Camera {
    Camera {
        eye: eye.into(),
        target: target.into(),
        up: DVec3::new(0.0, 1.0, 1e-3),
        vertical_fov_deg: fov,
    }
}
