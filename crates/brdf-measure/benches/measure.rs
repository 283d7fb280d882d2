//! Time to make a table from a model.

use brdf_measure::{Instrument, MERL_DIMS, measure_merl};
use brdf_models::parse_model;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

fn merl(c: &mut Criterion) {
    let mut group = c.benchmark_group("brdf-measure/merl");
    group.sample_size(10);
    group.throughput(Throughput::Elements(
        MERL_DIMS.iter().map(|n| u64::from(*n)).product(),
    ));
    for text in [
        "lambert",
        "ggx:alpha=0.1,index=cu",
        "ward:alpha=0.1",
        "cook-torrance:m=0.2,f0=0.05",
    ] {
        let Ok(model) = parse_model(text) else {
            continue;
        };
        group.bench_function(text, |b| {
            b.iter(|| {
                measure_merl(
                    black_box(&*model.built.brdf),
                    MERL_DIMS,
                    &Instrument::default(),
                    0,
                )
            });
        });
    }
    let Ok(model) = parse_model("ggx:alpha=0.1,index=cu") else {
        return;
    };
    let noisy = Instrument {
        noise: 0.05,
        ..Instrument::default()
    };
    group.bench_function("ggx, 5 % noise", |b| {
        b.iter(|| measure_merl(black_box(&*model.built.brdf), MERL_DIMS, &noisy, 0));
    });
}

criterion_group!(benches, merl);
criterion_main!(benches);
