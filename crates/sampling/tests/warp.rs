//! Every warp against its density (chi-square) and its inverse (round trip).

use glam::{DVec2, DVec3};
use sampling::warp;
use testkit::chi2::{Config, test};
use testkit::{Domain, Rng, assert_close};

/// Chi-square tests in this file, for the joint level.
const TESTS: usize = 17;

/// Tests density and inverse of a warp to directions or points of `domain`.
fn check(
    name: &str,
    domain: Domain,
    map: impl Fn(DVec2) -> DVec3,
    pdf: impl Fn(DVec3) -> f64,
    inverse: impl Fn(DVec3) -> DVec2,
) {
    let config = Config {
        domain,
        tests: TESTS,
        ..Config::default()
    };
    let sample = |r: &mut Rng| Some(map(DVec2::from(r.uniform2())).to_array());
    let report = test(&config, sample, |p| pdf(DVec3::from(p)));
    assert!(report.ok, "{name}: {report}");
    for i in 0..64 {
        for j in 0..64 {
            let u = DVec2::new((f64::from(i) + 0.5) / 64.0, (f64::from(j) + 0.5) / 64.0);
            let error = (inverse(map(u)) - u).abs().max_element();
            // a few roundings, amplified at most tenfold near the ends of a lobe's tail
            assert_close(error, 0.0, 1e-13, name);
        }
    }
    for u in [DVec2::ZERO, DVec2::splat(sampling::ONE_MINUS_EPSILON)] {
        let p = map(u);
        assert!(p.is_finite(), "{name}: {u} maps to {p}");
        let back = inverse(p);
        assert!(
            back.max_element() < 1.0 && back.min_element() >= 0.0,
            "{name}: {back}"
        );
    }
}

#[test]
fn hemisphere() {
    check(
        "uniform hemisphere",
        Domain::Hemisphere,
        warp::uniform_hemisphere,
        |_| warp::uniform_hemisphere_pdf(),
        warp::uniform_hemisphere_inverse,
    );
    check(
        "cosine hemisphere",
        Domain::Hemisphere,
        warp::cosine_hemisphere,
        |w| warp::cosine_hemisphere_pdf(w.z),
        warp::cosine_hemisphere_inverse,
    );
}

#[test]
fn sphere_and_cones() {
    check(
        "uniform sphere",
        Domain::Sphere,
        warp::uniform_sphere,
        |_| warp::uniform_sphere_pdf(),
        warp::uniform_sphere_inverse,
    );
    for angle in [1e-5, 0.01, 1.0, 2.5] {
        let depth = warp::one_minus_cos(angle);
        // The edge of the cone is sharp: a direction at it may round to either side.
        let inside = depth * (1.0 + 1e-9);
        let below = |w: DVec3| {
            let r2 = w.x * w.x + w.y * w.y;
            if w.z > 0.0 {
                r2 / (1.0 + w.z)
            } else {
                1.0 - w.z
            }
        };
        let pdf = |w: DVec3| {
            if below(w) <= inside {
                warp::cone_pdf(depth)
            } else {
                0.0
            }
        };
        check(
            "cone",
            Domain::Sphere,
            |u| warp::cone(u, depth),
            pdf,
            |w| warp::cone_inverse(w, depth),
        );
    }
}

#[test]
fn disk() {
    check(
        "concentric disk",
        Domain::Disk,
        |u| warp::concentric_disk(u).extend(0.0),
        |_| warp::concentric_disk_pdf(),
        |p| warp::concentric_disk_inverse(p.truncate()),
    );
}

#[test]
fn triangle() {
    // the triangle x + y < 1 of the unit square, area 1/2
    check(
        "triangle",
        Domain::Square,
        |u| {
            let b = warp::triangle(u);
            DVec3::new(b.y, b.z, 0.0)
        },
        |p| if p.x + p.y <= 1.0 { 2.0 } else { 0.0 },
        |p| warp::triangle_inverse(DVec3::new(1.0 - p.x - p.y, p.x, p.y)),
    );
}

#[test]
fn half_vectors() {
    for alpha in [1e-4, 0.1, 0.9] {
        check(
            "GGX",
            Domain::Hemisphere,
            |u| warp::ggx_half(u, alpha),
            |h| warp::ggx_half_pdf(h, alpha),
            |h| warp::ggx_half_inverse(h, alpha),
        );
        check(
            "Beckmann",
            Domain::Hemisphere,
            |u| warp::beckmann_half(u, alpha),
            |h| warp::beckmann_half_pdf(h, alpha),
            |h| warp::beckmann_half_inverse(h, alpha),
        );
    }
    for n in [0.0, 50.0, 1e6] {
        check(
            "Blinn",
            Domain::Hemisphere,
            |u| warp::blinn_half(u, n),
            |h| warp::blinn_half_pdf(h, n),
            |h| warp::blinn_half_inverse(h, n),
        );
    }
}

#[test]
fn a_wrong_warp_is_seen() {
    // polar mapping without the square root: too many points in the middle of the disk
    let config = Config {
        domain: Domain::Disk,
        ..Config::default()
    };
    let sample = |r: &mut Rng| {
        let [u, v] = r.uniform2();
        let (s, c) = (std::f64::consts::TAU * v).sin_cos();
        Some([u * c, u * s, 0.0])
    };
    let report = test(&config, sample, |_| warp::concentric_disk_pdf());
    assert!(!report.ok, "{report}");
}

#[test]
fn narrow_cones_keep_their_digits() {
    // 1 - cos a = a^2/2 - a^4/24 + ..
    for angle in [1e-12, 1e-8, 1e-3] {
        let series = 0.5 * angle * angle * (1.0 - angle * angle / 12.0);
        testkit::assert_relative(warp::one_minus_cos(angle), series, 1e-13, "angle");
        let sine = warp::one_minus_cos_of_sin(f64::sin(angle));
        testkit::assert_relative(sine, series, 1e-13, "sine");
    }
}
