//! What denormal numbers cost: the same work on ordinary values and on values so small that they are subnormal.
//!
//! Measured, not tested: a time says something about a machine that does nothing else.

use crate::grid::{in_f32, models, pairs};
use crate::scenes::{constant, empty, placed, unit_sphere};
use brdf::{Brdf, LANES, Lanes3, Status};
use brdf_models::{ModelInfo, ParsedModel, Role, build_model};
use brdf_table::{GriddedN, HalfDiffTable, Interpolation, PhiDomain};
use glam::{DVec2, DVec3};
use sampling::Piecewise2;
use spectrum::{Basis, RgbSpace};
use std::hint::black_box;
use std::num::NonZero;
use std::sync::Arc;
use std::time::Instant;
use tracer::{Film, Scene, Settings, render};

/// The weight that makes every f32 result subnormal.
const TINY: f64 = 1e-40;
/// Measurements of which the fastest counts.
const ROUNDS: usize = 7;

/// Times of one piece of work.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// What was done.
    pub what: String,
    /// Seconds with ordinary values.
    pub normal: f64,
    /// Seconds with subnormal ones.
    pub denormal: f64,
}

impl Timing {
    /// How much slower subnormal values are; 1 = not at all.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.denormal / self.normal
    }
}

/// Measures every model in f32 lanes, a table, a tabulated density and a picture, one after the other.
#[must_use]
pub fn timings() -> Vec<Timing> {
    let mut all: Vec<_> = models().filter_map(model).collect();
    all.extend(table());
    all.extend(density());
    all.extend(picture());
    all
}

/// Times both by turns, so that neither has the machine's better moments.
fn compare(what: String, mut normal: impl FnMut(), mut denormal: impl FnMut()) -> Timing {
    let mut best = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        let start = Instant::now();
        normal();
        best[0] = best[0].min(start.elapsed().as_secs_f64());
        let start = Instant::now();
        denormal();
        best[1] = best[1].min(start.elapsed().as_secs_f64());
    }
    Timing {
        what,
        normal: best[0],
        denormal: best[1],
    }
}

/// Packets of all pairs of the grid.
fn packets() -> Vec<[Lanes3; 2]> {
    let pairs = pairs(1);
    let chunks = pairs.chunks_exact(LANES);
    chunks
        .map(|chunk| {
            let mut both = [Lanes3::ZERO; 2];
            for (k, (wi, wo)) in chunk.iter().enumerate() {
                both[0].set(k, in_f32(wi.w));
                both[1].set(k, in_f32(*wo));
            }
            both
        })
        .collect()
}

fn evaluate(brdf: &dyn Brdf<3>, packets: &[[Lanes3; 2]]) {
    for _ in 0..10 {
        for [wi, wo] in packets {
            black_box(brdf.eval_lanes(wi, wo));
        }
    }
}

/// A model whose weights are all `w`.
fn weighted(info: &'static ModelInfo, w: f64) -> Option<ParsedModel<3>> {
    let weights = info.parameters.iter().filter(|p| p.role == Role::Weight);
    let values: Vec<(&str, &[f64])> = weights
        .map(|p| (p.name, std::slice::from_ref(&w)))
        .collect();
    build_model(info, &values).ok()
}

fn model(info: &'static ModelInfo) -> Option<Timing> {
    let (normal, denormal) = (weighted(info, 0.5)?, weighted(info, TINY)?);
    let packets = packets();
    Some(compare(
        format!("model/{}", info.name),
        || evaluate(&*normal.built.brdf, &packets),
        || evaluate(&*denormal.built.brdf, &packets),
    ))
}

fn table() -> Option<Timing> {
    let of = |value: f64| {
        let basis = Basis::Rgb(RgbSpace::srgb());
        let fill = move |_: DVec3, _: DVec3, out: &mut [f64]| {
            out.fill(value);
            Status::Measured
        };
        let table = HalfDiffTable::from_fn([12, 9, 12], PhiDomain::Mirror, basis, fill);
        GriddedN::<3>::new(Arc::new(table), Interpolation::Linear).ok()
    };
    let (normal, denormal, packets) = (of(0.5)?, of(TINY)?, packets());
    Some(compare(
        "table/GriddedN linear".into(),
        || evaluate(&normal, &packets),
        || evaluate(&denormal, &packets),
    ))
}

fn density() -> Option<Timing> {
    let of = |value: f64| {
        let values: Vec<f64> = (0..4096).map(|k| value * f64::from(1 + k % 7)).collect();
        Piecewise2::bilinear(64, &values).ok()
    };
    let (normal, denormal) = (of(1.0)?, of(1e-310)?);
    let draw = |table: &Piecewise2| {
        for k in 0..100_000_u32 {
            let u = DVec2::new(f64::from(k) * 1e-5, f64::from(k) * 0.618_034 % 1.0);
            black_box(table.sample(u));
        }
    };
    Some(compare(
        "density/two dimensions".into(),
        || draw(&normal),
        || draw(&denormal),
    ))
}

/// A sphere before a sky of constant radiance.
fn picture() -> Option<Timing> {
    let settings = Settings {
        threads: NonZero::new(1),
        ..crate::cases::SETTINGS
    };
    let settings = &settings;
    let draw = |radiance: f32| {
        let scene = empty(0.5).and_then(|mut d| {
            d.environment = constant(radiance);
            d.objects.push(placed(unit_sphere(), 1.0, DVec3::ZERO));
            Scene::new(d).ok()
        });
        move || {
            let mut film = Film::<1>::new(64, 64, 8);
            if let Some(scene) = &scene {
                black_box(render(scene, settings, &mut film, &()).is_ok());
            }
        }
    };
    Some(compare("picture/sky".into(), draw(0.5), draw(1e-40)))
}
