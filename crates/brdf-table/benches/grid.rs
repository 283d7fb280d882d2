//! Build and look-up times of half-difference tables.

#![expect(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use brdf::{Brdf, LANES, Lanes3, Status};
use brdf_table::{CellPolicy, GriddedN, HalfDiffTable, Interpolation, PhiDomain};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use spectrum::{Basis, RgbSpace};
use std::hint::black_box;
use std::sync::Arc;

const MERL: [usize; 3] = [90, 90, 180];
const PACKETS: usize = 4096;

/// A lobe and a diffuse floor.
fn lobe(wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
    let h = (wi + wo).normalize();
    let gloss = (-(h.x * h.x + h.y * h.y) / (0.02 * h.z * h.z)).exp();
    for (c, o) in out.iter_mut().enumerate() {
        *o = 0.1 * (c + 1) as f64 + 10.0 * gloss;
    }
    Status::Measured
}

fn table() -> Arc<HalfDiffTable> {
    let basis = Basis::Rgb(RgbSpace::srgb());
    Arc::new(HalfDiffTable::from_fn(
        MERL,
        PhiDomain::Reciprocal,
        basis,
        lobe,
    ))
}

/// Pairs of directions: independent ones, or slowly turning ones as neighbouring pixels see them.
fn packets(coherent: bool) -> Vec<(Lanes3, Lanes3)> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut uniform = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64
    };
    let mut made = Vec::with_capacity(PACKETS);
    for p in 0..PACKETS {
        let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
        for k in 0..LANES {
            let step = (p * LANES + k) as f64 * 1e-4;
            let mut at = |offset: f64| {
                if coherent {
                    brdf::direction(0.7 + 0.5 * (step + offset).sin(), offset + 0.3 * step)
                } else {
                    brdf::direction((1.0 - uniform()).acos(), std::f64::consts::TAU * uniform())
                }
            };
            wi.set(k, at(0.0).as_vec3());
            wo.set(k, at(2.5).as_vec3());
        }
        made.push((wi, wo));
    }
    made
}

fn eval(c: &mut Criterion) {
    let table = table();
    let mut group = c.benchmark_group("brdf-table/half-diff-eval");
    group.throughput(Throughput::Elements((PACKETS * LANES) as u64));
    for (order, coherent) in [("incoherent", false), ("coherent", true)] {
        let work = packets(coherent);
        for how in [Interpolation::Nearest, Interpolation::Linear] {
            let gridded = GriddedN::<3>::new(Arc::clone(&table), how).unwrap();
            group.bench_function(format!("lanes-{how:?}-{order}"), |b| {
                b.iter(|| {
                    for (wi, wo) in &work {
                        black_box(gridded.eval_lanes(wi, wo));
                    }
                });
            });
            group.bench_function(format!("f64-{how:?}-{order}"), |b| {
                b.iter(|| {
                    for (wi, wo) in &work {
                        for k in 0..LANES {
                            black_box(gridded.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3()));
                        }
                    }
                });
            });
        }
    }
    group.finish();
}

fn build(c: &mut Criterion) {
    let mut group = c.benchmark_group("brdf-table/half-diff-build");
    group.sample_size(10);
    group.throughput(Throughput::Elements((MERL[0] * MERL[1] * MERL[2]) as u64));
    group.bench_function("from-fn", |b| {
        b.iter_batched(|| (), |()| table(), BatchSize::PerIteration);
    });
    let (file, _) = table().to_merl().unwrap();
    group.bench_function("from-merl", |b| {
        b.iter(|| HalfDiffTable::from_merl(black_box(&file), CellPolicy::AnyNegative).unwrap());
    });
    group.finish();
}

criterion_group!(benches, eval, build);
criterion_main!(benches);
