//! Radiance that is exact on paper.

use crate::common::{
    assert_radiance, camera, constant, empty, floor, grey, picture, quad, shining, sphere,
};
use std::f64::consts::PI;
use tracer::{Description, Object, Settings, Strategy};

fn settings(spp: u32) -> Settings {
    Settings {
        spp,
        ..Settings::default()
    }
}

#[test]
fn white_furnace_shows_the_albedo_in_every_pixel() {
    let mut d = empty(
        camera([0.0, 0.0, 5.0], [0.0, 0.0, 0.0], 10.0),
        vec![grey(0.8)],
    );
    d.objects.push(Object::new(sphere([0.0; 3], 1.0), 0));
    d.environment = constant(1.5);
    let film = picture(d, [8, 8], &settings(16));
    for [value] in film.mean() {
        // every sample has weight albedo exactly, up to the rounding of f32
        assert!((value - 1.2).abs() < 1e-5, "{value}");
    }
}

#[test]
fn furnace_by_asking_the_environment_alone() {
    let mut d = empty(
        camera([0.0, 0.0, 5.0], [0.0, 0.0, 0.0], 10.0),
        vec![grey(0.8)],
    );
    d.objects.push(Object::new(sphere([0.0; 3], 1.0), 0));
    d.environment = constant(1.5);
    let settings = Settings {
        strategy: Strategy::LightOnly,
        ..settings(512)
    };
    assert_radiance(d, &settings, 1.2, "uniform directions");
}

#[test]
fn an_emitter_seen_directly_is_its_radiance() {
    for depth in [0, 5] {
        let mut d = empty(
            camera([0.0, 0.0, 5.0], [0.0, 0.0, 0.0], 10.0),
            vec![grey(0.0)],
        );
        d.objects.push(shining(sphere([0.0; 3], 1.0), 7.0));
        let settings = Settings {
            max_depth: depth,
            ..settings(16)
        };
        let film = picture(d, [4, 4], &settings);
        assert!(
            film.mean().iter().all(|[v]| (v - 7.0).abs() < 1e-6),
            "depth {depth}"
        );
    }
}

#[test]
fn emitters_are_dark_behind() {
    let mut d = empty(
        camera([0.0, 5.0, 0.1], [0.0, 0.0, 0.0], 10.0),
        vec![grey(0.5)],
    );
    // faces down, camera above
    d.objects.push(shining(
        quad([-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
        7.0,
    ));
    let film = picture(d, [4, 4], &settings(16));
    assert!(film.mean().iter().all(|[v]| v.abs() == 0.0), "black");
}

/// A point of a Lambert floor of albedo 0.6, looked at from the side, one bounce.
fn floor_scene() -> Description<1> {
    let mut d = empty(
        camera([6.0, 5.0, 0.3], [0.0, 0.0, 0.0], 1e-3),
        vec![grey(0.6)],
    );
    d.objects.push(Object::new(floor(0.0, 20.0), 0));
    d
}

fn all_strategies(make: impl Fn() -> Description<1>, spp: u32, exact: f64, what: &str) {
    for strategy in [
        Strategy::Mis,
        Strategy::Ris,
        Strategy::LightOnly,
        Strategy::BsdfOnly,
    ] {
        let settings = Settings {
            max_depth: 1,
            strategy,
            ..settings(spp)
        };
        assert_radiance(make(), &settings, exact, &format!("{what} {strategy:?}"));
    }
}

#[test]
fn under_a_sphere() {
    // E = pi L (r / d)^2 for a sphere right above
    let make = || {
        let mut d = floor_scene();
        d.objects.push(shining(sphere([0.0, 2.0, 0.0], 0.8), 3.0));
        d
    };
    all_strategies(make, 4096, 0.6 * 3.0 * 0.16, "sphere above");
}

#[test]
fn under_a_rectangle() {
    // four times the form factor of a corner [Howell2020, B-3]
    let (a, b): (f64, f64) = (1.0 / 2.0, 0.5 / 2.0);
    let (sa, sb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    let corner = (a / sa * (b / sa).atan() + b / sb * (a / sb).atan()) / (2.0 * PI);
    let make = || {
        let mut d = floor_scene();
        let light = quad([-1.0, 2.0, -0.5], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        d.objects.push(shining(light, 3.0));
        d
    };
    all_strategies(make, 16384, 0.6 * 3.0 * 4.0 * corner, "rectangle above");
}

#[test]
fn a_closed_box_that_shines_sums_the_series() {
    // all walls send out 1 and reflect 0.5: 1 + 1/2 + 1/4 + .. up to the depth limit, from everywhere
    for strategy in [
        Strategy::Mis,
        Strategy::Ris,
        Strategy::LightOnly,
        Strategy::BsdfOnly,
    ] {
        for depth in [1, 5] {
            let mut d = empty(
                camera([0.2, 0.1, 0.0], [1.0, 0.3, 0.2], 60.0),
                vec![grey(0.5)],
            );
            let (m, p) = (-1.0, 1.0);
            let walls = [
                quad([m, m, m], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]),
                quad([m, p, m], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
                quad([m, m, m], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]),
                quad([p, m, m], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0]),
                quad([m, m, m], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
                quad([m, m, p], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0]),
            ];
            d.objects.extend(walls.map(|w| shining(w, 1.0)));
            let settings = Settings {
                strategy,
                max_depth: depth,
                ..settings(1024)
            };
            let exact = 2.0 - 0.5_f64.powf(f64::from(depth));
            assert_radiance(
                d,
                &settings,
                exact,
                &format!("box {strategy:?} depth {depth}"),
            );
        }
    }
}

#[test]
fn a_convex_body_sees_none_of_itself() {
    // so that depth beyond one changes nothing
    for depth in [1, 2, 9] {
        let mut d = empty(
            camera([0.0, 0.0, 5.0], [0.0, 0.0, 0.0], 10.0),
            vec![grey(0.5)],
        );
        d.objects.push(Object::new(sphere([0.0; 3], 1.0), 0));
        d.environment = constant(1.0);
        let settings = Settings {
            max_depth: depth,
            ..settings(16)
        };
        assert_radiance(d, &settings, 0.5, "convex");
    }
}

#[test]
fn one_sided_surfaces_are_black_behind() {
    for (one_sided, exact) in [(false, 0.6), (true, 0.0)] {
        let mut d = empty(
            camera([1.0, -5.0, 0.0], [0.0, 0.0, 0.0], 1.0),
            vec![grey(0.6)],
        );
        d.objects.push(Object {
            one_sided,
            ..Object::new(floor(0.0, 5.0), 0)
        });
        d.environment = constant(1.0);
        assert_radiance(d, &settings(16), exact, "from below");
    }
}
