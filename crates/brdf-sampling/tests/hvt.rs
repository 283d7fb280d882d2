//! What the half-vector table promises beyond conformance: size, noise, normalisation.

use brdf::{DirectionSampler, direction};
use brdf_sampling::{Cosine, Hvt, Preset, Target, relative_variance};
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

#[test]
fn baked_reflectance_returns_its_albedo() {
    let f = lobe(0.1);
    let sampler = Hvt::new(Target::new(&f), Preset::Tiny.options());
    let wo = direction(0.8, 0.0);
    let baked = |wi: DVec3, wo: DVec3| sampler.baked(wi, wo, 0.6);
    let v = relative_variance(Target::new(&baked), &sampler, 0.8_f64.to_degrees(), 2_000);
    assert!((v.albedo - 0.6).abs() < 1e-6, "albedo {}", v.albedo);
    assert!(v.value < 1e-9, "no variance left: {}", v.value);
    assert!(sampler.baked(-wo, wo, 0.6) <= 0.0, "below the horizon");
}
