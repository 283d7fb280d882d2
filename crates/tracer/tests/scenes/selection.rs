//! The choice among many lights changes the noise of a picture, never its mean.

use crate::common::{
    camera, empty, floor, glossy, grey, mean, picture, shining, sphere, two_triangles,
};
use glam::{DMat3, DVec3, Vec3};
use sampling::Rng;
use spectrum::Samples;
use tracer::{
    Description, Environment, EnvironmentImage, LightSelection, MANY, Object, PointLight, Scene,
    Settings, Shape, Strategy,
};

/// A floor under `n` lights of all kinds, whose powers span three decades, some looking away from it.
fn many(n: u64, selection: LightSelection) -> Description<1> {
    let mut d = empty(
        camera([6.0, 5.0, 0.3], [0.0, 0.0, 0.0], 40.0),
        vec![grey(0.6), glossy()],
    );
    d.selection = selection;
    d.objects.push(Object::new(floor(0.0, 20.0), 0));
    d.objects.push(Object::new(sphere([0.0, 0.6, 0.0], 0.6), 1));
    let mut rng = Rng::new(7);
    let mut number = |low: f64, high: f64| low + (high - low) * rng.uniform();
    for i in 0..n {
        let at = DVec3::new(number(-6.0, 6.0), number(0.5, 2.0), number(-6.0, 6.0));
        let strength = 10.0_f64.powf(number(-1.0, 2.0));
        let turn = [number(-0.3, 0.3), number(-0.3, 0.3)];
        match i % 3 {
            0 => d.lights.push(PointLight::Point {
                position: at,
                intensity: Samples([0.02 * strength as f32]),
            }),
            1 => d
                .objects
                .push(shining(sphere(at.to_array(), 0.1), 0.5 * strength as f32)),
            _ => {
                // v x u looks down, u x v up
                let edges = [
                    Vec3::new(0.3, turn[0] as f32, 0.0),
                    Vec3::new(0.0, turn[1] as f32, 0.3),
                ];
                let [u, v] = if i % 2 == 0 {
                    edges
                } else {
                    [edges[1], edges[0]]
                };
                let mesh = two_triangles(at.as_vec3(), u, v);
                d.objects
                    .push(shining(Shape::Mesh(mesh), 0.5 * strength as f32));
            }
        }
    }
    d
}

fn settings(strategy: Strategy) -> Settings {
    Settings {
        spp: 512,
        strategy,
        max_depth: 2,
        ..Settings::default()
    }
}

#[test]
fn the_tree_changes_no_mean() {
    for strategy in [Strategy::Mis, Strategy::Ris, Strategy::LightOnly] {
        let settings = Settings {
            spp: 4096,
            ..settings(strategy)
        };
        let of = |selection| mean(&picture(many(60, selection), [12, 9], &settings));
        let ((a, da), (b, db)) = (of(LightSelection::Power), of(LightSelection::Tree));
        let error = da.hypot(db);
        assert!(
            (a - b).abs() < 4.2 * error,
            "{strategy:?}: {a} by power, {b} by the tree, +- {error}"
        );
        assert!(error < 0.015 * a, "{error} of {a} is too large to tell");
    }
}

/// Lights that are not seen themselves, whose edges would be most of the noise.
#[test]
fn the_tree_lowers_the_noise() {
    for strategy in [Strategy::Mis, Strategy::Ris] {
        let noise = |selection| {
            let mut d = many(60, selection);
            d.objects.retain(|o| o.emission.is_none());
            picture(d, [12, 9], &settings(strategy))
                .estimate(0.95)
                .rel_rmse
        };
        let (power, tree) = (noise(LightSelection::Power), noise(LightSelection::Tree));
        assert!(
            tree < 0.8 * power,
            "{strategy:?}: {tree} by the tree, {power} by power"
        );
    }
}

#[test]
fn probabilities_of_a_scene_sum_to_one_with_far_lights_too() {
    let mut d = many(40, LightSelection::Tree);
    d.lights.push(PointLight::Directional {
        direction: DVec3::new(0.0, -1.0, 0.2),
        irradiance: Samples([0.3]),
    });
    d.environment = Some(Environment::Image(EnvironmentImage {
        width: 2,
        height: 1,
        pixels: vec![Samples([0.1]), Samples([0.4])],
        to_world: DMat3::IDENTITY,
    }));
    let scene = Scene::new(d).expect("a scene");
    assert!(scene.has_light_tree(), "asked for");
    assert_eq!(scene.lights(), 42, "all of them");
    let mut rng = Rng::new(11);
    for _ in 0..50 {
        let mut number = |low: f64, high: f64| (low + (high - low) * rng.uniform()) as f32;
        let p = Vec3::new(number(-5.0, 5.0), number(0.0, 3.0), number(-5.0, 5.0));
        let sum: f32 = (0..42).map(|i| scene.light_probability(i, p)).sum();
        assert!((sum - 1.0).abs() < 1e-5, "from {p}: {sum}");
        let (light, probability) = scene.choose_light(p, number(0.0, 1.0)).expect("a light");
        let again = scene.light_probability(light, p);
        assert!(
            (probability - again).abs() < 1e-6 * again,
            "light {light} from {p}: {probability} and {again}"
        );
    }
}

#[test]
fn few_lights_need_no_tree() {
    let tree = |n| {
        let scene = Scene::new(many(n, LightSelection::Auto)).expect("a scene");
        scene.has_light_tree()
    };
    assert!(!tree(1) && !tree(MANY as u64 - 1), "few");
    assert!(tree(MANY as u64), "many");
}
