//! What channels cost: the thesis' stage in every mode, with the same samples, in one run.
//!
//! Needs `garnet_red.brdf` in `GONIO_DATA`; without it nothing is measured.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use scene_io::scene::{MaterialSpec, SpectrumName};
use scene_io::{Cache, DataDirs, Overrides, Places, SceneFile, build_any_scene};
use std::path::Path;
use std::time::Duration;

const SIZE: (u32, u32) = (160, 120);
const SPP: u32 = 32;

fn spectra(c: &mut Criterion) {
    let Some(folder) = testkit::data_dir_or_skip() else {
        return;
    };
    let kept = tempfile::tempdir().expect("a temporary folder");
    let places = Places {
        data: DataDirs::new([folder]),
        cache: Cache::at(kept.path().to_owned()),
    };
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/thesis/base.ron");
    let mut group = c.benchmark_group("scene-io/spectra");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(3));
    group.throughput(Throughput::Elements(u64::from(SIZE.0 * SIZE.1 * SPP)));
    for &name in SpectrumName::ALL {
        let overrides = Overrides {
            material: Some(MaterialSpec::from_argument("garnet_red.brdf")),
            spectrum: Some(name),
            size: Some(SIZE),
            spp: Some(SPP),
            ..Overrides::default()
        };
        let file = SceneFile::load(&scene).expect("a scene of this repository");
        let built = build_any_scene(file, &overrides, &places).expect("a scene that can be built");
        group.bench_function(name.name(), |b| {
            b.iter(|| {
                let mut film = built.scene.film([SIZE.0, SIZE.1], 8);
                built
                    .scene
                    .render(&built.settings, &mut film, &())
                    .expect("a film of its own mode");
                film
            });
        });
    }
    group.finish();
}

criterion_group!(benches, spectra);
criterion_main!(benches);
