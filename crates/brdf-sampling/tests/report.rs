//! Reports against figures known on paper.

use brdf::{DirectionSampler, Symmetry};
use brdf_sampling::{
    Cosine, OFF_GRID, Proposal, Rejection, RejectionOptions, SHOWN_DEG, Target, Uniform,
    off_grid_deg, sampler_report,
};
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

#[test]
fn uniform_samples_of_lambert_have_a_variance_of_a_third() {
    // w = 2 cos with cos uniform: Var / mean^2 = 4/3 - 1; the largest weight is twice the mean
    let report = sampler_report(Target::new(&|_, _| 0.5 * FRAC_1_PI), &Uniform, 4_000);
    let z = (report.mean - 1.0 / 3.0) / report.std_error;
    assert!(z.abs() < 4.0, "{report:?}");
    assert!((report.std_error / report.mean) < 0.01, "{report:?}");
    assert!(report.worst > report.mean, "{report:?}");
    assert!((report.max_weight - 2.0).abs() < 0.1, "{report:?}");
    assert!((report.albedo - 0.5).abs() < 0.01, "{report:?}");
    assert_eq!(report.shown.len(), SHOWN_DEG.len(), "shown angles");
}

#[test]
fn cosine_samples_of_lambert_have_none() {
    let report = sampler_report(Target::new(&|_, _| FRAC_1_PI), &Cosine, 100);
    assert!(report.worst < 1e-20 && report.wasted <= 0.0, "{report:?}");
    assert!((report.max_weight - 1.0).abs() < 1e-9, "{report:?}");
    assert!((report.tries_per_sample - 1.0).abs() <= 0.0, "{report:?}");
    assert_eq!(report.bytes, 0, "no tables");
}

#[test]
fn rejection_tells_its_tries() {
    // uniform proposals for the cosine: maximum 1 over mean 1/2, and the 5 % its bound is inflated by
    let sampler = Rejection::new(
        Arc::new(|_: DVec3, _: DVec3| FRAC_1_PI),
        Symmetry::FULL,
        RejectionOptions {
            proposal: Proposal::Uniform,
            n_theta: 4,
            ..RejectionOptions::default()
        },
    );
    let report = sampler_report(Target::new(&|_, _| FRAC_1_PI), &sampler, 200);
    assert!((report.tries_per_sample - 2.1).abs() < 0.01, "{report:?}");
    let one = sampler.tries_per_sample(brdf::direction(
        off_grid_deg(OFF_GRID - 1).to_radians(),
        0.0,
    ));
    assert!((one - 2.1).abs() < 0.01, "{one}");
}
