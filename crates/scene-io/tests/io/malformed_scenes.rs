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
const MISTAKES_OF_FORM: &[(&str, &str)] = &[
    ("film: (width: 64", "4:1: expected comma, found `)`"),
    (
        "film: (widht: 64)",
        "3:10: film.widht: unexpected field named `widht` in `Film`, expected one of `width`, `height`, `filter`, `exposure`, or `gamut` instead",
    ),
    (
        "film: (width: \"64\")",
        "3:16: film.width: expected float, found `\"64\"`",
    ),
    (
        "film: (width: 0)",
        "3:17: film.width: expected a whole number of pixels from 1 to 32768, found 0",
    ),
    (
        "film: (width: 99999)",
        "3:17: film.width: expected a whole number of pixels from 1 to 32768, found 99999",
    ),
    (
        "film: (width: 64.5)",
        "3:17: film.width: expected a whole number of pixels from 1 to 32768, found 64.5",
    ),
    (
        "film: (width: -64)",
        "3:17: film.width: expected a whole number of pixels from 1 to 32768, found -64",
    ),
    (
        "film: (filter: Mitchell)",
        "3:18: film.filter: unexpected variant named `Mitchell` in enum `Filter`, expected either `Box` or `Gaussian` instead",
    ),
    (
        "film: (filter: Gaussian(sigma: -1, radius: 2))",
        "3:34: film.filter.Gaussian.sigma: expected a number above 0 and at most 1e7, found -1",
    ),
    (
        "render: (spp: 0)",
        "3:17: render.spp: expected a whole number of samples from 1 to 16777216, found 0",
    ),
    (
        "render: (spp: 1e9)",
        "3:17: render.spp: expected a whole number of samples from 1 to 16777216, found 1000000000",
    ),
    (
        "render: (seed: -1)",
        "3:19: render.seed: integer is out of bounds, found `1`",
    ),
    (
        "render: (sampler: \"bets\")",
        "3:22: render.sampler: expected a sampler (auto, hvt, hvt-tiny, hvt-fine, hvt-reference, dictionary, ggx-single, inversion, rejection, cosine, uniform, native), found \"bets\"",
    ),
    (
        "render: (points: \"hammersley\")",
        "3:21: render.points: expected a point set (sobol, halton, independent), found \"hammersley\"",
    ),
    (
        "camera: (position: (0, 0, 1))",
        "3:3: unexpected duplicate field named `camera` in `Scene`",
    ),
    (
        "materials: { \"m\": File(file: \"a.binary\") }",
        "3:26: materials.m.File.file: unexpected field named `file` in `File`, expected one of `path`, `interpolation`, `negatives`, `gap`, `beyond`, `scale`, `colour`, or `sampler` instead",
    ),
    (
        "materials: { \"m\": File() }",
        "3:26: materials.m.File: unexpected missing field named `path` in `File`",
    ),
    (
        "materials: { \"m\": File(path: \"a\", negatives: \"drop\") }",
        "3:49: materials.m.File.negatives: expected a policy for negative values (auto, keep, clamp), found \"drop\"",
    ),
    (
        "materials: { \"m\": File(path: \"a\", scale: (1, 1)) }",
        "3:49: materials.m.File.scale: expected an array of length 3 but found 2 elements instead",
    ),
    (
        "materials: { \"m\": Glass(ior: 1.5) }",
        "3:21: materials.m: unexpected variant named `Glass` in enum `Material`, expected one of `File`, `Model`, `Measured`, `Mix`, or `Lambert` instead",
    ),
    (
        "materials: { \"m\": Lambert(reflectance: 1), \"m\": Lambert(reflectance: 0) }",
        "3:47: materials: expected every name once, found \"m\" twice",
    ),
    (
        "shapes: [(form: Sphere(center: (0, 0, 0), radius: -1), material: \"m\")]",
        "3:53: shapes[0].form.Sphere.radius: expected a number above 0 and at most 1e7, found -1",
    ),
    (
        "shapes: [(form: Sphere(center: (0, 0), radius: 1), material: \"m\")]",
        "3:39: shapes[0].form.Sphere.center: expected an array of length 3 but found 2 elements instead",
    ),
    (
        "shapes: [(form: Sphere(center: (inf, 0, 0), radius: 1), material: \"m\")]",
        "3:35: shapes[0].form.Sphere.center[0]: expected a finite number of magnitude at most 1e7, found inf",
    ),
    (
        "shapes: [(form: UvSphere(center: (0, 0, 0), radius: 1, segments: 1000000), material: \"m\")]",
        "3:68: shapes[0].form.UvSphere.segments: expected a whole number of segments from 3 to 4096, found 1000000",
    ),
    (
        "shapes: [(form: Cube, material: \"m\")]",
        "3:19: shapes[0].form: unexpected variant named `Cube` in enum `Form`, expected one of `Sphere`, `Quad`, `Mesh`, `UvSphere`, or `Lathe` instead",
    ),
    (
        "lights: [Constant(radiance: -1)]",
        "3:32: lights[0].Constant.radiance: expected a number from 0 to 1e12, found -1",
    ),
    (
        "lights: [Constant(radiance: (1, 2))]",
        "3:36: lights[0].Constant.radiance: expected a colour: one number or (r, g, b), each from 0 to 1e12 but found 2 elements instead",
    ),
    (
        "lights: [Constant(radiance: NaN)]",
        "3:31: lights[0].Constant.radiance: expected a number from 0 to 1e12, found NaN",
    ),
    (
        "lights: [Point(position: (0, 0, 0))]",
        "3:37: lights[0].Point: unexpected missing field named `intensity` in `Point`",
    ),
    ("film: () film: ()", "3:12: expected comma, found `film`"),
];

