//! Each kind of light against its closed form.

use crate::common::{
    assert_radiance, camera, empty, floor, grey, mean, picture, quad, shining, two_triangles,
};
use glam::{DMat3, DVec3, Vec3};
use spectrum::Samples;
use std::f64::consts::PI;
use tracer::{
    Description, Environment, EnvironmentImage, Object, PointLight, Settings, Shape, Strategy,
};

fn floor_scene() -> Description<1> {
    let mut d = empty(
        camera([6.0, 5.0, 0.3], [0.0, 0.0, 0.0], 1e-3),
        vec![grey(0.6)],
    );
    d.objects.push(Object::new(floor(0.0, 20.0), 0));
    d
}

fn settings(spp: u32, strategy: Strategy) -> Settings {
    Settings {
        spp,
        strategy,
        max_depth: 1,
        ..Settings::default()
    }
}

#[test]
fn point_and_direction() {
    let mut d = floor_scene();
    d.lights.push(PointLight::Point {
        position: DVec3::new(0.0, 2.0, 1.0),
        intensity: Samples([4.0]),
    });
    // I cos / d^2
    let exact = 0.6 / PI * 4.0 * (2.0 / 5.0_f64.sqrt()) / 5.0;
    assert_radiance(d, &settings(64, Strategy::Mis), exact, "point");

    let mut d = floor_scene();
    d.lights.push(PointLight::Directional {
        direction: DVec3::new(0.0, -2.0, 1.0),
        irradiance: Samples([4.0]),
    });
    let exact = 0.6 / PI * 4.0 * (2.0 / 5.0_f64.sqrt());
    assert_radiance(d, &settings(64, Strategy::Mis), exact, "directional");
}

#[test]
fn lights_of_all_kinds_add_up() {
    let point = PointLight::Point {
        position: DVec3::new(0.0, 2.0, 1.0),
        intensity: Samples([4.0]),
    };
    let sun = PointLight::Directional {
        direction: DVec3::new(0.0, -2.0, 1.0),
        irradiance: Samples([1.0]),
    };
    let cos = 2.0 / 5.0_f64.sqrt();
    let exact = 0.6 / PI * (4.0 * cos / 5.0 + cos) + 0.6 * 3.0 * 0.04;
    for strategy in [Strategy::Mis, Strategy::Ris, Strategy::LightOnly] {
        let mut d = floor_scene();
        d.lights = vec![point, sun];
        d.objects
            .push(shining(crate::common::sphere([0.0, 5.0, 0.0], 1.0), 3.0));
        assert_radiance(d, &settings(4096, strategy), exact, "three lights");
    }
}

#[test]
fn triangles_and_slanted_quads_shine_like_the_rectangle() {
    let (corner, u, v) = (
        Vec3::new(-0.5, 2.0, -1.0),
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 0.0, 2.0),
    );
    let rectangle = || quad([-0.5, 2.0, -1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
    // a parallelogram that is the rectangle sheared, and its exact counterpart by triangles
    let slanted = || quad([-0.5, 2.0, -1.0], [1.0, 0.0, 0.0], [0.7, 0.0, 2.0]);
    let sheared = two_triangles(corner, u, v + Vec3::new(0.7, 0.0, 0.0));
    let cases = [
        (
            "rectangle",
            rectangle(),
            Shape::Mesh(two_triangles(corner, u, v)),
        ),
        ("slanted", slanted(), Shape::Mesh(sheared)),
    ];
    for (what, a, b) in cases {
        for strategy in [
            Strategy::Mis,
            Strategy::Ris,
            Strategy::LightOnly,
            Strategy::BsdfOnly,
        ] {
            let value = |light: &Shape| {
                let mut d = floor_scene();
                d.objects.push(shining(light.clone(), 3.0));
                mean(&picture(d, [4, 4], &settings(4096, strategy)))
            };
            let ((x, ex), (y, ey)) = (value(&a), value(&b));
            let error = ex.hypot(ey);
            assert!(
                (x - y).abs() < 4.2 * error + 1e-5 * x,
                "{what} {strategy:?}: {x} and {y} +- {error}"
            );
            assert!(
                error < 0.03 * x,
                "{what} {strategy:?}: {error} is too large to tell"
            );
        }
    }
}

/// 8 x 4 pixels, dark but for some in the upper half.
fn sky() -> EnvironmentImage<Samples<1>> {
    let mut pixels = vec![Samples([0.05]); 32];
    pixels[10] = Samples([20.0]);
    pixels[5] = Samples([4.0]);
    EnvironmentImage {
        width: 8,
        height: 4,
        pixels,
        to_world: DMat3::IDENTITY,
    }
}

#[test]
fn a_picture_of_the_sky_lights_the_floor() {
    // irradiance of a pixel: L dphi (sin^2 below - sin^2 above) / 2
    let image = sky();
    let mut exact = 0.0;
    for (i, pixel) in image.pixels.iter().enumerate().take(16) {
        let row = (i / 8) as f64;
        let sin2 = |r: f64| (r * PI / 4.0).sin().powi(2);
        exact += f64::from(pixel.0[0]) * (PI / 4.0) * (sin2(row + 1.0) - sin2(row)) / 2.0;
    }
    for (strategy, spp) in [
        (Strategy::Mis, 1024),
        (Strategy::Ris, 1024),
        (Strategy::LightOnly, 1024),
        (Strategy::BsdfOnly, 16384),
    ] {
        let mut d = floor_scene();
        d.environment = Some(Environment::Image(sky()));
        assert_radiance(
            d,
            &settings(spp, strategy),
            exact * 0.6 / PI,
            &format!("sky {strategy:?}"),
        );
    }
}

#[test]
fn the_sky_hangs_the_right_way_round() {
    let mut image = sky();
    image.pixels = (0..32).map(|i| Samples([i as f32])).collect();
    // (column, row) of a direction: the middle of the picture is -z, +x a quarter to the right, the top +y
    let cases = [
        (DVec3::new(0.1, 0.1, -1.0), 4, 1),
        (DVec3::new(1.0, 0.1, 0.1), 6, 1),
        (DVec3::new(-1.0, -0.1, -0.1), 2, 2),
        (DVec3::new(0.1, 1.0, 0.2), 7, 0),
    ];
    for (direction, column, row) in cases {
        for turn in [DMat3::IDENTITY, DMat3::from_rotation_y(0.7)] {
            let target = (turn * direction).to_array();
            let mut d = empty(camera([0.0; 3], target, 0.01), vec![grey(0.5)]);
            image.to_world = turn;
            d.environment = Some(Environment::Image(image.clone()));
            let film = picture(d, [1, 1], &settings(16, Strategy::Mis));
            let expected = f64::from(row * 8 + column);
            assert!(
                (film.mean()[0][0] - expected).abs() < 1e-6,
                "{direction}: {} for {expected}",
                film.mean()[0][0]
            );
        }
    }
}
