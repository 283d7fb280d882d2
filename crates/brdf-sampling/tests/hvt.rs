//! What the half-vector table promises beyond conformance: size, noise, normalisation.

use brdf::{Brdf, DirectionSampler, direction};
use brdf_sampling::{BakedHvt, Cosine, Hvt, Preset, Target, relative_variance, sampler_report};
use glam::DVec3;
use testkit::{Domain, integrate};

/// A GGX-like lobe over a diffuse floor.
fn lobe(width: f64) -> impl Fn(DVec3, DVec3) -> f64 + Sync {
    move |wi: DVec3, wo: DVec3| {
        let h = wi + wo;
        let q = 1.0 + (h.x * h.x + h.y * h.y) / (width * width * h.z * h.z);
        0.05 + 0.3 / (width * width * q * q)
    }
}

#[test]
fn presets_keep_their_bytes_and_noise() {
    // limits: twice what was measured, so that a worse optimum shows and a different seed does not
    for (preset, bytes, limit) in [
        (Preset::Tiny, 2_000, 0.08),
        (Preset::Default, 10_000, 0.006),
        (Preset::Fine, 50_000, 0.0015),
    ] {
        for width in [0.01, 0.3] {
            let f = lobe(width);
            let target = Target::new(&f);
            let sampler = Hvt::new(target, preset.options());
            assert!(
                sampler.bytes() <= bytes,
                "{preset:?}: {} bytes",
                sampler.bytes()
            );
            for theta in [3.0, 37.0, 68.0] {
                let v = relative_variance(target, &sampler, theta, 20_000);
                let name = format!("{preset:?} at width {width}, {theta} degrees: {v:?}");
                assert!(v.value < limit, "{name}");
                assert!(v.wasted <= 0.0, "{name}");
                assert!(v.max_weight < 8.0, "{name}");
            }
        }
    }
}

#[test]
fn density_integrates_to_one() {
    // narrower lobes outrun the budget of the quadrature, not the table
    for width in [0.1, 0.5] {
        let f = lobe(width);
        let sampler = Hvt::new(Target::new(&f), Preset::Tiny.options());
        for theta in [0.0_f64, 31.0, 72.0, 87.0] {
            let wo = direction(theta.to_radians(), 0.4);
            let pdf = |wi: [f64; 3]| sampler.pdf(DVec3::from(wi), wo);
            let e = integrate::adaptive(Domain::Hemisphere, pdf, 1e-6);
            assert!(
                (e.value - 1.0).abs() < 1e-4 + e.error,
                "width {width}, {theta} degrees: {e:?}"
            );
        }
    }
}

#[test]
fn black_gives_the_cosine() {
    let sampler = Hvt::new(Target::new(&|_, _| 0.0), Preset::Tiny.options());
    let (wi, wo) = (direction(0.7, 0.3), direction(0.2, 2.0));
    let ratio = sampler.pdf(wi, wo) / Cosine.pdf(wi, wo);
    // nodes at their floor hold a thousandth
    assert!((ratio - 1.0).abs() < 0.02, "ratio {ratio}");
}

/// Two channels of different colour: a warm body and a white lobe.
#[derive(Clone, Copy)]
struct Glossy;

impl Brdf<2> for Glossy {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 2] {
        let shine = lobe(0.1)(wi, wo) - 0.05;
        [0.15 + 0.1 * shine, 0.05 + 0.1 * shine]
    }
}

#[test]
fn baked_reflectance_has_no_variance_and_the_albedo_of_its_target() {
    let luminance = |wi: DVec3, wo: DVec3| {
        let f = Glossy.eval(wi, wo);
        0.5 * (f[0] + f[1])
    };
    let target = Target::new(&luminance);
    let baked = BakedHvt::new(&Glossy, Hvt::new(target, Preset::Default.options()));
    assert!(!baked.symmetry().reciprocal, "not reciprocal");
    for theta in [3.0, 41.0, 77.0] {
        for c in 0..2 {
            let (of_baked, of_target) = (
                |wi: DVec3, wo: DVec3| baked.eval(wi, wo)[c],
                |wi: DVec3, wo: DVec3| Glossy.eval(wi, wo)[c],
            );
            let v = relative_variance(Target::new(&of_baked), baked.sampler(), theta, 4_000);
            // sample and pdf agree to 1e-6
            assert!(v.value < 1e-11, "channel {c} at {theta}: {v:?}");
            let exact = relative_variance(Target::new(&of_target), baked.sampler(), theta, 40_000);
            let error = exact.albedo * (exact.value / 40_000.0).sqrt();
            // the table of albedos is linear between two degrees
            let off = (v.albedo - exact.albedo).abs();
            assert!(off < 4.0 * error + 2e-3 * exact.albedo, "{off} at {theta}");
        }
        // the systematic error is the exact mode's relative variance
        let error = |wi: DVec3, wo: DVec3| {
            let (b, f) = (baked.eval(wi, wo), Glossy.eval(wi, wo));
            0.5 * (b[0] + b[1] - f[0] - f[1]).abs()
        };
        let exact = relative_variance(target, baked.sampler(), theta, 20_000);
        let off = relative_variance(Target::new(&error), baked.sampler(), theta, 20_000);
        let relative = off.albedo.powi(2) * (1.0 + off.value) / exact.albedo.powi(2);
        assert!(
            (relative / exact.value - 1.0).abs() < 0.1,
            "{relative}, {exact:?}"
        );
    }
    let (up, down) = (direction(0.4, 0.2), direction(2.0, 0.1));
    assert!(
        baked.eval(down, up)[0] <= 0.0 && baked.eval(up, down)[0] <= 0.0,
        "horizon"
    );
}

/// A brushed surface: a lobe four times as wide across as along, over a diffuse floor.
fn brushed(wi: DVec3, wo: DVec3) -> f64 {
    let h = wi + wo;
    let q = 1.0 + ((h.x / 0.05).powi(2) + (h.y / 0.2).powi(2)) / (h.z * h.z);
    0.05 + 10.0 / (q * q)
}

#[test]
fn slices_of_azimuth_follow_anisotropy() {
    let mut target = Target::new(&brushed);
    target.symmetry.isotropic = false;
    let sampler = Hvt::new(target, Preset::Default.options());
    // the half turn that brushed surfaces have was found
    assert_eq!(sampler.slices(), [12, 12], "slices");
    let mean = |wi: DVec3, wo: DVec3| {
        let turned = |k: u32| {
            let turn = glam::DMat3::from_rotation_z(f64::from(k) * std::f64::consts::FRAC_PI_4);
            brushed(turn * wi, turn * wo)
        };
        (0..8).map(turned).sum::<f64>() / 8.0
    };
    let averaged = Hvt::new(Target::new(&mean), Preset::Default.options());
    let (four, three) = (
        sampler_report(target, &sampler, 1_000),
        sampler_report(target, &averaged, 1_000),
    );
    assert!(four.mean < 0.15 * three.mean, "{four:?} against {three:?}");
    assert!(four.wasted <= 0.0, "{four:?}");
}
