//! Half and difference angles, and a native spectrum projected to RGB.

use brdf::{Brdf, HalfDiff, Measured, Projected, Status, Symmetry, direction};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use spectrum::Basis;
use std::hint::black_box;

/// Pairs of directions a round.
const PAIRS: u32 = 1024;

struct Flat(Basis);

impl Measured for Flat {
    fn basis(&self) -> &Basis {
        &self.0
    }
    fn eval_native(&self, _: DVec3, _: DVec3, out: &mut [f64]) -> Status {
        out.fill(0.3);
        Status::Interpolated
    }
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

/// Pairs spread over the hemisphere by the golden ratio.
fn pairs() -> Vec<(DVec3, DVec3)> {
    let at = |k: u32, step: f64| {
        direction(
            (f64::from(k) * step).fract() * 1.5,
            f64::from(k) * 2.399_963,
        )
    };
    (0..PAIRS)
        .map(|k| (at(k, 0.618_034), at(k + 7, 0.754_878)))
        .collect()
}

fn half_diff(c: &mut Criterion) {
    let pairs = pairs();
    let mut group = c.benchmark_group("brdf/half_diff");
    group.throughput(Throughput::Elements(u64::from(PAIRS)));
    group.bench_function("from directions", |b| {
        b.iter(|| {
            pairs
                .iter()
                .map(|(wi, wo)| HalfDiff::new(black_box(*wi), *wo).theta_h)
                .sum::<f64>()
        });
    });
    group.finish();
}

fn projected(c: &mut Criterion) {
    let pairs = pairs();
    let nm: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
    let matrix = Basis::Bands(nm.clone()).to_linear_srgb();
    let Some(brdf) = Projected::<_, 3>::new(Flat(Basis::Bands(nm)), matrix) else {
        return;
    };
    let mut group = c.benchmark_group("brdf/projected");
    group.throughput(Throughput::Elements(u64::from(PAIRS)));
    group.bench_function("31 bands to RGB", |b| {
        b.iter(|| {
            pairs
                .iter()
                .map(|(wi, wo)| brdf.eval(black_box(*wi), *wo)[0])
                .sum::<f64>()
        });
    });
    group.finish();
}

criterion_group!(benches, half_diff, projected);
criterion_main!(benches);
