//! Milliseconds to prepare a basis, nanoseconds a colour difference.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use spectrum::{Basis, ciede2000, lab_from_xyz};
use std::hint::black_box;

fn weights(c: &mut Criterion) {
    let mut group = c.benchmark_group("spectrum/basis");
    for n in [31_u16, 401] {
        let step = 300.0 / f64::from(n - 1);
        let bands = Basis::Bands((0..n).map(|k| 400.0 + step * f64::from(k)).collect());
        group.throughput(Throughput::Elements(u64::from(n)));
        group.bench_function(format!("to_linear_srgb/{n} bands"), |b| {
            b.iter(|| black_box(&bands).to_linear_srgb());
        });
    }
    group.finish();
    let mut group = c.benchmark_group("spectrum/difference");
    group.throughput(Throughput::Elements(1));
    let white = [0.95047, 1.0, 1.08883];
    group.bench_function("lab_from_xyz", |b| {
        b.iter(|| lab_from_xyz(black_box([0.2, 0.3, 0.1]), white));
    });
    group.bench_function("ciede2000", |b| {
        b.iter(|| {
            ciede2000(
                black_box([50.0, 20.0, -30.0]),
                black_box([52.0, 18.0, -31.0]),
            )
        });
    });
    group.finish();
}

criterion_group!(benches, weights);
criterion_main!(benches);
