//! Samplers over any target, built for what is hardest: black, one spike, a lobe of 1e-4.

use super::tables::{Content, KINDS};
use crate::case::{Case, Effort};
use crate::grid::{in_f32, pairs, viewers};
use crate::tally::Tally;
use brdf::{DirectionSampler, LANES, Lanes3, Measured, Symmetry};
use brdf_models::parse_model;
use brdf_sampling::{
    Cosine, Dictionary, Hvt, Inversion, InversionOptions, Preset, Proposal, Rejection,
    RejectionOptions, SharedTarget, Target, Uniform,
};
use glam::{DVec2, DVec3};
use std::sync::Arc;

type Boxed = Box<dyn DirectionSampler>;

/// A sampler, by the type's name; a test compares the names with the source.
pub(super) struct Kind {
    pub(super) name: &'static str,
    /// How well the density of a sample must agree with that of its direction.
    bound: f64,
    reason: &'static str,
    build: fn(&SharedTarget) -> Boxed,
}

const F64: &str = "the density of a sample is that of its direction; u to 1 - 2^-53";

pub(super) const SAMPLERS: &[Kind] = &[
    Kind {
        name: "Uniform",
        bound: 1e-9,
        reason: F64,
        build: |_| Box::new(Uniform),
    },
    Kind {
        name: "Cosine",
        bound: 1e-9,
        reason: F64,
        build: |_| Box::new(Cosine),
    },
    Kind {
        name: "Hvt",
        bound: 1e-6,
        reason: "the table is interpolated in f32: sampling mixes four nodes by rows, evaluation by columns, eight roundings of 6e-8",
        build: |f| {
            Box::new(Hvt::new(
                Target::new(&|i, o| f(i, o)),
                Preset::Tiny.options(),
            ))
        },
    },
    Kind {
        name: "Inversion",
        bound: 1e-9,
        reason: F64,
        build: |f| {
            let options = InversionOptions {
                n_theta: 12,
                n_phi: 1,
                n_a: 24,
                n_b: 12,
                ..InversionOptions::default()
            };
            Box::new(Inversion::new(Target::new(&|i, o| f(i, o)), options))
        },
    },
    Kind {
        name: "Dictionary",
        bound: 1e-9,
        reason: F64,
        build: |f| Box::new(Dictionary::new(Target::new(&|i, o| f(i, o)))),
    },
    Kind {
        name: "Rejection",
        bound: 1e-9,
        reason: F64,
        build: |f| {
            let options = RejectionOptions {
                proposal: Proposal::Cosine,
                n_theta: 7,
                n_phi: 6,
                max_tries: 40,
            };
            Box::new(Rejection::new(Arc::clone(f), Symmetry::FULL, options))
        },
    },
];

pub(super) fn cases() -> Vec<Case> {
    SAMPLERS
        .iter()
        .flat_map(|kind| {
            [
                Case::new(
                    format!("sampler/{}/ends of u", kind.name),
                    kind.bound,
                    kind.reason,
                    move |effort, tally| each_target(effort, tally, |n, f, tally| scalars(&*(kind.build)(f), n, tally)),
                ),
                Case::new(
                    format!("sampler/{}/f32 lanes", kind.name),
                    2e-2,
                    "f32 directions in a chart that spreads 1e-4 rad over several nodes; u to 1 - 2^-24",
                    move |effort, tally| each_target(effort, tally, |n, f, tally| lanes(&*(kind.build)(f), n, tally)),
                ),
                Case::new(
                    format!("sampler/{}/density anywhere", kind.name),
                    0.0,
                    "finite and not negative in both precisions: opposite, equal, grazing, mirrored directions",
                    move |effort, tally| each_target(effort, tally, |n, f, tally| anywhere(&*(kind.build)(f), n, effort, tally)),
                ),
            ]
        })
        .chain([Case::new(
            "sampler/RglTable/ends of u",
            1e-6,
            "the file's own f32 tables; u to 1 - 2^-53",
            |_, tally| {
                for content in [Content::Zero, Content::Spike] {
                    match super::rgl::table(content) {
                        Some(table) => scalars(&*table, &format!("{content:?}"), tally),
                        None => tally.error(f64::INFINITY, || "could not be built".into()),
                    }
                }
            },
        )])
        .collect()
}

/// Calls `f` with every target, several at once.
fn each_target(
    effort: Effort,
    tally: &mut Tally,
    f: impl Fn(&str, &SharedTarget, &mut Tally) + Sync,
) {
    tally.each(&targets(effort), |(name, target), tally| {
        f(name, target, tally);
    });
}

