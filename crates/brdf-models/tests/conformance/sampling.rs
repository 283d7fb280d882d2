//! Samplers against their densities.

use crate::cases::{VIEWERS_DEG, all, examples, pair, viewer};
use brdf::{DirectionSample, DirectionSampler};
use brdf_models::{Fresnel, Ggx, MODELS};
use glam::{DVec2, DVec3};
use testkit::chi2::{self, Chi2Report, Config};

fn chi_square(
    sampler: &dyn DirectionSampler,
    wo: DVec3,
    samples: usize,
    tests: usize,
) -> Chi2Report {
    let config = Config {
        samples,
        seed: 17,
        tests,
        ..Config::default()
    };
    chi2::test(
        &config,
        |rng| sampler.sample(wo, pair(rng)).map(|s| s.wi.to_array()),
        |wi| sampler.pdf(DVec3::from_array(wi), wo),
    )
}

fn check_all(viewers: &[f64], samples: usize) {
    let tests = all().count() * viewers.len();
    for model in all() {
        for &theta in viewers {
            let report = chi_square(&*model.built.sampler, viewer(theta), samples, tests);
            assert!(report.ok, "{model} from {theta} deg: {report}");
            if model.info.laws.sampler_complete {
                // quadrature of the density, 1e-4 a cell
                assert!(
                    (report.integral - 1.0).abs() < 2e-3,
                    "{model} from {theta} deg: {report}"
                );
            }
        }
    }
}

#[test]
fn samplers_follow_their_densities() {
    check_all(&[35.0, 88.0], 10_000);
}

#[test]
fn slow_samplers_follow_their_densities() {
    check_all(&[0.0, 10.0, 35.0, 60.0, 80.0, 88.0, 89.9], 200_000);
}

#[test]
fn incomplete_samplers_do_lose_directions() {
    for info in MODELS.iter().filter(|m| !m.laws.sampler_complete) {
        let mut rng = testkit::Rng::new(3);
        let mut lost = 0;
        for model in examples(info) {
            let draws = (0..2000).map(|_| model.built.sampler.sample(viewer(88.0), pair(&mut rng)));
            lost += draws.filter(Option::is_none).count();
        }
        assert!(lost > 0, "{} loses nothing: say so in its laws", info.name);
    }
}

#[test]
fn a_sample_carries_its_density_and_weight() {
    for model in all() {
        let mut rng = testkit::Rng::new(5);
        for theta in VIEWERS_DEG {
            let wo = viewer(theta);
            for _ in 0..300 {
                let Some(DirectionSample { wi, pdf }) =
                    model.built.sampler.sample(wo, pair(&mut rng))
                else {
                    continue;
                };
                assert!(
                    wi.z > 0.0 && (wi.length() - 1.0).abs() < 1e-9,
                    "{model}: {wi}"
                );
                let again = model.built.sampler.pdf(wi, wo);
                assert!(
                    (pdf / again - 1.0).abs() < 1e-12,
                    "{model} at {theta}: {pdf} {again}"
                );
                let f = model.built.brdf.eval(wi, wo);
                assert!(
                    f.iter().all(|v| (v * wi.z / pdf).is_finite()),
                    "{model} at {theta}: {f:?}"
                );
            }
        }
    }
}

#[test]
fn nothing_is_sampled_from_below() {
    for model in all() {
        for wo in [DVec3::X, -DVec3::Z, DVec3::new(0.6, 0.0, -0.8)] {
            let up = DVec3::new(0.0, 0.6, 0.8);
            assert!(
                model.built.sampler.sample(wo, DVec2::splat(0.4)).is_none(),
                "{model} from {wo}"
            );
            for (a, b) in [(up, wo), (wo, up)] {
                assert_eq!(
                    model.built.sampler.pdf(a, b).to_bits(),
                    0,
                    "{model}: {a} {b}"
                );
                assert_eq!(
                    model.built.brdf.eval(a, b).map(f64::to_bits),
                    [0; 3],
                    "{model}: {a} {b}"
                );
            }
        }
    }
}

/// Samples one roughness and claims the density of another, 10 % off.
struct WrongRoughness(Ggx<1>, Ggx<1>);

impl DirectionSampler for WrongRoughness {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        self.0.sample(wo, u)
    }
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.1.pdf(wi, wo)
    }
}

#[test]
fn a_wrong_sampler_is_found_out() {
    let ggx = |alpha| Ggx::isotropic(alpha, Fresnel::ONE);
    let right = chi_square(
        &WrongRoughness(ggx(0.3), ggx(0.3)),
        viewer(35.0),
        10_000,
        100,
    );
    assert!(right.ok, "{right}");
    let wrong = chi_square(
        &WrongRoughness(ggx(0.3), ggx(0.33)),
        viewer(35.0),
        10_000,
        100,
    );
    assert!(!wrong.ok, "{wrong}");
}
