//! Directional albedo: at most 1, exactly 1 for the white models that promise it.

use crate::cases::{examples, viewer};
use brdf_models::{MODELS, ParsedModel, parse_model};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// The directional albedo seen from `wo`, by the model's own sampler on a midpoint grid of n x n.
///
/// The integrand f cos / pdf is smooth in the sampler's numbers except where lobes change hands, so the
/// error is near 1/n of a bounded weight.
fn albedo(model: &ParsedModel<3>, wo: DVec3, n: u32) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for k in 0..n * n {
        let u = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n);
        if let Some(s) = model.built.sampler.sample(wo, u) {
            let f = model.built.brdf.eval(s.wi, wo);
            for c in 0..3 {
                sum[c] += f[c] * s.wi.z / s.pdf;
            }
        }
    }
    sum.map(|s| s / f64::from(n * n))
}

/// Largest albedo over channels, examples and angles.
fn largest(info: &'static brdf_models::ModelInfo) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for model in examples(info) {
        for theta in [0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9] {
            let a = albedo(&model, viewer(theta), 96)
                .into_iter()
                .fold(0.0, f64::max);
            if a > worst.0 {
                worst = (a, format!("{model} from {theta} deg"));
            }
        }
    }
    worst
}

#[test]
fn energy_is_conserved_or_said_not_to_be() {
    for info in MODELS {
        let (albedo, at) = largest(info);
        if info.laws.conserves_energy {
            // the grid's error
            assert!(albedo < 1.005, "{at}: albedo {albedo}");
        } else {
            assert!(
                albedo > 1.01,
                "{} conserves energy: say so in its laws ({at}: {albedo})",
                info.name
            );
        }
    }
}

/// The directional albedo of a diffuse model, by midpoints in azimuth and in t where cos = t^4: diffuse
/// models with a kink or a thin layer at grazing angles keep an error near 5/n^2 = 1.4e-5.
fn smooth_albedo(model: &ParsedModel<3>, wo: DVec3) -> f64 {
    let n = 600;
    let mut sum = 0.0;
    for j in 0..n {
        let t = (f64::from(j) + 0.5) / f64::from(n);
        let z = t.powi(4);
        let r = (1.0 - z * z).sqrt();
        for k in 0..n {
            let (sin, cos) = (TAU * (f64::from(k) + 0.5) / f64::from(n)).sin_cos();
            let f = model.built.brdf.eval(DVec3::new(r * cos, r * sin, z), wo)[0];
            sum += f * z * 4.0 * t.powi(3);
        }
    }
    sum * TAU / f64::from(n * n)
}

#[test]
fn white_furnace() {
    for text in [
        "lambert:kd=1",
        "eon:kd=1,r=0",
        "eon:kd=1,r=0.3",
        "eon:kd=1,r=1",
    ] {
        let model = parse_model(text).unwrap();
        for theta in [0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9] {
            let a = smooth_albedo(&model, viewer(theta));
            assert!((a - 1.0).abs() < 2e-5, "{text} from {theta} deg: {a}");
        }
    }
}

#[test]
fn normalisations_hold_at_normal_incidence() {
    // ks is the albedo at normal incidence by construction
    for (text, expected) in [
        ("lewis:n=20,ks=1,kd=0", 1.0),
        ("blinn-phong:n=3,ks=1,kd=0", 1.0),
        ("blinn-phong:n=500,ks=0.5,kd=0", 0.5),
        ("lafortune:n=20,ks=1,kd=0", 1.0),
    ] {
        let a = albedo(&parse_model(text).unwrap(), DVec3::Z, 256)[0];
        assert!((a - expected).abs() < 2e-3, "{text}: {a}");
    }
}
