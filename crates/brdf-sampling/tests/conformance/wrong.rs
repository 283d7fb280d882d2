//! Samplers with one mistake each: the tests must find every one of them.

use crate::samplers::target;
use crate::{chi_square, targets, viewer};
use brdf::{DirectionSample, DirectionSampler};
use brdf_sampling::{Cosine, Inversion, InversionOptions, Uniform};
use glam::{DVec2, DVec3};

/// `inner` with its density or its samples spoilt.
struct Wrong<S> {
    inner: S,
    mistake: Mistake,
}

#[derive(Clone, Copy)]
enum Mistake {
    /// The density of the neighbouring slice.
    SliceOffByOne,
    /// Half-vector density taken for a direction density: the factor 4 (wo.h) is missing.
    NoJacobian,
    /// Samples mirrored about the plane of incidence.
    Mirrored,
    /// The cosine forgotten.
    NoCosine,
}

impl<S: DirectionSampler> DirectionSampler for Wrong<S> {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let mut s = self.inner.sample(wo, u)?;
        if let Mistake::Mirrored = self.mistake {
            let side = DVec3::new(-wo.y, wo.x, 0.0).normalize_or_zero();
            s.wi -= 2.0 * s.wi.dot(side) * side;
        }
        Some(s)
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        match self.mistake {
            Mistake::SliceOffByOne => {
                let phi = wo.y.atan2(wo.x);
                let theta = (wo.z.acos() - 6.0_f64.to_radians()).max(0.0);
                self.inner.pdf(wi, brdf::direction(theta, phi))
            }
            Mistake::NoJacobian => {
                let scale = 4.0 * wo.dot((wi + wo).normalize());
                self.inner.pdf(wi, wo) * scale / 3.2
            }
            Mistake::Mirrored => self.inner.pdf(wi, wo),
            Mistake::NoCosine => Uniform.pdf(wi, wo),
        }
    }
}

fn found_out(inner: impl DirectionSampler, mistake: Mistake) -> bool {
    let wrong = Wrong { inner, mistake };
    !chi_square(&wrong, viewer(33.3), 6_000, 5).ok
}

#[test]
fn every_mistake_is_found_out() {
    let cases = targets::all();
    let spiky = cases.iter().find(|c| c.name == "spiky").unwrap();
    let options = InversionOptions {
        n_theta: 16,
        n_a: 24,
        n_b: 12,
        ..InversionOptions::default()
    };
    let inversion = Inversion::new(target(spiky), options);
    let right = chi_square(&inversion, viewer(33.3), 6_000, 5);
    assert!(right.ok, "the unspoilt sampler passes: {right}");
    for (name, mistake) in [
        ("slice", Mistake::SliceOffByOne),
        ("Jacobian", Mistake::NoJacobian),
        ("mirror", Mistake::Mirrored),
    ] {
        assert!(
            found_out(inversion.clone(), mistake),
            "{name} went unnoticed"
        );
    }
    assert!(
        found_out(Cosine, Mistake::NoCosine),
        "cosine went unnoticed"
    );
}
