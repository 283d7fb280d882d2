//! Every registered model: against 160 bits, its f32 lanes against f64, and its sampler.

use crate::case::{Case, Effort};
use crate::grid::{Named, in_f32, models, pairs, settings, viewers};
use crate::reference::{Args, REFERENCES};
use crate::tally::Tally;
use brdf::{LANES, Lanes3, SamplePacket};
use brdf_models::{ModelInfo, ParsedModel};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Values below this are not told apart from zero: so dark a lobe is nothing to any renderer or instrument.
const FLOOR: f64 = 1e-60;
/// The same for f32 lanes.
const FLOOR_F32: f64 = 1e-30;

pub(super) fn cases() -> Vec<Case> {
    models().flat_map(of_model).collect()
}

fn of_model(info: &'static ModelInfo) -> Vec<Case> {
    let name = |what: &str| format!("model/{}/{what}", info.name);
    let (bound, reason) = bound(info);
    let reference = REFERENCES.iter().find(|r| r.model == info.name);
    let mut all = vec![Case::new(name("f"), bound, reason, move |effort, tally| {
        let Some(reference) = reference else {
            tally.error(f64::INFINITY, || "no reference of 160 bits".into());
            return;
        };
        each_pair(
            info,
            effort,
            tally,
            |tally, model, peak, [wi, wo], place| {
                let args = Args::new(&model.values, CHANNEL, wi, wo);
                let f = model.built.brdf.eval(wi, wo)[CHANNEL];
                let exact = (reference.f)(&args).to_f64();
                compare(info, tally, [f, exact], FLOOR, peak, place);
            },
        );
    })];
    if let Some(pdf) = reference.map(|r| r.pdf) {
        all.push(Case::new(
            name("pdf"),
            1e-9,
            "as f",
            move |effort, tally| {
                each_pair(info, effort, tally, |tally, model, _, [wi, wo], place| {
                    let args = Args::new(&model.values, CHANNEL, wi, wo);
                    let value = model.built.sampler.pdf(wi, wo);
                    tally.value(value, pdf(&args).to_f64(), FLOOR, place);
                });
            },
        ));
    }
    all.extend([
        Case::new(
            name("f32 lanes"),
            1e-4,
            "f32 rounding of a dozen steps, grown by the exponents of lobes",
            move |effort, tally| lanes(info, effort, tally),
        ),
        Case::new(
            name("sampler"),
            1e-11,
            "the pdf of a sample is that of its direction; u from 0 to 1 - 2^-53",
            move |effort, tally| sampler(info, effort, tally),
        ),
        Case::new(
            name("f32 sampler"),
            1e-3,
            "the pdf of f32 samples against f64 at the direction returned; u from 0 to 1 - 2^-24",
            move |effort, tally| sampler_lanes(info, effort, tally),
        ),
    ]);
    all
}

/// What error f may have, and why.
fn bound(info: &ModelInfo) -> (f64, &'static str) {
    if info.name == "he" {
        return (
            1e-4,
            "the series as an integral from a saddle point of 22 on, cut at e^-22 of its peak: documented as 2e-5",
        );
    }
    if info.laws.non_negative {
        (
            1e-9,
            "a power n = 1e6 of a cosine sees the 1e-16 of its directions as 2e-10; exponents up to 700 as 1e-13",
        )
    } else {
        (
            1e-9,
            "relative to the largest magnitude over the grid: a sum that changes its sign has no digits at its zeros",
        )
    }
}

/// Compares a value with its reference as the model's laws demand: one that may be negative is measured against its
/// peak.
fn compare(
    info: &ModelInfo,
    tally: &mut Tally,
    [value, exact]: [f64; 2],
    floor: f64,
    peak: f64,
    place: impl Fn() -> String,
) {
    if info.laws.non_negative {
        tally.value(value, exact, floor, place);
    } else {
        tally.signed(value, exact, peak, place);
    }
}

/// Checks a value that has no reference: finite, and not negative if the model promises that.
fn check(info: &ModelInfo, tally: &mut Tally, value: f64, place: impl Fn() -> String) {
    if info.laws.non_negative {
        tally.sound(value, place);
    } else {
        tally.number(value, place);
    }
}

/// The largest |f| of a model over some pairs; [`FLOOR`] for one that is black.
fn peak(model: &ParsedModel<3>, pairs: &[(Named, DVec3)]) -> f64 {
    let values = pairs
        .iter()
        .flat_map(|(wi, wo)| model.built.brdf.eval(wi.w, *wo));
    values.fold(FLOOR, |most, f| most.max(f.abs()))
}

/// The channel that is compared, so that per-channel parameters are told apart.
const CHANNEL: usize = 1;

/// Steps through the grid of pairs: primes, so that every part of it is met.
fn step(effort: Effort) -> usize {
    effort.pick(199, 11)
}

