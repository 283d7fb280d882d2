//! What the light tree is worth: error against run time for N lights, chosen by power and by the tree.
//!
//! `cargo run --release -p tracer --example many_lights`. One thread, both selections in turn. The ratio is that of
//! MSE x seconds, power over tree, so that more than 1 means the tree is faster to the same error; its error is that
//! of the mean over seeds, in the logarithm.

#![expect(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "an example reports to whoever runs it"
)]

#[path = "shared/cosine.rs"]
mod cosine;

use brdf::{Brdf, Material, Paired};
use cosine::Cosine;
use glam::DVec3;
use sampling::Rng;
use spectrum::Samples;
use std::f64::consts::PI;
use std::num::NonZeroUsize;
use std::time::Instant;
use tracer::{
    Camera, Description, Film, LightSelection, Object, PointLight, Scene, Settings, Shape,
    Strategy, render,
};

/// Albedo 0.6.
struct Lambert;

impl Brdf<1> for Lambert {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 1] {
        let up = wi.z > 0.0 && wo.z > 0.0;
        [if up { 0.6 / PI } else { 0.0 }]
    }
}

/// A floor and a ball under `n` point lights at random heights, of powers over three decades.
fn scene(n: usize, selection: LightSelection) -> Scene<1> {
    let material: Box<dyn Material<1>> = Box::new(Paired {
        brdf: Lambert,
        sampler: Cosine,
    });
    let mut rng = Rng::new(1);
    let mut number = |low: f64, high: f64| low + (high - low) * rng.uniform();
    let lights = (0..n)
        .map(|_| PointLight::Point {
            position: DVec3::new(number(-10.0, 10.0), number(0.3, 2.0), number(-10.0, 10.0)),
            intensity: Samples([10.0_f64.powf(number(-2.0, 1.0)) as f32]),
        })
        .collect();
    let floor = Shape::Quad {
        corner: DVec3::new(-12.0, 0.0, 12.0),
        edge_u: DVec3::X * 24.0,
        edge_v: DVec3::Z * -24.0,
    };
    let ball = Shape::Sphere {
        center: DVec3::Y,
        radius: 1.0,
    };
    Scene::new(Description {
        camera: Camera {
            eye: DVec3::new(9.0, 7.0, 0.5),
            target: DVec3::ZERO,
            up: DVec3::Y,
            vertical_fov_deg: 50.0,
        },
        materials: vec![material],
        objects: vec![Object::new(floor, 0), Object::new(ball, 0)],
        lights,
        environment: None,
        selection,
    })
    .unwrap()
}

/// Relative variance of a sample times seconds a sample.
fn cost(scene: &Scene<1>, strategy: Strategy, seed: u64) -> f64 {
    let settings = Settings {
        spp: 64,
        seed,
        strategy,
        max_depth: 2,
        threads: NonZeroUsize::new(1),
        ..Settings::default()
    };
    let mut film = Film::new(160, 120, 8);
    let start = Instant::now();
    render(scene, &settings, &mut film, &()).unwrap();
    film.estimate(0.95).rel_rmse.powi(2) * start.elapsed().as_secs_f64()
}

fn main() {
    println!("| lights | strategy | MSE x seconds, power over tree |");
    println!("|---:|---|---:|");
    for n in [2, 4, 8, 16, 64, 256, 1000] {
        let scenes = [LightSelection::Power, LightSelection::Tree].map(|s| scene(n, s));
        for strategy in [Strategy::Mis, Strategy::Ris] {
            let logs: Vec<f64> = (1..=8)
                .map(|seed| {
                    let [power, tree] = scenes.each_ref().map(|s| cost(s, strategy, seed));
                    (power / tree).ln()
                })
                .collect();
            let k = logs.len() as f64;
            let mean = logs.iter().sum::<f64>() / k;
            let spread = logs.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / (k - 1.0);
            let half = 2.36 * (spread / k).sqrt();
            println!(
                "| {n} | {strategy:?} | {:.2} ({:.2} to {:.2}) |",
                mean.exp(),
                (mean - half).exp(),
                (mean + half).exp()
            );
        }
    }
}
