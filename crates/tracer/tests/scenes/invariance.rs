//! What must not change the bits.

use crate::common::{
    ball, camera, constant, empty, floor, glossy, grey, placed, quad, shining, sphere,
};
use glam::{DAffine3, DVec3};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};
use tracer::{Camera, Description, Film, Object, Progress, Scene, Settings, Shape, render};

fn still_life() -> Description<1> {
    let mut d = empty(
        camera([0.0, 2.2, 6.5], [0.0, 1.0, 0.0], 35.0),
        vec![grey(0.5), glossy()],
    );
    d.objects = vec![
        Object::new(floor(0.0, 10.0), 0),
        Object::new(sphere([-1.0, 1.0, 0.0], 1.0), 1),
        placed(
            Shape::Mesh(ball(16, true)),
            DAffine3::from_translation(DVec3::new(1.1, 1.0, 0.0)),
        ),
        shining(
            quad([-1.0, 4.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
            10.0,
        ),
    ];
    d.environment = constant(0.1);
    d
}

fn settings(spp: u32, threads: usize) -> Settings {
    Settings {
        spp,
        threads: NonZeroUsize::new(threads),
        ..Settings::default()
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = Scene::new(still_life()).unwrap();
    let film = |threads| {
        let mut film = Film::<1>::new(50, 37, 8);
        render(&scene, &settings(20, threads), &mut film, &()).unwrap();
        film
    };
    let one = film(1);
    assert_eq!(one, film(2));
    assert_eq!(one, film(3));
    assert_eq!(one.spp(), 20);
    assert_eq!(one.samples(), 20 * 50 * 37);
}

/// Ends the render after a number of questions.
struct Impatient(AtomicU64);

impl Progress<1> for Impatient {
    fn cancelled(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) > 7
    }
}

#[test]
fn a_render_that_was_cancelled_and_stored_goes_on_to_the_same_bits() {
    let scene = Scene::new(still_life()).unwrap();
    let mut whole = Film::<1>::new(50, 37, 8);
    render(&scene, &settings(24, 1), &mut whole, &()).unwrap();

    let mut first = Film::<1>::new(50, 37, 8);
    render(
        &scene,
        &settings(24, 2),
        &mut first,
        &Impatient(AtomicU64::new(0)),
    )
    .unwrap();
    assert!(
        first.samples() > 0 && first.spp() < 24,
        "cancelled on the way"
    );
    assert!(
        first.mean().iter().all(|[v]| v.is_finite()),
        "valid where it is"
    );
    let estimate = first.estimate(0.95);
    assert!(
        estimate.rel_rmse.is_infinite(),
        "no claim while pixels are empty"
    );

    let mut second = Film::<1>::new(50, 37, 8);
    for (i, tile) in first.tiles().enumerate() {
        second.restore(i, tile.done(), tile.sums()).unwrap();
    }
    assert_eq!(first, second);
    render(&scene, &settings(24, 2), &mut second, &()).unwrap();
    assert_eq!(whole, second);
    assert!(
        second.restore(0, 1, &[]).is_err(),
        "the wrong number of sums"
    );
    assert!(second.restore(999, 1, &[]).is_err(), "no such tile");
}

/// Stops after the first pass.
struct OnePass;

impl Progress<1> for OnePass {
    fn pass_done(&self, _: &Film<1>) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

#[test]
fn a_watcher_may_stop_after_a_pass() {
    let scene = Scene::new(still_life()).unwrap();
    let mut film = Film::<1>::new(20, 20, 8);
    let stats = render(&scene, &settings(64, 1), &mut film, &OnePass).unwrap();
    assert_eq!(film.spp(), 8);
    assert_eq!(stats.paths, 8 * 400);
    assert!(
        stats.closest_rays > stats.paths && stats.shadow_rays > 0,
        "{stats:?}"
    );
}

fn scaled(factor: f64) -> Description<1> {
    let mut d = still_life();
    d.camera = Camera {
        eye: d.camera.eye * factor,
        target: d.camera.target * factor,
        ..d.camera
    };
    let scale = DAffine3::from_scale(DVec3::splat(factor));
    for object in &mut d.objects {
        object.transform = scale * object.transform;
    }
    d
}

#[test]
fn scale_does_not_matter() {
    let film = |factor: f64| {
        let scene = Scene::new(scaled(factor)).unwrap();
        let mut film = Film::<1>::new(32, 24, 8);
        render(&scene, &settings(16, 2), &mut film, &()).unwrap();
        film
    };
    let reference = film(1.0);
    // a power of two changes exponents alone
    for factor in [2.0_f64.powi(20), 2.0_f64.powi(-20)] {
        let same = film(factor).mean() == reference.mean();
        assert!(same, "times {factor}");
    }
    // any other factor rounds: a few paths go another way
    for factor in [1e-6, 1e6] {
        let other = film(factor);
        let (mut off, mut sum) = (0.0, 0.0);
        for ([a], [b]) in other.mean().iter().zip(reference.mean()) {
            off += (a - b).abs();
            sum += b;
        }
        assert!(off < 5e-3 * sum, "times {factor}: {off} of {sum}");
    }
}