/// Calls `f` with every setting of a model, its largest |f|, every pair, and a text that says which.
fn each_pair(
    info: &'static ModelInfo,
    effort: Effort,
    tally: &mut Tally,
    f: impl Fn(&mut Tally, &ParsedModel<3>, f64, [DVec3; 2], &dyn Fn() -> String) + Sync,
) {
    let pairs = pairs(step(effort));
    tally.each(&settings(info), |model, tally| {
        let peak = peak(model, &pairs);
        for (wi, wo) in &pairs {
            let place = || format!("{model}, {}, wi {}, wo {wo}", wi.what, wi.w);
            f(tally, model, peak, [wi.w, *wo], &place);
        }
    });
}

fn lanes(info: &'static ModelInfo, effort: Effort, tally: &mut Tally) {
    let pairs = pairs(step(effort));
    tally.each(&settings(info), |model, tally| {
        let peak = peak(model, &pairs);
        for chunk in pairs.chunks(LANES) {
            let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
            for (k, (i, o)) in chunk.iter().enumerate() {
                wi.set(k, in_f32(i.w));
                wo.set(k, in_f32(*o));
            }
            let f = model.built.brdf.eval_lanes(&wi, &wo);
            let pdf = model.built.sampler.pdf_lanes(&wi, &wo);
            for (k, (named, _)) in chunk.iter().enumerate() {
                let (i, o) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                let place =
                    |what: &str| format!("{what} of {model}, {}, wi {i}, wo {o}", named.what);
                let exact = model.built.brdf.eval(i, o);
                for c in 0..3 {
                    let both = [f64::from(f[c][k]), exact[c]];
                    compare(info, tally, both, FLOOR_F32, peak, || place("f"));
                }
                let exact = model.built.sampler.pdf(i, o);
                tally.value(f64::from(pdf[k]), exact, FLOOR_F32, || place("pdf"));
            }
        }
    });
}

/// Numbers a sampler is driven with: the ends, and the middle.
fn us(end: f64) -> [f64; 6] {
    [0.0, 1e-12, 0.3, 0.5, 0.9, end]
}

fn sampler(info: &'static ModelInfo, _: Effort, tally: &mut Tally) {
    let end = 1.0 - f64::EPSILON / 2.0;
    tally.each(&settings(info), |model, tally| {
        for wo in viewers() {
            for (u, v) in us(end).into_iter().flat_map(|u| us(end).map(|v| (u, v))) {
                let Some(s) = model.built.sampler.sample(wo, DVec2::new(u, v)) else {
                    continue;
                };
                let place = || format!("{model}, wo {wo}, u {u} {v}, wi {}", s.wi);
                let pdf = model.built.sampler.pdf(s.wi, wo);
                tally.value(s.pdf, pdf, FLOOR, place);
                tally.error((s.wi.length() - 1.0).abs(), || {
                    format!("length at {}", place())
                });
                for f in model.built.brdf.eval(s.wi, wo) {
                    check(info, tally, f * s.wi.z / s.pdf, || {
                        format!("weight at {}", place())
                    });
                }
            }
        }
    });
}

fn sampler_lanes(info: &'static ModelInfo, _: Effort, tally: &mut Tally) {
    let end = 1.0 - f64::from(f32::EPSILON) / 2.0;
    tally.each(&settings(info), |model, tally| {
        for wo in viewers() {
            for v in us(end) {
                let mut packet = SamplePacket::ZERO;
                for k in 0..LANES {
                    packet.wo.set(k, in_f32(wo));
                    packet.u[0][k] = us(end)[k % 6] as f32;
                    packet.u[1][k] = (v + (k / 6) as f64 / TAU).fract().min(end) as f32;
                }
                let mut packets = [packet];
                model.built.material.sample(&mut packets);
                for k in 0..LANES {
                    sampled(model, &packets[0], k, tally);
                }
            }
        }
    });
}

/// Lane `k` of what a material sampled.
fn sampled(model: &ParsedModel<3>, packet: &SamplePacket<3>, k: usize, tally: &mut Tally) {
    let (wi, wo) = (packet.wi.get(k).as_dvec3(), packet.wo.get(k).as_dvec3());
    let place = || {
        format!(
            "{model}, wo {wo}, u {} {}, wi {wi}",
            packet.u[0][k], packet.u[1][k]
        )
    };
    let pdf = f64::from(packet.pdf[k]);
    tally.sound(pdf, || format!("pdf at {}", place()));
    for c in 0..3 {
        check(model.info, tally, f64::from(packet.weight[c][k]), || {
            format!("weight at {}", place())
        });
    }
    if pdf > 0.0 {
        tally.value(pdf, model.built.sampler.pdf(wi, wo), FLOOR_F32, place);
        tally.error((wi.length() - 1.0).abs(), || {
            format!("length at {}", place())
        });
    }
}