#[test]
fn mistakes_of_form_are_placed() {
    for (fields, expected) in MISTAKES_OF_FORM {
        assert_eq!(error(&scene(fields)), *expected, "{fields}");
    }
}

/// Mistakes that no single number shows, with their field.
#[test]
fn mistakes_of_meaning_name_their_field() {
    let cases: &[(&str, &str)] = &[
        (
            "film: (width: 32768, height: 32768)",
            "film: expected at most 67108864 pixels, found 32768 x 32768",
        ),
        (
            "film: (width: 8192, height: 8192)",
            "film: expected a film of at most 8 GiB, found 8192 x 8192 pixels of 192 bytes (12.0 GiB)",
        ),
        (
            "film: (filter: Gaussian(sigma: 1, radius: 9))",
            "film.filter: expected sigma and radius of at most 8 pixels, found 1 and 9",
        ),
        (
            "render: (spectrum: \"bins8\")",
            "3:23: render.spectrum: expected a spectrum (rgb, xyz, 8, 16, 45, native, hero), found \"bins8\"",
        ),
        (
            "main_material: \"m\"",
            "main_material: expected the name of a material (), found \"m\"",
        ),
        (
            "materials: { \"m\": Lambert(reflectance: 1.5) }",
            "materials.m.reflectance: expected an albedo from 0 to 1, found 1.5",
        ),
        (
            "materials: { \"m\": Mix(parts: [(\"m\", 1)]) }",
            "materials.m.parts: expected parts that are not mixtures, found \"m\"",
        ),
        (
            "lights: [Constant(radiance: 1), Constant(radiance: 2)]",
            "lights: expected at most one Constant or Image light, found 2",
        ),
        (
            "lights: [Directional(direction: (0, 0, 0), irradiance: 1)]",
            "lights[0].direction: expected a direction, found the zero vector",
        ),
    ];
    for (fields, expected) in cases {
        assert_eq!(error(&scene(fields)), *expected, "{fields}");
    }
}

#[test]
fn one_sample_a_pixel_needs_one_sum_a_pixel() {
    let text = scene("film: (width: 8192, height: 8192), render: (spp: 1)");
    SceneFile::from_text(&text, Path::new("scene.ron"), Path::new("")).unwrap();
}
