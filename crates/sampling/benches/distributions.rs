//! Nanoseconds a sample of tabulated and closed-form distributions.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec2;
use sampling::{AliasTable, Piecewise1, Piecewise2, Rng, warp};
use std::hint::black_box;

/// Random numbers every bench walks through.
fn numbers() -> Vec<DVec2> {
    let mut rng = Rng::new(1);
    (0..4096).map(|_| rng.uniform2()).collect()
}

fn weights(n: usize) -> Vec<f64> {
    let mut rng = Rng::new(2);
    (0..n).map(|_| rng.normal().abs().powi(4)).collect()
}

fn distributions(c: &mut Criterion) {
    let numbers = numbers();
    let mut group = c.benchmark_group("sampling/distributions");
    group.throughput(Throughput::Elements(numbers.len() as u64));
    let mut bench = |name: &str, sample: &dyn Fn(DVec2) -> f64| {
        group.bench_function(name, |b| {
            b.iter(|| {
                for u in &numbers {
                    black_box(sample(*u));
                }
            });
        });
    };
    let values = weights(1024);
    if let (Ok(constant), Ok(linear), Ok(alias)) = (
        Piecewise1::constant(&values),
        Piecewise1::linear(&values),
        AliasTable::new(&values),
    ) {
        bench("Piecewise1 constant/1024", &|u| constant.sample(u.x).0);
        bench("Piecewise1 linear/1024", &|u| linear.sample(u.x).0);
        bench("Piecewise1 linear pdf/1024", &|u| linear.pdf(u.x));
        bench("AliasTable/1024", &|u| alias.sample(u.x).1);
    }
    // The degenerate case: all mass in one cell of many.
    let mut spike = vec![1e-6; 1024];
    spike[700] = 1e6;
    if let Ok(spike) = Piecewise1::constant(&spike) {
        bench("Piecewise1 spike/1024", &|u| spike.sample(u.x).0);
    }
    let image = weights(512 * 256);
    if let (Ok(constant), Ok(bilinear)) = (
        Piecewise2::constant(512, &image),
        Piecewise2::bilinear(512, &image),
    ) {
        bench("Piecewise2 constant/512x256", &|u| constant.sample(u).1);
        bench("Piecewise2 bilinear/512x256", &|u| bilinear.sample(u).1);
        bench("Piecewise2 bilinear pdf/512x256", &|u| bilinear.pdf(u));
    }
    bench("cosine_hemisphere", &|u| warp::cosine_hemisphere(u).z);
    bench("ggx_half", &|u| warp::ggx_half(u, 0.1).z);
    group.finish();
}

criterion_group!(benches, distributions);
criterion_main!(benches);
