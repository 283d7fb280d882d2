//! How fast each reader takes a file: bytes a second.

use brdf_formats::{AstmFile, Channels, MerlFile, MerlReader, PbrtTextFile};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

fn merl(c: &mut Criterion) {
    let value = |channel: usize, cell: usize| (channel * 7 + cell % 1009) as f64 - 1.0;
    let file = MerlFile::from_fn([90, 90, 180], value).expect("sound dims");
    let bytes = file.to_bytes();
    let mut group = c.benchmark_group("brdf-formats/merl");
    group.throughput(Throughput::Bytes(bytes.len() as u64));
    group.sample_size(20);
    group.bench_function(BenchmarkId::new("planes to f32", bytes.len()), |b| {
        b.iter(|| {
            let mut values = Vec::with_capacity(3 * file.cells());
            for channel in 0..3 {
                values.extend(file.plane(channel).map(|v| v as f32));
            }
            black_box(values)
        });
    });
    group.bench_function(BenchmarkId::new("reader to f32", bytes.len()), |b| {
        b.iter(|| {
            let reader = MerlReader::new(&bytes[..], bytes.len() as u64).expect("sound");
            let mut values = Vec::with_capacity(3 * reader.cells() as usize);
            let mut plane = vec![0.0; reader.cells() as usize / 90];
            for channel in 0..3 {
                for h in 0..90 {
                    let first = (h * plane.len()) as u64;
                    reader.read(channel, first, &mut plane).expect("sound");
                    values.extend(plane.iter().map(|&v| v as f32));
                }
            }
            black_box(values)
        });
    });
    group.finish();
}

/// Rows on Cornell's grid size with values of the usual print, six decimals.
fn rows(count: usize, channels: usize) -> Vec<f64> {
    let printed = |v: f64| (v * 1e6).round() / 1e6;
    let number = |i: usize| printed(((i * 7919) % 1571) as f64 / 1000.0 * 0.999_937);
    (0..count * (4 + channels)).map(number).collect()
}

fn text(c: &mut Criterion) {
    let mut group = c.benchmark_group("brdf-formats/text");
    for bands in [3_usize, 31, 65] {
        let nm: Vec<f64> = (0..bands).map(|i| 400.0 + 5.0 * i as f64).collect();
        let channels = match bands {
            3 => Channels::Rgb,
            _ => Channels::Wavelengths(nm.clone()),
        };
        let astm = AstmFile::new(&[], channels, rows(1439, bands)).expect("sound");
        let bytes = astm.to_bytes();
        group.throughput(Throughput::Bytes(bytes.len() as u64));
        group.bench_function(BenchmarkId::new("astm read", bands), |b| {
            b.iter(|| AstmFile::from_bytes(black_box(&bytes)).expect("sound"));
        });
        group.bench_function(BenchmarkId::new("astm write", bands), |b| {
            b.iter(|| black_box(&astm).to_bytes());
        });
        let pbrt = PbrtTextFile::new(&[], nm, rows(1439, bands)).expect("sound");
        let bytes = pbrt.to_bytes();
        group.throughput(Throughput::Bytes(bytes.len() as u64));
        group.bench_function(BenchmarkId::new("pbrt-text read", bands), |b| {
            b.iter(|| PbrtTextFile::from_bytes(black_box(&bytes)).expect("sound"));
        });
    }
    group.finish();
}

criterion_group!(benches, merl, text);
criterion_main!(benches);
