//! Whole pictures: radiance from 1e-30 to 1e30, scenes of any size, a million samples.

use crate::case::{Case, Effort};
use crate::scenes::{constant, empty, floor, placed, shining, unit_sphere};
use crate::tally::Tally;
use glam::DVec3;
use tracer::{Film, Scene, Settings, Strategy, render};

pub(super) fn cases() -> Vec<Case> {
    vec![
        Case::new(
            "picture/radiance 1e-30 to 1e30",
            1e-5,
            "a picture is linear in its light: roundings of f32 along a path",
            |_, tally| radiance(tally),
        ),
        Case::new(
            "picture/scenes of 1e-6 to 1e6",
            1e-3,
            "but for powers of two a factor rounds coordinates, and a few paths go another way",
            |_, tally| sizes(tally),
        ),
        Case::new(
            "picture/furnace, shifted by a million sizes",
            1e-5,
            "a white convex body before a white sky cannot be seen, wherever it stands",
            |_, tally| furnace(tally),
        ),
        Case::new(
            "film/a million samples a pixel",
            1e-7,
            "sums of f64: 1e6 roundings of 1e-16, and the f32 of each sample",
            many,
        ),
    ]
}

/// What all pictures here are rendered with.
pub(crate) const SETTINGS: Settings = Settings {
    spp: 16,
    seed: 1,
    max_depth: 4,
    strategy: Strategy::Mis,
    points: tracer::PointSet::Sobol,
    filter: tracer::PixelFilter::Box,
    roulette: None,
    threads: None,
    shard: None,
};

/// Means of the pixels of a floor under a sphere that shines.
fn picture(radiance: f32, scale: f64) -> Option<Vec<f64>> {
    let mut d = empty(0.5)?;
    d.camera.eye *= scale;
    d.camera.target *= scale;
    d.objects.push(placed(floor(2.0), scale, DVec3::ZERO));
    let light = placed(
        unit_sphere(),
        0.2 * scale,
        DVec3::new(0.6, 1.0, 0.2) * scale,
    );
    d.objects.push(shining(light, radiance));
    rendered(d, [8, 8], &SETTINGS)
}

fn rendered(d: tracer::Description<1>, [w, h]: [u32; 2], settings: &Settings) -> Option<Vec<f64>> {
    let scene = Scene::new(d).ok()?;
    let mut film = Film::<1>::new(w, h, 8);
    render(&scene, settings, &mut film, &()).ok()?;
    Some(film.mean().into_iter().map(|[v]| v).collect())
}

fn radiance(tally: &mut Tally) {
    let reference = picture(1.0, 1.0).unwrap_or_default();
    for exponent in [-30, -20, -10, -3, 3, 10, 20, 30] {
        let l = 10_f32.powi(exponent);
        let picture = picture(l, 1.0).unwrap_or_default();
        for (i, (value, exact)) in picture.iter().zip(&reference).enumerate() {
            let value = value / f64::from(l);
            tally.value(value, *exact, 1e-6, || {
                format!("radiance 1e{exponent}, pixel {i}")
            });
        }
    }
}

fn sizes(tally: &mut Tally) {
    let reference = picture(1.0, 1.0).unwrap_or_default();
    let sum: f64 = reference.iter().sum();
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        let picture = picture(1.0, scale).unwrap_or_default();
        let off: f64 = picture
            .iter()
            .zip(&reference)
            .map(|(a, b)| (a - b).abs())
            .sum();
        let missing = picture.is_empty() || reference.is_empty();
        let error = if missing { f64::INFINITY } else { off / sum };
        tally.error(error, || format!("scale {scale:e}"));
        picture
            .iter()
            .for_each(|&v| tally.sound(v, || format!("scale {scale:e}")));
    }
}

fn furnace(tally: &mut Tally) {
    for (shift, radius) in [
        (0.0, 1.0),
        (1e3, 1.0),
        (1e6, 1.0),
        (0.0, 1e-6),
        (0.0, 1e6),
        (1e6, 1e3),
    ] {
        let at = DVec3::new(1.0, 0.5, -1.0) * shift;
        let value = empty(1.0).and_then(|mut d| {
            d.camera.eye = at + DVec3::new(0.3, 0.9, 0.4) * (5.0 * radius);
            d.camera.target = at;
            d.camera.vertical_fov_deg = 15.0;
            d.environment = constant(1.0);
            d.objects.push(placed(unit_sphere(), radius, at));
            rendered(d, [8, 8], &SETTINGS)
        });
        for value in value.unwrap_or_else(|| vec![f64::NAN]) {
            tally.value(value, 1.0, 0.0, || format!("radius {radius:e} at {at}"));
        }
    }
}

fn many(effort: Effort, tally: &mut Tally) {
    let settings = Settings {
        spp: effort.pick(1 << 16, 1 << 20) as u32,
        ..SETTINGS
    };
    for radiance in [0.1_f32, 1e-30, 1e30] {
        let value = empty(0.5).and_then(|mut d| {
            d.environment = constant(radiance);
            rendered(d, [1, 1], &settings)
        });
        let place = || format!("radiance {radiance:e}");
        let value = value.and_then(|v| v.first().copied()).unwrap_or(f64::NAN);
        tally.value(value, f64::from(radiance), 0.0, place);
    }
}
