//! The chi-square test must accept right samplers and reject wrong ones.

use std::f64::consts::PI;
use testkit::chi2::{Config, Fault, test};
use testkit::{Domain, Rng};

fn cosine(rng: &mut Rng) -> [f64; 3] {
    let [u, v] = rng.uniform2();
    let (r, (s, c)) = (u.sqrt(), (2.0 * PI * v).sin_cos());
    [r * c, r * s, (1.0 - u).sqrt()]
}

/// Phong lobe about a tilted axis, over the whole sphere.
fn tilted_lobe(rng: &mut Rng, n: f64, axis: [f64; 3]) -> [f64; 3] {
    let [u, v] = rng.uniform2();
    let z = (1.0 - u).powf(1.0 / (n + 1.0));
    let (r, (s, c)) = ((1.0 - z * z).sqrt(), (2.0 * PI * v).sin_cos());
    let (st, ct) = (axis[0], axis[2]);
    [ct * r * c + st * z, r * s, ct * z - st * r * c]
}

fn tilted_pdf(p: [f64; 3], n: f64, axis: [f64; 3]) -> f64 {
    let cos = p[0] * axis[0] + p[2] * axis[2];
    (n + 1.0) / (2.0 * PI) * cos.max(0.0).powf(n)
}

#[test]
fn accepts_cosine() {
    let report = test(
        &Config::default(),
        |r| Some(cosine(r)),
        |p| p[2].max(0.0) / PI,
    );
    assert!(report.ok, "{report}");
    assert!(report.dof > 100, "{report}");
}

#[test]
fn rejects_cosine_claiming_uniform() {
    let report = test(&Config::default(), |r| Some(cosine(r)), |_| 0.5 / PI);
    assert_eq!(report.fault, Some(Fault::Distribution), "{report}");
}

#[test]
fn rejects_a_density_too_large_by_one_percent() {
    let report = test(
        &Config::default(),
        |r| Some(cosine(r)),
        |p| 1.01 * p[2].max(0.0) / PI,
    );
    assert_eq!(report.fault, Some(Fault::Integral), "{report}");
}

#[test]
fn rejects_a_density_too_small_by_one_percent() {
    let report = test(
        &Config::default(),
        |r| Some(cosine(r)),
        |p| 0.99 * p[2].max(0.0) / PI,
    );
    assert_eq!(report.fault, Some(Fault::Distribution), "{report}");
}

#[test]
fn accepts_narrow_lobes_off_the_axis() {
    // 8 degrees, 0.8 degrees, 0.08 degrees; a lobe across the seam phi = pi
    for n in [100.0, 1e4, 1e6] {
        for theta in [0.3_f64, -0.9] {
            let axis = [theta.sin(), 0.0, theta.cos()];
            let config = Config {
                domain: Domain::Sphere,
                tests: 6,
                ..Config::default()
            };
            let report = test(
                &config,
                |r| Some(tilted_lobe(r, n, axis)),
                |p| tilted_pdf(p, n, axis),
            );
            assert!(report.ok, "n {n}, theta {theta}: {report}");
            assert!(report.dof > 100, "n {n}, theta {theta}: {report}");
        }
    }
}

#[test]
fn rejects_a_narrow_lobe_of_slightly_wrong_width() {
    let axis = [0.3_f64.sin(), 0.0, 0.3_f64.cos()];
    let config = Config {
        domain: Domain::Sphere,
        ..Config::default()
    };
    let report = test(
        &config,
        |r| Some(tilted_lobe(r, 1.03e6, axis)),
        |p| tilted_pdf(p, 1e6, axis),
    );
    assert!(!report.ok, "{report}");
}

#[test]
fn declined_samples_belong_to_the_missing_density() {
    let keep = |p: [f64; 3]| (p[0] > -0.5).then_some(p);
    let pdf = |p: [f64; 3]| if p[0] > -0.5 { p[2].max(0.0) / PI } else { 0.0 };
    let report = test(&Config::default(), |r| keep(cosine(r)), pdf);
    assert!(report.ok, "{report}");
    assert!(report.declined > 0.1, "{report}");
    // the same samples, renormalised density not told
    let report = test(
        &Config::default(),
        |r| keep(cosine(r)),
        |p| p[2].max(0.0) / PI,
    );
    assert!(!report.ok, "{report}");
}

#[test]
fn rejects_samples_where_the_density_is_zero_or_invalid() {
    let pdf = |p: [f64; 3]| if p[2] > 0.1 { p[2] / PI / 0.99 } else { 0.0 };
    let report = test(&Config::default(), |r| Some(cosine(r)), pdf);
    assert!(matches!(report.fault, Some(Fault::Stray(_))), "{report}");
    let report = test(&Config::default(), |r| Some(cosine(r)), |_| f64::NAN);
    assert!(
        matches!(report.fault, Some(Fault::InvalidDensity { .. })),
        "{report}"
    );
}

#[test]
fn false_alarms_are_as_rare_as_the_level_says() {
    // 200 correct samplers at level 0.05: 10 +- 3.1 rejections
    let rejected = (0..200)
        .filter(|seed| {
            let config = Config {
                samples: 10_000,
                seed: *seed,
                level: 0.05,
                ..Config::default()
            };
            !test(&config, |r| Some(cosine(r)), |p| p[2].max(0.0) / PI).ok
        })
        .count();
    assert!((1..=22).contains(&rejected), "{rejected} of 200 rejected");
}

#[test]
fn disk_and_square() {
    for domain in [Domain::Disk, Domain::Square] {
        let config = Config {
            domain,
            tests: 2,
            ..Config::default()
        };
        let density = if domain == Domain::Disk {
            1.0 / PI
        } else {
            1.0
        };
        let sample = |r: &mut Rng| {
            let [u, v] = r.uniform2();
            let (s, c) = (2.0 * PI * v).sin_cos();
            Some(match domain {
                Domain::Disk => [u.sqrt() * c, u.sqrt() * s, 0.0],
                _ => [u, v, 0.0],
            })
        };
        let report = test(&config, sample, |_| density);
        assert!(report.ok, "{domain:?}: {report}");
    }
}

#[test]
fn accepts_densities_with_edges() {
    // cones whose edge lies anywhere among the cells, and one across them
    for angle in [0.01_f64, 0.78, 0.79, 1.1] {
        let depth = 1.0 - angle.cos();
        let config = Config {
            tests: 5,
            ..Config::default()
        };
        let sample = |r: &mut Rng| {
            let [u, v] = r.uniform2();
            let z = 1.0 - u * depth;
            let (radius, (s, c)) = ((1.0 - z * z).sqrt(), (2.0 * PI * v).sin_cos());
            Some([radius * c, radius * s, z])
        };
        let pdf = |p: [f64; 3]| {
            if 1.0 - p[2] <= depth {
                0.5 / PI / depth
            } else {
                0.0
            }
        };
        let report = test(&config, sample, pdf);
        assert!(report.ok, "{angle}: {report}");
    }
    let half = |r: &mut Rng| Some(cosine(r)).filter(|p| p[0] + 0.7 * p[1] < 0.3 * p[2]);
    let pdf = |p: [f64; 3]| {
        let inside = p[0] + 0.7 * p[1] < 0.3 * p[2];
        if inside { p[2].max(0.0) / PI } else { 0.0 }
    };
    let config = Config {
        tests: 5,
        ..Config::default()
    };
    let report = test(&config, half, pdf);
    assert!(report.ok, "{report}");
}
