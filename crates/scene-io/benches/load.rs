//! From a 35 MB MERL file on disk to a material that can be sampled, and EXR out.

use brdf_measure::{Instrument, MERL_DIMS, measure_merl};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use scene_io::image::{Picture, write_exr};
use scene_io::material::{MaterialOptions, load_measured, material_rgb};
use scene_io::scene::SamplerName;
use scene_io::{Cache, write};

fn load(c: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("ggx.binary");
    let model = brdf_models::parse_model("ggx:alpha=0.1").expect("a known model");
    let file = measure_merl(&*model.built.brdf, MERL_DIMS, &Instrument::default(), 0)
        .expect("a perfect instrument");
    write::bytes(&path, &file.to_bytes()).expect("a writable folder");

    let mut group = c.benchmark_group("scene-io/merl");
    group.sample_size(10);
    group.throughput(Throughput::Elements(file.cells() as u64));
    let options = MaterialOptions::default();
    group.bench_function("load", |b| b.iter(|| load_measured(&path, &options)));
    let loaded = load_measured(&path, &options).expect("a sound file");
    for sampler in [SamplerName::Hvt, SamplerName::Inversion] {
        let options = MaterialOptions { sampler, ..options };
        group.bench_function(format!("material/{sampler}"), |b| {
            b.iter(|| material_rgb(&loaded, &options, &Cache::default()));
        });
    }
    group.finish();

    let mut group = c.benchmark_group("scene-io/exr");
    group.sample_size(10);
    group.throughput(Throughput::Elements(640 * 480));
    let pixels = (0..640 * 480).map(|k| [(k as f32).sin(); 3]).collect();
    let picture = Picture::new(640, 480, pixels).expect("a sound picture");
    let out = folder.path().join("out.exr");
    group.bench_function("write", |b| b.iter(|| write_exr(&out, &picture)));
    group.finish();
}

criterion_group!(benches, load);
criterion_main!(benches);
