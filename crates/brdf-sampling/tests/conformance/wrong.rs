//! Samplers with one mistake each: the tests must find every one of them, in every kind.

use crate::samplers::{ALL, target};
use crate::targets::Case;
use crate::{chi_square, table_kinds, targets, viewer};
use brdf::{DirectionSample, DirectionSampler};
use brdf_sampling::{Cosine, Uniform};
use glam::{DVec2, DVec3};

/// `inner` with its density or its samples spoilt.
struct Wrong<'a> {
    inner: &'a dyn DirectionSampler,
    mistake: Mistake,
}

#[derive(Clone, Copy, Debug)]
enum Mistake {
    /// The density of the neighbouring slice.
    SliceOffByOne,
    /// Half-vector density taken for a direction density: the factor 4 (wo.h) is missing.
    NoJacobian,
    /// The density of the neighbouring slice of azimuth: both directions turned by 15 degrees.
    AzimuthOffByOne,
    /// Samples mirrored about the plane of incidence.
    Mirrored,
    /// The cosine forgotten.
    NoCosine,
    /// A cosine too many.
    ExtraCosine,
    /// The density off by a constant: the thesis' f for f / int f.
    Unnormalised,
}

impl DirectionSampler for Wrong<'_> {
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
            Mistake::AzimuthOffByOne => {
                let turn = glam::DMat3::from_rotation_z(15.0_f64.to_radians());
                self.inner.pdf(turn * wi, turn * wo)
            }
            Mistake::NoJacobian => {
                let scale = 4.0 * wo.dot((wi + wo).normalize());
                self.inner.pdf(wi, wo) * scale / 3.2
            }
            Mistake::Mirrored => self.inner.pdf(wi, wo),
            Mistake::NoCosine => Uniform.pdf(wi, wo),
            Mistake::ExtraCosine => Cosine.pdf(wi, wo),
            Mistake::Unnormalised => 0.9 * self.inner.pdf(wi, wo),
        }
    }
}

/// At least one mistake for every kind of sampler, the one its code is most likely to make.
const MISTAKES: &[(&str, &[Mistake])] = &[
    ("Uniform", &[Mistake::ExtraCosine]),
    ("Cosine", &[Mistake::NoCosine]),
    (
        "Rejection cosine",
        &[Mistake::Unnormalised, Mistake::SliceOffByOne],
    ),
    (
        "Inversion",
        &[
            Mistake::SliceOffByOne,
            Mistake::NoJacobian,
            Mistake::Mirrored,
        ],
    ),
    (
        "Hvt tiny",
        &[
            Mistake::SliceOffByOne,
            Mistake::NoJacobian,
            Mistake::Mirrored,
        ],
    ),
    ("Hvt default", &[Mistake::AzimuthOffByOne]),
    (
        "Dictionary",
        &[
            Mistake::SliceOffByOne,
            Mistake::NoJacobian,
            Mistake::Unnormalised,
        ],
    ),
    (
        "RglTable",
        &[
            Mistake::NoJacobian,
            Mistake::Mirrored,
            Mistake::Unnormalised,
        ],
    ),
];

/// What the kind is built for: RGL's own sampling needs its table.
fn case_for(name: &str) -> Case {
    if name == "RglTable" {
        let kind = table_kinds::TABLES.iter().find(|t| t.name == name);
        return kind.unwrap().build();
    }
    let mut cases = targets::all();
    // slices of azimuth need a case that turns
    let wanted = if name == "Hvt default" {
        "brushed"
    } else {
        "spiky"
    };
    cases.retain(|c| c.name == wanted);
    cases.remove(0)
}

#[test]
fn every_kind_of_sampler_has_a_mistake() {
    for entry in ALL {
        let kind = entry.name.split(' ').next();
        let found = MISTAKES.iter().any(|(n, _)| n.split(' ').next() == kind);
        assert!(found, "{} has no wrong variant", entry.name);
    }
}

#[test]
fn every_mistake_is_found_out() {
    for (name, mistakes) in MISTAKES {
        let entry = ALL.iter().find(|e| e.name == *name).unwrap();
        let sampler = (entry.build)(&case_for(name)).unwrap();
        let run = |s: &dyn DirectionSampler| chi_square(s, viewer(33.3), 6_000, 20);
        let right = run(&*sampler);
        assert!(right.ok, "{name} unspoilt passes: {right}");
        for &mistake in *mistakes {
            let wrong = Wrong {
                inner: &*sampler,
                mistake,
            };
            assert!(!run(&wrong).ok, "{name}: {mistake:?} went unnoticed");
        }
    }
}

/// The furnace sees a wrong constant as well: weights are too large by it.
#[test]
fn a_wrong_albedo_is_found_out() {
    // cosine samples of sharp ridges: a tenth of the albedo is 5 standard errors
    const N: u32 = 300_000;
    let case = &case_for("Cosine");
    let target = target(case);
    let right = brdf_sampling::relative_variance(target, &Cosine, 33.3, N as usize);
    let mut sum = 0.0;
    let mut rng = testkit::Rng::new(5);
    let wo = brdf::direction(33.3_f64.to_radians(), 0.0);
    for _ in 0..N {
        let s = Cosine.sample(wo, DVec2::from(rng.uniform2())).unwrap();
        sum += target.f_cos(s.wi, wo) / (0.9 * s.pdf);
    }
    // both sides are estimates
    let std_error = right.albedo * (2.0 * right.value / f64::from(N)).sqrt();
    let verdict = testkit::z_test(sum / f64::from(N), std_error, right.albedo);
    assert!(verdict.p_value < 1e-3, "{verdict:?}");
}
