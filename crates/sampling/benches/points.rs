//! Nanoseconds a sample point.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use sampling::points::LANES;
use sampling::{PointSet, Points, Rng};
use std::hint::black_box;

const COUNT: u32 = 4096;

fn points(c: &mut Criterion) {
    let mut group = c.benchmark_group("sampling/points");
    group.throughput(Throughput::Elements(u64::from(COUNT)));
    for kind in [PointSet::Independent, PointSet::Halton, PointSet::Sobol] {
        let points = Points::new(kind, 1);
        group.bench_function(format!("get2/{kind:?}"), |b| {
            b.iter(|| {
                for index in 0..COUNT {
                    black_box(points.get2(black_box(5), index, 3));
                }
            });
        });
        group.bench_function(format!("get2_lanes/{kind:?}"), |b| {
            b.iter(|| {
                for first in (0..COUNT).step_by(LANES) {
                    let pixel = black_box([5; LANES]);
                    let index = std::array::from_fn(|k| first + k as u32);
                    black_box(points.get2_lanes(pixel, index, 3));
                }
            });
        });
    }
    group.bench_function("Rng", |b| {
        let mut rng = Rng::new(1);
        b.iter(|| {
            for _ in 0..COUNT {
                black_box(rng.uniform2());
            }
        });
    });
    group.finish();
}

criterion_group!(benches, points);
criterion_main!(benches);
