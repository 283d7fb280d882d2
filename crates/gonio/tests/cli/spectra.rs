//! `gonio spectra`, and the spectrum of a render.

use crate::program::{Bench, repository};
use testkit::data_dir_or_skip;

#[test]
fn every_mode_is_rendered_compared_and_shown() {
    let bench = Bench::new();
    bench.write("scene.ron", SCENE);
    let report = bench.json("spectra scene.ron --modes rgb,8,hero -o out");
    assert_eq!(report["reference"], "hero");
    let modes = report["modes"].as_array().unwrap();
    let names: Vec<&str> = modes.iter().map(|m| m["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["rgb", "8", "hero"]);
    let mean = |k: usize| modes[k]["delta_e_mean"].as_f64().unwrap();
    assert!(mean(0) > 0.3, "a green under A in RGB: {modes:?}");
    assert!(mean(1) > 0.0 && mean(1) < mean(0), "{modes:?}");
    assert!(mean(2).abs() < 1e-9, "the reference itself: {modes:?}");
    for file in ["rgb.exr", "8.png", "hero.exr", "sheet.png", "spectra.csv"] {
        assert!(bench.path("out").join(file).exists(), "{file}");
    }
    let table = String::from_utf8(bench.read("out/spectra.csv")).unwrap();
    assert_eq!(table.lines().count(), 4, "{table}");
    let text = bench.text("spectra scene.ron --modes 16 --reference 45 -o out");
    assert!(text.contains("CIEDE2000 from 45 over"), "{text}");
}

#[test]
fn a_render_takes_its_spectrum_from_scene_or_command() {
    let bench = Bench::new();
    bench.write("scene.ron", SCENE);
    assert_eq!(bench.json("render scene.ron -o a.exr")["spectrum"], "16");
    let spectral = scene_io::image::read_spectral_exr(&bench.path("a.exr")).unwrap();
    assert_eq!(spectral.planes.len(), 16);
    let hero = bench.json("render scene.ron --spectrum hero -o b.exr");
    assert_eq!(hero["spectrum"], "hero");
    assert!(hero["rel_rmse"].as_f64().unwrap() > 0.0, "{hero}");
    let bad = bench.run("render scene.ron --spectrum 9 -o c.exr");
    assert_eq!(bad.code, 2, "{}", bad.err);
    assert!(
        bad.err.contains("rgb, xyz, 8, 16, 45, native, hero"),
        "{}",
        bad.err
    );
    let bad = bench.run("spectra none.ron -o out");
    assert_eq!(bad.code, 1, "{}", bad.err);
}

/// The limits of the genuine Cornell spectra: mean over the pixels of sphere and vase.
#[test]
fn slow_cornell_paints_keep_their_colour() {
    let Some(data) = data_dir_or_skip() else {
        return;
    };
    let bench = Bench::new();
    let scene = repository("scenes/thesis/base.ron");
    for material in ["garnet_red.brdf", "krylon_blue.brdf"] {
        let report = bench.json(&format!(
            "spectra {scene} --material {material} --data {} --modes 8,16,45,hero --size 96x72 --spp 256 -o out",
            data.display()
        ));
        assert_eq!(report["reference"], "native");
        // the figures asked for; measured: docs/spectral.md
        for (mode, limit) in report["modes"]
            .as_array()
            .unwrap()
            .iter()
            .zip([1.6, 0.45, 0.08, 0.05])
        {
            let mean = mode["delta_e_mean"].as_f64().unwrap();
            assert!(mean > 0.0 && mean <= limit, "{material}: {mode}");
        }
    }
}

const SCENE: &str = r#"(
    camera: (position: (0, 2, 6), target: (0, 1, 0), fov_y_deg: 35),
    film: (width: 40, height: 30),
    render: (spp: 32, depth: 3, spectrum: "16"),
    main_material: "green",
    materials: { "green": Lambert(reflectance: (0.1, 0.6, 0.2)), "grey": Lambert(reflectance: 0.4) },
    shapes: [
        (form: Sphere(center: (0, 1, 0), radius: 1), material: "green"),
        (form: Quad(corner: (-9, 0, 9), edge_u: (18, 0, 0), edge_v: (0, 0, -18)), material: "grey"),
    ],
    lights: [Constant(radiance: 1, spectrum: Illuminant("A"))],
)"#;