fn targets(effort: Effort) -> Vec<(String, SharedTarget)> {
    let mut all: Vec<(String, SharedTarget)> = vec![
        ("black".into(), Arc::new(|_, _| 0.0)),
        ("1e-30".into(), Arc::new(|_, _| 1e-30)),
        ("1e30".into(), Arc::new(|_, _| 1e30)),
    ];
    let names = [
        "ggx:alpha=0.0001,f0=1",
        "ward-duer:alpha=0.0001,ks=0.9,kd=1e-6",
        "phong:n=1000000,ks=1,kd=0",
        "ggx:alpha=1,f0=0.04",
    ];
    for text in names.into_iter().take(effort.pick(1, names.len())) {
        if let Ok(model) = parse_model(text) {
            let brdf = model.built.brdf;
            all.push((text.into(), Arc::new(move |i, o| brdf.eval(i, o)[1])));
        }
    }
    let grids = KINDS
        .iter()
        .filter(|k| k.name == "Gridded linear" || k.name == "Gridded nearest");
    for kind in grids {
        for content in [Content::Zero, Content::Spike] {
            if let Some(table) = (kind.make)(content) {
                all.push((format!("{} {content:?}", kind.name), of_table(table)));
            }
        }
    }
    all
}

fn of_table(table: Arc<dyn Measured>) -> SharedTarget {
    Arc::new(move |wi: DVec3, wo: DVec3| {
        let mut out = [0.0; 3];
        table.eval_native(wi, wo, &mut out);
        out[1]
    })
}

/// Numbers in [0, 1), the ends included.
const US: [f64; 6] = [
    0.0,
    1e-9,
    0.37,
    0.93,
    1.0 - 1.0 / 16_777_216.0,
    1.0 - f64::EPSILON / 2.0,
];

/// Whether u is away from its ends, where a hair decides on which side of a seam of the table its direction lies.
fn inside(u: [f64; 2]) -> bool {
    u.iter().all(|u| (0.01..0.99).contains(u))
}

/// Whether the half vector is away from the pole, where the density of the half-vector tables goes like 1/theta_h: a
/// direction knows theta_h there as well as its own rounding, 1e-16 or 6e-8, permits. Closer, it need only be finite.
fn known(wi: DVec3, wo: DVec3, least: f64) -> bool {
    let h = wi + wo;
    h.x.hypot(h.y) > least * h.z.max(0.1)
}

fn scalars(sampler: &dyn DirectionSampler, target: &str, tally: &mut Tally) {
    for wo in viewers() {
        for (x, y) in US.into_iter().flat_map(|x| US.map(|y| (x, y))) {
            let Some(s) = sampler.sample(wo, DVec2::new(x, y)) else {
                tally.count += 1;
                continue;
            };
            let place = || format!("{target}, wo {wo}, u {x} {y}, wi {}", s.wi);
            tally.sound(s.pdf, place);
            if inside([x, y]) && known(s.wi, wo, 1e-6) {
                tally.value(s.pdf, sampler.pdf(s.wi, wo), 1e-9, place);
            }
            tally.error((s.wi.length() - 1.0).abs(), || {
                format!("length, {}", place())
            });
            let below = if s.wi.z > 0.0 { 0.0 } else { 1.0 };
            tally.error(below, || format!("below the horizon, {}", place()));
        }
    }
}

fn anywhere(sampler: &dyn DirectionSampler, target: &str, effort: Effort, tally: &mut Tally) {
    for chunk in pairs(effort.pick(29, 3)).chunks(LANES) {
        let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
        for (k, (i, o)) in chunk.iter().enumerate() {
            wi.set(k, in_f32(i.w));
            wo.set(k, in_f32(*o));
        }
        let pdf = sampler.pdf_lanes(&wi, &wo);
        for (k, (i, o)) in chunk.iter().enumerate() {
            let place = || format!("{target}, {}, wi {}, wo {o}", i.what, i.w);
            tally.sound(sampler.pdf(i.w, *o), place);
            tally.sound(f64::from(pdf[k]), || format!("f32, {}", place()));
        }
    }
}

fn lanes(sampler: &dyn DirectionSampler, target: &str, tally: &mut Tally) {
    let u: Vec<_> = US[..5]
        .iter()
        .flat_map(|x| US[..5].iter().map(move |y| (*x, *y)))
        .collect();
    for wo in viewers() {
        for chunk in u.chunks(LANES) {
            let (mut viewer, mut both) = (Lanes3::ZERO, [[0.0; LANES]; 2]);
            for (k, (x, y)) in chunk.iter().enumerate() {
                viewer.set(k, wo.as_vec3());
                (both[0][k], both[1][k]) = (*x as f32, *y as f32);
            }
            let s = sampler.sample_lanes(&viewer, &both);
            for k in 0..chunk.len() {
                let (i, o) = (s.wi.get(k).as_dvec3(), viewer.get(k).as_dvec3());
                let place = || format!("{target}, wo {o}, u {:?}, wi {i}", chunk[k]);
                let pdf = f64::from(s.pdf[k]);
                tally.sound(pdf, place);
                if pdf > 0.0 {
                    if inside([chunk[k].0, chunk[k].1]) && known(i, o, 1e-3) {
                        tally.value(pdf, sampler.pdf(i, o), 1e-6, place);
                    }
                    tally.error((i.length() - 1.0).abs(), || format!("length, {}", place()));
                }
            }
        }
    }
}
