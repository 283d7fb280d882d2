//! Broken scenes and the one line each of them is answered with.

use scene_io::SceneFile;
use std::path::Path;

/// What every scene here needs around the part that is broken.
fn scene(fields: &str) -> String {
    format!("(\n  camera: (position: (0, 1, 5), target: (0, 1, 0)),\n  {fields}\n)")
}

/// The message, without the name of the file.
fn error(text: &str) -> String {
    let error = SceneFile::from_text(text, Path::new("scene.ron"), Path::new("nowhere"))
        .expect_err(text)
        .to_string();
    assert!(!error.contains('\n'), "one line expected: {error}");
    error
        .strip_prefix("scene.ron:")
        .expect("the file is named first")
        .trim_start()
        .to_owned()
}

const SPHERE: &str = r#"form: Sphere(center: (0, 1, 0), radius: 1), material: "m""#;

#[test]
fn a_scene_with_nothing_wrong_is_accepted() {
    let text = scene(&format!(
        r#"materials: {{ "m": Model(model: "ggx:alpha=0.1") }}, shapes: [({SPHERE})]"#
    ));
    let scene = SceneFile::from_text(&text, Path::new("scene.ron"), Path::new("")).unwrap();
    assert_eq!((scene.film.width, scene.render.depth), (640, 5));
}

/// Mistakes that RON's reader finds, with their line and column.
#[test]
fn mistakes_of_form_are_placed() {
    let cases: &[(&str, &str)] = &[
        ("film: (width: 64", ""),
        ("film: (widht: 64)", ""),
        ("film: (width: \"64\")", ""),
        ("film: (width: 0)", ""),
        ("film: (width: 99999)", ""),
        ("film: (width: 64.5)", ""),
        ("film: (width: -64)", ""),
        ("film: (filter: Mitchell)", ""),
        ("film: (filter: Gaussian(sigma: -1, radius: 2))", ""),
        ("render: (spp: 0)", ""),
        ("render: (spp: 1e9)", ""),
        ("render: (seed: -1)", ""),
        ("render: (sampler: \"bets\")", ""),
        ("render: (points: \"hammersley\")", ""),
        ("camera: (position: (0, 0, 1))", ""),
        ("materials: { \"m\": File(file: \"a.binary\") }", ""),
        ("materials: { \"m\": File() }", ""),
        (
            "materials: { \"m\": File(path: \"a\", negatives: \"drop\") }",
            "",
        ),
        ("materials: { \"m\": File(path: \"a\", scale: (1, 1)) }", ""),
        ("materials: { \"m\": Glass(ior: 1.5) }", ""),
        (
            "materials: { \"m\": Lambert(reflectance: 1), \"m\": Lambert(reflectance: 0) }",
            "",
        ),
        (
            "shapes: [(form: Sphere(center: (0, 0, 0), radius: -1), material: \"m\")]",
            "",
        ),
        (
            "shapes: [(form: Sphere(center: (0, 0), radius: 1), material: \"m\")]",
            "",
        ),
        (
            "shapes: [(form: Sphere(center: (inf, 0, 0), radius: 1), material: \"m\")]",
            "",
        ),
        (
            "shapes: [(form: UvSphere(center: (0, 0, 0), radius: 1, segments: 1000000), material: \"m\")]",
            "",
        ),
        ("shapes: [(form: Cube, material: \"m\")]", ""),
        ("lights: [Constant(radiance: -1)]", ""),
        ("lights: [Constant(radiance: (1, 2))]", ""),
        ("lights: [Constant(radiance: NaN)]", ""),
        ("lights: [Point(position: (0, 0, 0))]", ""),
        ("film: () film: ()", ""),
    ];
    for (fields, expected) in cases {
        println!(
            "        (\n            {fields:?},\n            {:?},\n        ),",
            error(&scene(fields))
        );
        let _ = expected;
    }
}
