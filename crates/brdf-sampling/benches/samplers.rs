//! Cost of building samplers, of drawing directions and of densities.
//!
//! Sampling and densities are measured in CPU time of the thread, so that a busy machine does not show; packets run
//! under the widest instruction set there is, as a renderer runs them.

use brdf::DirectionSampler;
use brdf_sampling::{
    Cosine, Hvt, Inversion, InversionOptions, PacketCalls, Preset, SingleCalls, Target, Uniform,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;

mod cpu_time;

use cpu_time::CpuTime;

const COUNT: usize = 4096;

/// A gloss lobe 3 degrees wide over a diffuse floor; twenty nanoseconds, so that builds show the samplers.
fn gloss(wi: DVec3, wo: DVec3) -> f64 {
    let h = wi + wo;
    let q = 1.0 + (h.x * h.x + h.y * h.y) / (0.0025 * h.z * h.z);
    0.1 + 20.0 / (q * q)
}

fn cost(c: &mut Criterion<CpuTime>) {
    let target = Target::new(&gloss);
    cost_of(c, "uniform", &Uniform);
    cost_of(c, "cosine", &Cosine);
    let inversion = Inversion::new(target, InversionOptions::default());
    cost_of(c, "inversion", &inversion);
    for (name, preset) in [("hvt-default", Preset::Default), ("hvt-fine", Preset::Fine)] {
        cost_of(c, name, &Hvt::new(target, preset.options()));
    }
}

fn cost_of<S: DirectionSampler>(c: &mut Criterion<CpuTime>, name: &str, sampler: &S) {
    let (single, packets) = (
        SingleCalls::new(sampler, COUNT),
        PacketCalls::new(sampler, COUNT),
    );
    let mut group = c.benchmark_group("brdf-sampling/scalar");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function(format!("sample/{name}"), |b| {
        b.iter(|| single.sample(sampler));
    });
    group.bench_function(format!("pdf/{name}"), |b| b.iter(|| single.pdf(sampler)));
    group.finish();
    let mut group = c.benchmark_group("brdf-sampling/lanes");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function(format!("sample/{name}"), |b| {
        b.iter(|| packets.sample(sampler));
    });
    group.bench_function(format!("pdf/{name}"), |b| b.iter(|| packets.pdf(sampler)));
    group.finish();
}

fn build(c: &mut Criterion) {
    let target = Target::new(&gloss);
    let mut group = c.benchmark_group("brdf-sampling/build");
    group.sample_size(10);
    for preset in Preset::ALL {
        group.bench_function(format!("hvt/{preset:?}"), |b| {
            b.iter(|| Hvt::new(target, preset.options()));
        });
    }
    group.bench_function("inversion", |b| {
        b.iter(|| Inversion::new(target, InversionOptions::default()));
    });
    group.finish();
}

criterion_group! {
    name = costs;
    config = Criterion::default().with_measurement(CpuTime);
    targets = cost
}
criterion_group!(building, build);
criterion_main!(costs, building);
