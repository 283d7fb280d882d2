//! Ways of finding the same light agree on it.

use crate::common::{
    ball, camera, constant, empty, floor, glossy, grey, mean, picture, placed, quad, shining,
    sphere,
};
use glam::{DAffine3, DVec3};
use sampling::PointSet;
use tracer::{Description, Object, PixelFilter, Settings, Shape, Strategy};

/// A glossy sphere and a ball of triangles on a grey floor, an area light, a little sky.
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
        shining(sphere([2.5, 0.5, 2.0], 0.4), 3.0),
    ];
    d.environment = constant(0.1);
    d
}

fn value(change: impl FnOnce(&mut Settings)) -> (f64, f64) {
    let mut settings = Settings {
        spp: 64,
        ..Settings::default()
    };
    change(&mut settings);
    mean(&picture(still_life(), [24, 18], &settings))
}

#[test]
fn all_agree() {
    let (reference, e) = value(|s| s.spp = 256);
    let others = [
        (
            "lights",
            value(|s| (s.strategy, s.spp) = (Strategy::LightOnly, 256)),
        ),
        (
            "material",
            value(|s| (s.strategy, s.spp) = (Strategy::BsdfOnly, 512)),
        ),
        ("resampling", value(|s| s.strategy = Strategy::Ris)),
        ("roulette", value(|s| s.roulette = Some(1))),
        ("halton", value(|s| s.points = PointSet::Halton)),
        ("independent", value(|s| s.points = PointSet::Independent)),
        ("another seed", value(|s| s.seed = 99)),
        ("odd count", value(|s| s.spp = 83)),
    ];
    for (what, (mean, error)) in others {
        let error = error.hypot(e);
        // eight comparisons with 15 degrees of freedom each: chance below one in 200
        assert!(
            (mean - reference).abs() < 4.2 * error,
            "{what}: {mean} for {reference} +- {error}"
        );
        assert!(
            error < 0.03 * reference,
            "{what}: {error} is too large to tell"
        );
    }
}

#[test]
fn gaussian_filter_keeps_the_mean_of_a_wide_picture() {
    let filter = PixelFilter::Gaussian {
        sigma: 0.5,
        radius: 1.5,
    };
    let (a, ea) = value(|_| {});
    let (b, eb) = value(|s| s.filter = filter);
    // the filter reaches half a pixel over the edge of the picture: a percent of it
    assert!((a - b).abs() < 4.2 * ea.hypot(eb) + 0.01 * a, "{a} and {b}");
}
