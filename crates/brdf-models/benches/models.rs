//! Nanoseconds per eval, sample and pdf of every model, scalar f64 and in f32 packets.

use brdf::{DirectionSampler, EvalPacket, LANES, SamplePacket};
use brdf_models::{MODELS, ParsedModel, parse_model};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec2, DVec3};
use sampling::{Rng, warp};
use std::hint::black_box;

const COUNT: usize = 1024;

struct Work {
    wo: Vec<DVec3>,
    u: Vec<DVec2>,
    wi: Vec<DVec3>,
}

/// Viewers uniform on the hemisphere, lights as the model itself samples them.
fn work(sampler: &dyn DirectionSampler) -> Work {
    let mut rng = Rng::new(1);
    let wo: Vec<_> = (0..COUNT)
        .map(|_| warp::uniform_hemisphere(rng.uniform2()))
        .collect();
    let u: Vec<_> = (0..COUNT).map(|_| rng.uniform2()).collect();
    let wi = wo
        .iter()
        .zip(&u)
        .map(|(wo, u)| sampler.sample(*wo, *u).map_or(DVec3::Z, |s| s.wi))
        .collect();
    Work { wo, u, wi }
}

fn scalar(c: &mut Criterion, id: &str, model: &ParsedModel<3>) {
    let w = work(&*model.built.sampler);
    let mut group = c.benchmark_group("brdf-models/scalar");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function(BenchmarkId::new("eval", id), |b| {
        b.iter(|| {
            let f =
                w.wi.iter()
                    .zip(&w.wo)
                    .map(|(wi, wo)| model.built.brdf.eval(*wi, *wo)[0]);
            black_box(f.sum::<f64>())
        });
    });
    group.bench_function(BenchmarkId::new("sample", id), |b| {
        b.iter(|| {
            let s =
                w.wo.iter()
                    .zip(&w.u)
                    .filter_map(|(wo, u)| model.built.sampler.sample(*wo, *u));
            black_box(s.map(|s| s.pdf).sum::<f64>())
        });
    });
    group.bench_function(BenchmarkId::new("pdf", id), |b| {
        b.iter(|| {
            let p =
                w.wi.iter()
                    .zip(&w.wo)
                    .map(|(wi, wo)| model.built.sampler.pdf(*wi, *wo));
            black_box(p.sum::<f64>())
        });
    });
}

fn packets(c: &mut Criterion, id: &str, model: &ParsedModel<3>) {
    let w = work(&*model.built.sampler);
    let mut evals = vec![EvalPacket::<3>::ZERO; COUNT / LANES];
    let mut samples = vec![SamplePacket::<3>::ZERO; COUNT / LANES];
    for k in 0..COUNT {
        let (p, lane) = (k / LANES, k % LANES);
        evals[p].wo.set(lane, w.wo[k].as_vec3());
        evals[p].wi.set(lane, w.wi[k].as_vec3());
        samples[p].wo.set(lane, w.wo[k].as_vec3());
        samples[p].u[0][lane] = w.u[k].x as f32;
        samples[p].u[1][lane] = w.u[k].y as f32;
    }
    let mut group = c.benchmark_group("brdf-models/packets");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function(BenchmarkId::new("eval + pdf", id), |b| {
        b.iter(|| model.built.material.eval(black_box(&mut evals)));
    });
    group.bench_function(BenchmarkId::new("sample + weight", id), |b| {
        b.iter(|| model.built.material.sample(black_box(&mut samples)));
    });
}

fn models(c: &mut Criterion) {
    for info in MODELS {
        let texts = info.examples.iter().take(1);
        for model in texts.filter_map(|t| parse_model(&format!("{}:{t}", info.name)).ok()) {
            scalar(c, info.name, &model);
            packets(c, info.name, &model);
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(800))
        .sample_size(20);
    targets = models
}
criterion_main!(benches);
