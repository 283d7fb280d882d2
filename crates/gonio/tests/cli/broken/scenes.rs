//! Scene files.

use super::{SPHERE, check, swapped};
use crate::fixtures::scene;
use crate::program::Bench;

#[test]
fn scenes() {
    let bench = Bench::new();
    let sound = scene(&format!(
        r#"materials: {{ "m": Lambert(reflectance: 0.5) }}, shapes: [{SPHERE}]"#
    ));
    bench.write("sound.ron", &sound);
    let swap = |name: &str, from: &str, to: &str| swapped(&bench, name, &sound, from, to);
    swap("field.ron", "width: 8", "widht: 8");
    swap("type.ron", "width: 8", "width: \"8\"");
    swap("huge.ron", "width: 8", "width: 4000000000");
    swap("large.ron", "width: 8", "width: 70000");
    swap("radius.ron", "radius: 1", "radius: -1");
    swap("inf.ron", "center: (0, 1, 0)", "center: (0, inf, 0)");
    swap("material.ron", "\"m\")]", "\"n\")]");
    swap("albedo.ron", "reflectance: 0.5", "reflectance: 1.5");
    swap("syntax.ron", "film: (width: 8", "film: (width: 8,,");
    swap("cut.ron", "shapes: [", "");
    swap("camera.ron", "target: (0, 1, 0)", "target: (0, 1, 5)");
    swap(
        "file.ron",
        "Lambert(reflectance: 0.5)",
        "File(path: \"gone.binary\")",
    );
    swap(
        "model.ron",
        "Lambert(reflectance: 0.5)",
        "Model(model: \"ggx:alpha=2\")",
    );
    swap(
        "sampler.ron",
        "render: (spp: 1",
        "render: (spp: 1, sampler: \"bets\"",
    );
    swap(
        "mesh.ron",
        "Sphere(center: (0, 1, 0), radius: 1)",
        "Mesh(path: \"gone.obj\")",
    );
    bench.write("loop-a.ron", "(base: \"loop-b.ron\")");
    bench.write("loop-b.ron", "(base: \"loop-a.ron\")");
    bench.write("base.ron", "(base: \"gone.ron\")");
    bench.write("latin.ron", b"(about: \"\xe9\")");
    bench.write("empty.ron", "");
    std::fs::create_dir(bench.path("folder.ron")).unwrap();
    assert_eq!(bench.run("render sound.ron").code, 0, "the sound scene");
    check(
        &bench,
        &[
            (
                "render field.ron",
                1,
                &["field.ron:3:", "film", "`widht`", "`width`"],
            ),
            (
                "render type.ron",
                1,
                &["type.ron:3:", "film.width", "expected", "found"],
            ),
            (
                "render huge.ron",
                1,
                &["huge.ron:3:", "film.width", "expected", "found"],
            ),
            (
                "render large.ron",
                1,
                &["large.ron:3:", "film.width", "expected", "found"],
            ),
            (
                "render radius.ron",
                1,
                &["radius.ron:5:", "radius", "expected", "found"],
            ),
            (
                "render inf.ron",
                1,
                &["inf.ron:5:", "center", "expected", "found"],
            ),
            (
                "render material.ron",
                1,
                &["material.ron: shapes", "material", "\"n\""],
            ),
            (
                "render albedo.ron",
                1,
                &["albedo.ron:", "reflectance", "expected", "found"],
            ),
            (
                "render syntax.ron",
                1,
                &["syntax.ron:3:", "expected", "found"],
            ),
            ("render cut.ron", 1, &["cut.ron:5:", "expected", "found"]),
            ("render camera.ron", 1, &["camera.ron: camera"]),
            (
                "render file.ron",
                1,
                &["gone.binary", "materials.m", "no such file"],
            ),
            (
                "render model.ron",
                1,
                &["model.ron: materials.m", "alpha", "2"],
            ),
            (
                "render sampler.ron",
                1,
                &[
                    "sampler.ron:4:",
                    "render.sampler",
                    "expected a sampler",
                    "found \"bets\"",
                ],
            ),
            ("render mesh.ron", 1, &["gone.obj", "no such file"]),
            ("render loop-a.ron", 1, &["loop-a.ron", "base"]),
            ("render base.ron", 1, &["gone.ron", "no such file"]),
            (
                "render latin.ron",
                1,
                &[
                    "latin.ron",
                    "expected UTF-8 text",
                    "found another byte at 9",
                ],
            ),
            (
                "render empty.ron",
                1,
                &["empty.ron:1:1: ", "expected", "found the end of the file"],
            ),
            (
                "render folder.ron",
                1,
                &["folder.ron", "expected a file", "found a folder"],
            ),
            ("render gone.ron", 1, &["gone.ron", "no such file"]),
        ],
    );
}
