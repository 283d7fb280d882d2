//! The error a render reports is the error it makes.

use crate::common::{camera, empty, floor, glossy, grey, quad, shining, sphere};
use tracer::{Film, LeftOut, Object, Scene, Settings, Strategy, render};

fn scene() -> Scene<1> {
    let mut d = empty(
        camera([0.0, 2.2, 6.5], [0.0, 1.0, 0.0], 20.0),
        vec![grey(0.5), glossy()],
    );
    // no pixel sees an edge of the floor: what a replicate meets once or twice is not normal, no interval covers it
    d.objects = vec![
        Object::new(floor(0.0, 1000.0), 0),
        Object::new(sphere([0.0, 1.0, 0.0], 1.0), 1),
        shining(
            quad([-1.0, 4.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
            10.0,
        ),
    ];
    Scene::new(d).unwrap()
}

fn film(scene: &Scene<1>, size: u32, replicates: u32, spp: u32, seed: u64) -> Film<1> {
    let mut film = Film::new(size, size, replicates);
    let settings = Settings {
        spp,
        seed,
        ..Settings::default()
    };
    render(scene, &settings, &mut film, &()).unwrap();
    film
}

#[test]
fn reported_error_is_the_distance_to_the_truth() {
    let scene = scene();
    let truth = film(&scene, 16, 8, 4096, 1).mean();
    let square: f64 = truth.iter().map(|[v]| v * v).sum();
    for replicates in [4, 8, 16] {
        let estimate = film(&scene, 16, replicates, 64, 2).estimate(0.99);
        let error: f64 = (estimate.mean.iter().zip(&truth))
            .map(|([a], [b])| (a - b) * (a - b))
            .sum();
        let actual = (error / square).sqrt();
        let [low, high] = estimate.rel_rmse_ci;
        assert!(
            low < estimate.rel_rmse && estimate.rel_rmse < high,
            "{low} {high}"
        );
        // the actual error of 256 pixels scatters by about a tenth around its own expectation
        assert!(
            actual > 0.8 * low && actual < 1.25 * high,
            "{replicates}: {actual} in [{low}, {high}]"
        );
    }
}

#[test]
fn slow_intervals_cover_the_truth_as_often_as_they_say() {
    let scene = scene();
    let size = 8;
    let truth = film(&scene, size, 8, 1 << 16, 1).mean();
    let square: f64 = truth.iter().map(|[v]| v * v).sum();
    let (renders, mut inside, mut counted, mut image) = (300, 0.0, 0.0, 0.0);
    let mut true_square_error = 0.0;
    let mut estimates = Vec::new();
    for seed in 0..renders {
        let estimate = film(&scene, size, 8, 512, 100 + seed).estimate(0.95);
        for (p, ([value], [exact])) in estimate.mean.iter().zip(&truth).enumerate() {
            let half = estimate.half_width(p, 0, 0.95);
            if half > 0.0 {
                counted += 1.0;
                inside += if (value - exact).abs() <= half {
                    1.0
                } else {
                    0.0
                };
            }
            true_square_error += (value - exact) * (value - exact) / renders as f64;
        }
        estimates.push(estimate);
    }
    let coverage = inside / counted;
    assert!((0.93..0.97).contains(&coverage), "pixels: {coverage}");
    // the interval is about the expected error of such a render, which the 300 together know well
    let expected = (true_square_error / square).sqrt();
    for e in &estimates {
        let [low, high] = e.rel_rmse_ci;
        image += if (low..high).contains(&expected) {
            1.0
        } else {
            0.0
        };
    }
    let coverage = image / renders as f64;
    assert!((0.90..0.99).contains(&coverage), "pictures: {coverage}");
}

#[test]
fn what_is_left_out_is_said() {
    let scene = scene();
    let settings = Settings::default();
    let all = scene.left_out(&settings);
    for what in [
        LeftOut::Triangles,
        LeftOut::Environment,
        LeftOut::LightChoice,
        LeftOut::Filter,
    ] {
        assert!(all.contains(&what), "{what}");
    }
    assert!(!all.contains(&LeftOut::Lights), "one light is asked");
    let material = Settings {
        strategy: Strategy::BsdfOnly,
        roulette: Some(3),
        ..settings
    };
    let all = scene.left_out(&material);
    assert!(
        all.contains(&LeftOut::Lights) && !all.contains(&LeftOut::Roulette),
        "{all:?}"
    );
}
