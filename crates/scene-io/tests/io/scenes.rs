//! The scenes of the repository.

use scene_io::{DEFAULT_SCENE, Overrides, Places, SceneFile, build_scene, scene::MaterialSpec};
use std::path::{Path, PathBuf};

pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

fn scene_files(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            scene_files(&path, out);
        } else if path.extension().is_some_and(|e| e == "ron") {
            out.push(path);
        }
    }
}

#[test]
fn every_scene_of_the_repository_is_sound() {
    let mut files = Vec::new();
    scene_files(&folder(), &mut files);
    assert!(files.len() >= 17, "found only {files:?}");
    for path in files {
        let scene = SceneFile::load(&path).unwrap_or_else(|e| panic!("{e}"));
        assert!(
            !scene.about.is_empty(),
            "{}: about is missing",
            path.display()
        );
        assert!(
            scene.main_material.is_some(),
            "{}: main_material",
            path.display()
        );
    }
}

#[test]
fn thesis_scenes_share_a_stage_and_differ_in_material() {
    let load = |name: &str| SceneFile::load(&folder().join("thesis").join(name)).unwrap();
    let brass = load("brass/scene.ron");
    let garnet = load("garnet-red-thesis/scene.ron");
    assert_eq!((brass.render.spp, garnet.render.spp), (512, 1024));
    assert_eq!(brass.camera, garnet.camera);
    assert_eq!(brass.shapes.len(), garnet.shapes.len());
    let MaterialSpec::File(file) = &garnet.materials["measured"] else {
        panic!("expected a file, found {:?}", garnet.materials["measured"]);
    };
    assert_eq!(file.path, Path::new("garnet_red_RGB.astm"));
}

#[test]
fn the_benchmark_is_the_peers_scene() {
    let scene = SceneFile::load(&folder().join("benchmark/scene.ron")).unwrap();
    assert_eq!((scene.film.width, scene.film.height), (640, 480));
    assert_eq!(
        (scene.render.depth, scene.camera.position),
        (5, [0.0, 2.2, 6.5])
    );
    let env = SceneFile::load(&folder().join("benchmark-env/scene.ron")).unwrap();
    assert_eq!((scene.lights.len(), env.lights.len()), (0, 1));
    assert_eq!(scene.camera, env.camera);
}

#[test]
fn scenes_that_need_no_data_are_built() {
    for name in [
        "benchmark",
        "benchmark-env",
        "benchmark-mesh",
        "white-furnace",
        "closed-form",
    ] {
        let path = folder().join(name).join("scene.ron");
        let scene = SceneFile::load(&path).unwrap();
        let built = build_scene(scene, &Overrides::default(), &Places::default());
        let built = built.unwrap_or_else(|e| panic!("{e}"));
        if name == "benchmark-mesh" {
            assert_eq!(built.scene.triangles(), 65_024);
        }
    }
}

#[test]
fn what_a_scene_does_not_use_is_not_read_and_said_to_be_left_out() {
    let text = r#"(
        camera: (position: (0, 0, 5), target: (0, 0, 0)),
        main_material: "a",
        materials: { "a": Lambert(reflectance: 1), "b": File(path: "missing.binary") },
        shapes: [(form: Sphere(center: (0, 0, 0), radius: 1), material: "a")],
    )"#;
    let scene = SceneFile::from_text(text, Path::new(""), Path::new("")).unwrap();
    let built = build_scene(scene, &Overrides::default(), &Places::default()).unwrap();
    assert_eq!(built.materials.len(), 1);
    assert_eq!(
        built.left_out[0],
        "material \"b\" is on no shape: missing.binary was not read"
    );
}

#[test]
fn a_missing_material_file_names_scene_field_and_places() {
    let path = folder().join("thesis/brass/scene.ron");
    let scene = SceneFile::load(&path).unwrap();
    let error = build_scene(scene, &Overrides::default(), &Places::default()).unwrap_err();
    let text = error.to_string();
    for part in [
        "materials.measured",
        "brass.binary",
        "looked in",
        "--data DIR",
    ] {
        assert!(text.contains(part), "{part} is not in: {text}");
    }
}

#[test]
fn the_command_line_replaces_the_main_material() {
    let path = folder().join("thesis/brass/scene.ron");
    let scene = SceneFile::load(&path).unwrap();
    let overrides = Overrides {
        material: Some(MaterialSpec::from_argument("ggx:alpha=0.3")),
        spp: Some(7),
        size: Some((8, 4)),
        ..Overrides::default()
    };
    let built = build_scene(scene, &overrides, &Places::default()).unwrap();
    assert_eq!((built.settings.spp, built.size), (7, (8, 4)));
    assert_eq!(built.materials[0].name, "measured");
    assert!(
        built.materials[0].sampler.notes[0].starts_with("ggx:"),
        "{:?}",
        built.materials
    );
    let file = MaterialSpec::from_argument("brass.binary");
    assert!(matches!(file, MaterialSpec::File(_)), "{file:?}");
}

#[test]
fn the_embedded_default_needs_no_file() {
    let scene = SceneFile::from_text(DEFAULT_SCENE, Path::new(""), Path::new("")).unwrap();
    assert_eq!(scene.materials.len(), 4);
}
