//! Measured files of the data folders, if there are any.

use scene_io::material::{MaterialOptions, load_measured, material_rgb};
use scene_io::scene::SamplerName;
use scene_io::{Cache, DataDirs, Overrides, Places, SceneFile, build_scene};
use std::path::Path;

fn data() -> Option<DataDirs> {
    testkit::data_dir_or_skip().map(|folder| DataDirs::new([folder]))
}

#[test]
fn slow_cornell_and_rgl_files_become_materials() {
    let Some(data) = data() else { return };
    for (name, sampler) in [
        ("garnet_red_RGB.astm", SamplerName::Hvt),
        ("garnet_red.brdf", SamplerName::Hvt),
        ("krylon_blue_RGB.astm", SamplerName::Hvt),
        ("paper_white_rgb.bsdf", SamplerName::Native),
        ("cc_ibiza_sunset_rgb.bsdf", SamplerName::Hvt),
    ] {
        let path = data.find(Path::new(name), Path::new("")).unwrap();
        let options = MaterialOptions {
            sampler,
            ..MaterialOptions::default()
        };
        let loaded = load_measured(&path, &options).unwrap_or_else(|e| panic!("{e}"));
        let (_, report) = material_rgb(&loaded, &options, &Cache::default()).unwrap();
        println!("{name}: {} {report:?}", loaded.format.name);
        assert_eq!(report.name, sampler, "{name}");
    }
}

#[test]
fn slow_garnet_red_is_built_both_ways() {
    let Some(data) = data() else { return };
    let places = Places {
        data,
        ..Places::default()
    };
    for name in ["garnet-red", "garnet-red-thesis", "krylon-blue"] {
        let path = crate::scenes::folder()
            .join("thesis")
            .join(name)
            .join("scene.ron");
        let scene = SceneFile::load(&path).unwrap();
        let built = build_scene(scene, &Overrides::default(), &places);
        let built = built.unwrap_or_else(|e| panic!("{e}"));
        println!("{name}: {:?}", built.materials[0]);
    }
}
