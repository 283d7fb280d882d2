//! Scattered rows: look-up, fit and resampling.

use brdf::Measured;
use brdf_table::scattered::Geometry;
use brdf_table::{KdNearest, LayerMode, LayeredTable, SampleCloud, ThinPlate, resample};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use spectrum::Basis;
use std::hint::black_box;

/// A smooth lobe on the directions of Cornell's gonioreflectometer, in `bands` equal channels.
fn cloud(bands: u32) -> SampleCloud {
    let (mut angles, mut values) = (Vec::new(), Vec::new());
    for i in 1..=8 {
        let theta_i = f64::from(i) * 10_f64.to_radians();
        for k in 0..10 {
            let theta_o = 2.0 * (f64::from(k) / 10.0 / 2_f64.sqrt()).asin();
            for j in 0..=4 * k {
                let phi = f64::from(j) * 45_f64.to_radians() / f64::from(k.max(1));
                let h = Geometry {
                    theta_i,
                    theta_o,
                    phi,
                }
                .half_diff();
                if 2.0 * h.theta_d > 17_f64.to_radians() {
                    angles.push([theta_i, 0.0, theta_o, phi]);
                    values.extend((0..bands).map(|_| 0.05 + (-h.theta_h * 8.0).exp()));
                }
            }
        }
    }
    let wavelengths = (0..bands).map(|b| 400.0 + 10.0 * f64::from(b)).collect();
    SampleCloud::new(Basis::Bands(wavelengths), &angles, &values).expect("a valid cloud")
}

fn eval(c: &mut Criterion) {
    let mut group = c.benchmark_group("brdf-table/scattered-eval");
    group.throughput(Throughput::Elements(1));
    let (few, many) = (cloud(3), cloud(31));
    let tables: [(&str, Box<dyn Measured>); 5] = [
        (
            "layered-squared",
            Box::new(LayeredTable::new(&few, LayerMode::SquaredLambda)),
        ),
        (
            "layered-log",
            Box::new(LayeredTable::new(&few, LayerMode::LogLinear)),
        ),
        (
            "kd-nearest",
            Box::new(KdNearest::new(&few).expect("a tree")),
        ),
        (
            "thin-plate/3",
            Box::new(ThinPlate::new(&few).expect("a fit")),
        ),
        (
            "thin-plate/31",
            Box::new(ThinPlate::new(&many).expect("a fit")),
        ),
    ];
    for (name, table) in &tables {
        let mut out = vec![0.0; table.basis().len()];
        let mut k = 0_u32;
        group.bench_function(*name, |b| {
            b.iter(|| {
                k = (k + 1) % 1024;
                let u = f64::from(k) / 1024.0;
                let g = Geometry {
                    theta_i: 0.2 + u,
                    theta_o: 1.3 - u,
                    phi: 3.0 * u,
                };
                let (wi, wo) = g.directions();
                table.eval_native(wi, wo, &mut out);
                black_box(&out);
            });
        });
    }
    group.finish();
}

fn build(c: &mut Criterion) {
    let mut group = c.benchmark_group("brdf-table/scattered-build");
    group.sample_size(10);
    let (few, many) = (cloud(3), cloud(31));
    group.throughput(Throughput::Elements(few.len() as u64));
    group.bench_function("kd-nearest", |b| b.iter(|| KdNearest::new(black_box(&few))));
    group.bench_function("thin-plate/3", |b| {
        b.iter(|| ThinPlate::new(black_box(&few)))
    });
    group.bench_function("thin-plate/31", |b| {
        b.iter(|| ThinPlate::new(black_box(&many)))
    });
    let plate = ThinPlate::new(&few).expect("a fit");
    let dims = [48, 32, 24];
    group.throughput(Throughput::Elements(dims.iter().product::<usize>() as u64));
    group.bench_function("resample/48x32x24", |b| {
        b.iter(|| resample(black_box(&plate), plate.domain(), dims));
    });
    group.finish();
}

criterion_group!(benches, eval, build);
criterion_main!(benches);
