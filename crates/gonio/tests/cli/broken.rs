//! Broken input of every kind: one line that says which file, where, what was expected and what was found; exit code 1
//! (2 for bad usage); nothing left behind.

#![expect(clippy::too_many_lines, reason = "tables of broken input")]

use crate::fixtures::{astm_rgb, merl, pbrt_text, scene, tensor};
use crate::program::Bench;

/// A command line, its exit code and what its one line of error must say.
type Case = (&'static str, i32, &'static [&'static str]);

const SPHERE: &str = r#"(form: Sphere(center: (0, 1, 0), radius: 1), material: "m")"#;

/// Writes `content` with `from` replaced by `to`, which must occur.
fn swapped(bench: &Bench, name: &str, content: &str, from: &str, to: &str) {
    assert!(content.contains(from), "{name}: {from}");
    bench.write(name, content.replacen(from, to, 1));
}

fn check(bench: &Bench, cases: &[Case]) {
    let before = bench.files();
    let mut wrong = Vec::new();
    for (line, code, fragments) in cases {
        let run = bench.run(line);
        let mut problems = Vec::new();
        if run.code != *code {
            problems.push(format!("exit code {} instead of {code}", run.code));
        }
        if run.err.lines().count() != 1 || !run.err.starts_with("gonio: ") {
            problems.push("expected one line from gonio".into());
        }
        problems.extend(
            (fragments.iter())
                .filter(|f| !run.err.contains(**f))
                .map(|f| format!("does not say {f:?}")),
        );
        if !run.out.is_empty() {
            problems.push(format!("stdout: {}", run.out));
        }
        if bench.files() != before {
            problems.push(format!("left behind: {:?}", bench.files()));
        }
        if !problems.is_empty() {
            wrong.push(format!(
                "gonio {line}\n    {}\n    {}",
                run.err.trim(),
                problems.join("\n    ")
            ));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {}:\n{}",
        wrong.len(),
        cases.len(),
        wrong.join("\n")
    );
}

#[test]
fn merl_files() {
    let bench = Bench::new();
    let sound = merl([6, 6, 12], |k| 1.0 + k as f64);
    bench.write("sound.binary", &sound);
    bench.write("truncated.binary", &sound[..sound.len() - 5]);
    bench.write("longer.binary", [&sound[..], b"12345678"].concat());
    let dims = |d: [i32; 3]| {
        [
            &d.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>()[..],
            &sound[12..],
        ]
        .concat()
    };
    bench.write("lying.binary", dims([6, 6, 13]));
    bench.write("huge.binary", dims([i32::MAX, i32::MAX, i32::MAX]));
    bench.write("negative.binary", dims([-6, -6, 12]));
    bench.write("zero.binary", dims([0, 6, 12]));
    bench.write("empty.binary", b"");
    bench.write("short.binary", b"\x06\0\0\0");
    bench.write("nan.binary", merl([6, 6, 12], |_| f64::NAN));
    bench.write("unmeasured.binary", merl([6, 6, 12], |_| -1.0));
    bench.write("text.binary", "once upon a time\n");
    std::fs::create_dir(bench.path("folder.binary")).unwrap();
    assert_eq!(bench.run("info sound.binary").code, 0, "the sound file");
    check(
        &bench,
        &[
            (
                "info truncated.binary",
                1,
                &["truncated.binary", "expected", "found"],
            ),
            (
                "info longer.binary",
                1,
                &["longer.binary", "expected", "found"],
            ),
            (
                "info lying.binary",
                1,
                &["lying.binary", "expected", "found"],
            ),
            ("info huge.binary", 1, &["huge.binary", "expected", "found"]),
            (
                "info negative.binary",
                1,
                &["negative.binary", "expected", "found"],
            ),
            ("info zero.binary", 1, &["zero.binary", "expected", "found"]),
            (
                "info empty.binary",
                1,
                &["empty.binary", "expected", "an empty file"],
            ),
            (
                "info short.binary",
                1,
                &["short.binary", "expected", "found"],
            ),
            (
                "info nan.binary",
                1,
                &["nan.binary", "expected measured cells", "found none"],
            ),
            (
                "info unmeasured.binary",
                1,
                &["unmeasured.binary", "expected measured cells", "found none"],
            ),
            (
                "info text.binary",
                1,
                &[
                    "text.binary",
                    "expected one of",
                    "merl",
                    "found `once upon a time",
                ],
            ),
            (
                "info folder.binary",
                1,
                &["folder.binary", "expected a file", "found a folder"],
            ),
            (
                "info missing.binary",
                1,
                &["missing.binary", "no such file", "GONIO_DATA"],
            ),
            (
                "eval truncated.binary --theta-i 1 --theta-o 1",
                1,
                &["truncated.binary", "expected", "found"],
            ),
            (
                "plot nan.binary -o a.svg",
                1,
                &["nan.binary", "expected measured cells"],
            ),
            (
                "convert lying.binary a.astm",
                1,
                &["lying.binary", "expected", "found"],
            ),
            (
                "mix sound.binary:1 nan.binary:1 -o a.binary",
                1,
                &["nan.binary", "expected measured cells"],
            ),
            (
                "render --material truncated.binary -o a.exr",
                1,
                &["truncated.binary", "expected", "found"],
            ),
            (
                "eval sound.binary --theta-i 1 --theta-o 1 --interpolation thin-plate",
                1,
                &[
                    "sound.binary",
                    "expected an interpolation",
                    "found \"thin-plate\"",
                ],
            ),
        ],
    );
}

#[test]
fn text_files() {
    let bench = Bench::new();
    let astm = String::from_utf8(astm_rgb()).unwrap();
    bench.write("sound.astm", &astm);
    let first = astm.lines().position(|l| l.is_empty()).unwrap() + 2;
    let row = astm.lines().nth(first - 1).unwrap().to_owned();
    let at = |line: &str| swapped(&bench, "x", &astm, &row, line);
    at(&row);
    let with_row = |name: &str, new: &str| swapped(&bench, name, &astm, &row, new);
    bench.write("truncated.astm", &astm[..astm.len() - 30]);
    with_row("nan.astm", &row.replacen("0.", "nan", 1));
    with_row("words.astm", "one,two,three,four,5,6,7");
    with_row("narrow.astm", "0.174533,0.000000,0.1,0.0,0.1,0.1");
    with_row("wide.astm", &format!("{row},1"));
    with_row("degrees.astm", "10,0,45,0,0.1,0.1,0.1");
    with_row("binary.astm", "\u{0}\u{1}\u{2}");
    let vars = "VARS theta_i,phi_i,theta_s,phi_s,R,G,B";
    swapped(&bench, "no-vars.astm", &astm, vars, "REMARK none");
    swapped(
        &bench,
        "other-vars.astm",
        &astm,
        vars,
        "VARS phi_i,theta_i,theta_s,phi_s,R,G,B",
    );
    swapped(
        &bench,
        "odd-columns.astm",
        &astm,
        vars,
        "VARS theta_i,phi_i,theta_s,phi_s,R,G,Q",
    );
    swapped(&bench, "count.astm", &astm, "NUM_POINTS ", "NUM_POINTS 1");
    bench.write("no-rows.astm", format!("{vars}\n"));
    let text = pbrt_text();
    bench.write("sound.brdf", &text);
    bench.write("truncated.brdf", &text[..text.len() - 12]);
    swapped(
        &bench,
        "descending.brdf",
        &text,
        "400 550 700",
        "400 700 550",
    );
    swapped(&bench, "count.brdf", &text, "\n3\n", "\n4\n");
    swapped(&bench, "nan.brdf", &text, "0.02 0.05", "0.02 nan");
    swapped(&bench, "missing.brdf", &text, "0.02 0.05", "0.05");
    swapped(&bench, "degrees.brdf", &text, "0.174533", "10.0");
    bench.write("head.brdf", "# a comment\n\n3\n\n400 550 700\n\n");
    for sound in ["sound.astm", "sound.brdf"] {
        assert_eq!(bench.run(&format!("info {sound}")).code, 0, "{sound}");
    }
    check(
        &bench,
        &[
            (
                "info truncated.astm",
                1,
                &["truncated.astm: line ", "expected", "found"],
            ),
            (
                "info nan.astm",
                1,
                &["nan.astm: line ", "expected a finite number", "found `nan"],
            ),
            (
                "info words.astm",
                1,
                &[
                    "words.astm: line ",
                    "theta_i: expected a finite number",
                    "found `one`",
                ],
            ),
            (
                "info narrow.astm",
                1,
                &[
                    "narrow.astm: line ",
                    "expected 7 comma-separated numbers",
                    "found 6",
                ],
            ),
            (
                "info wide.astm",
                1,
                &[
                    "wide.astm: line ",
                    "expected 7 comma-separated numbers",
                    "found 8",
                ],
            ),
            (
                "info degrees.astm",
                1,
                &[
                    "degrees.astm: line ",
                    "theta_i: expected",
                    "radians",
                    "found",
                ],
            ),
            (
                "info binary.astm",
                1,
                &["binary.astm: line ", "expected", "found"],
            ),
            (
                "info no-vars.astm",
                1,
                &[
                    "no-vars.astm: line ",
                    "expected a VARS line",
                    "found the end of the file",
                ],
            ),
            (
                "info other-vars.astm",
                1,
                &[
                    "other-vars.astm: line ",
                    "VARS: expected columns that start with theta_i",
                    "found",
                ],
            ),
            (
                "info odd-columns.astm",
                1,
                &["odd-columns.astm: line ", "expected", "found"],
            ),
            (
                "info count.astm",
                1,
                &["count.astm: line ", "NUM_POINTS: expected", "rows, found"],
            ),
            (
                "info no-rows.astm",
                1,
                &["no-rows.astm: ", "expected", "found"],
            ),
            (
                "info truncated.brdf",
                1,
                &["truncated.brdf: line ", "expected", "found"],
            ),
            (
                "info descending.brdf",
                1,
                &["descending.brdf: line ", "expected", "found"],
            ),
            (
                "info count.brdf",
                1,
                &["count.brdf: line ", "expected", "found"],
            ),
            (
                "info nan.brdf",
                1,
                &["nan.brdf: line ", "expected a finite number", "found `nan`"],
            ),
            (
                "info missing.brdf",
                1,
                &["missing.brdf: line ", "expected", "found"],
            ),
            (
                "info degrees.brdf",
                1,
                &["degrees.brdf: line ", "radians", "found"],
            ),
            ("info head.brdf", 1, &["head.brdf: ", "expected", "found"]),
            (
                "convert nan.astm a.brdf",
                1,
                &["nan.astm: line ", "expected a finite number"],
            ),
            (
                "convert sound.astm a.brdf",
                1,
                &["sound.astm: ", "expected rows of spectra", "found"],
            ),
            (
                "render --material words.astm -o a.exr",
                1,
                &["words.astm: ", "line ", "expected a finite number"],
            ),
        ],
    );
}

#[test]
fn stress() {
    let bench = Bench::new();
    let run = bench.run("stress --quick --only angles/half");
    assert!(
        run.code == 0 && run.out.contains("1 rows, 0 red"),
        "{}{}",
        run.out,
        run.err
    );
    check(
        &bench,
        &[
            ("stress --only nonsense", 1, &["--only nonsense: no row"]),
            ("stress --timing --quick", 2, &["--timing", "--quick"]),
            ("stress --markdown --json", 2, &["--markdown", "--json"]),
        ],
    );
}

#[test]
fn tensor_files() {
    let bench = Bench::new();
    let data = 1.0_f32.to_le_bytes().repeat(6);
    let start = 18 + 2 + 7 + 2 + 1 + 8 + 16;
    let sound = tensor(10, start, [2, 3], &data);
    bench.write("truncated.bsdf", &sound[..40]);
    bench.write("cut.bsdf", &sound[..sound.len() - 4]);
    bench.write("lacking.bsdf", &sound);
    bench.write("shape.bsdf", tensor(10, start, [2, 1 << 40], &data));
    bench.write("offset.bsdf", tensor(10, 1 << 50, [2, 3], &data));
    bench.write("dtype.bsdf", tensor(77, start, [2, 3], &data));
    let mut version = sound.clone();
    version[12] = 9;
    bench.write("version.bsdf", &version);
    check(
        &bench,
        &[
            (
                "info truncated.bsdf",
                1,
                &["truncated.bsdf: byte ", "expected", "found"],
            ),
            (
                "info cut.bsdf",
                1,
                &[
                    "cut.bsdf: byte ",
                    "expected data within the file's",
                    "found",
                ],
            ),
            (
                "info lacking.bsdf",
                1,
                &["lacking.bsdf: ", "expected", "found"],
            ),
            (
                "info shape.bsdf",
                1,
                &[
                    "shape.bsdf: byte ",
                    "expected data within the file's",
                    "found shape",
                ],
            ),
            (
                "info offset.bsdf",
                1,
                &[
                    "offset.bsdf: byte ",
                    "expected data within the file's",
                    "found shape",
                ],
            ),
            (
                "info dtype.bsdf",
                1,
                &["dtype.bsdf: byte ", "dtype", "found 77"],
            ),
            (
                "info version.bsdf",
                1,
                &["version.bsdf: byte ", "version: expected 1.x", "found 9"],
            ),
            (
                "render --material lacking.bsdf -o a.exr",
                1,
                &["lacking.bsdf", "expected", "found"],
            ),
        ],
    );
}

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

#[test]
fn pictures() {
    let bench = Bench::new();
    for (name, side) in [("a.exr", 4), ("b.exr", 5)] {
        let pixels = vec![[1.0; 3]; side * side];
        let picture = scene_io::image::Picture::new(side, side, pixels).unwrap();
        scene_io::image::write_exr(&bench.path(name), &picture).unwrap();
    }
    let sound = bench.read("a.exr");
    bench.write("truncated.exr", &sound[..sound.len() / 2]);
    bench.write("cut.exr", &sound[..sound.len() - 9]);
    bench.write("text.exr", "not a picture");
    bench.write("empty.exr", "");
    check(
        &bench,
        &[
            (
                "compare truncated.exr a.exr",
                1,
                &["truncated.exr", "broken EXR file"],
            ),
            ("compare a.exr cut.exr", 1, &["cut.exr", "broken EXR file"]),
            (
                "compare text.exr a.exr",
                1,
                &["text.exr", "broken EXR file"],
            ),
            (
                "compare a.exr empty.exr",
                1,
                &["empty.exr", "broken EXR file"],
            ),
            (
                "compare a.exr b.exr",
                1,
                &[
                    "a.exr and b.exr",
                    "expected pictures of one size",
                    "found 4 x 4 and 5 x 5",
                ],
            ),
            ("compare a.exr gone.exr", 1, &["gone.exr", "no such file"]),
            (
                "compare a.exr .",
                1,
                &[".: expected a file", "found a folder"],
            ),
            ("compare a.exr", 2, &["required", "<B>"]),
        ],
    );
}

#[test]
fn usage_and_outputs() {
    let bench = Bench::new();
    bench.write("m.binary", merl([6, 6, 12], |k| 1.0 + k as f64));
    bench.write(
        "d.csv",
        "theta_i,phi_i,theta_o,phi_o\n10,0,20,180\n10,0,95,180\n",
    );
    bench.write("text.csv", "ten,zero,twenty,zero\n");
    std::fs::create_dir(bench.path("folder.exr")).unwrap();
    std::fs::create_dir(bench.path("folder.svg")).unwrap();
    let mut cases: Vec<Case> = vec![
        ("frobnicate", 2, &["frobnicate"]),
        ("eval m.binary --theta-i 10", 2, &["--theta-o"]),
        (
            "eval m.binary --theta-i 91 --theta-o 0",
            2,
            &["'91'", "--theta-i", "expected degrees from the normal"],
        ),
        (
            "eval m.binary --theta-i nan --theta-o 0",
            2,
            &["'nan'", "expected degrees"],
        ),
        (
            "eval m.binary --theta-i 1 --theta-o 1 --interpolation cubic",
            2,
            &[
                "--interpolation",
                "expected an interpolation",
                "found \"cubic\"",
            ],
        ),
        (
            "eval m.binary --batch d.csv",
            1,
            &[
                "d.csv:3: expected theta from 0 to 90",
                "found \"10,0,95,180\"",
            ],
        ),
        (
            "eval m.binary --batch text.csv",
            1,
            &[
                "text.csv:1: expected theta_i,phi_i,theta_o,phi_o",
                "found \"ten",
            ],
        ),
        (
            "eval m.binary --batch gone.csv",
            1,
            &["gone.csv: cannot read: no such file"],
        ),
        (
            "plot m.binary -o a.gif",
            2,
            &[
                "a.gif",
                "expected an output ending in .svg or .png",
                "found",
            ],
        ),
        (
            "plot m.binary -o a",
            2,
            &["expected an output ending in .svg or .png"],
        ),
        ("plot m.binary", 2, &["--output"]),
        (
            "plot m.binary m.binary --kind slice -o a.svg",
            2,
            &["expected one file for a slice", "found 2"],
        ),
        (
            "plot m.binary -o gone/a.svg",
            1,
            &["gone/a.svg: cannot write: no such file or folder"],
        ),
        (
            "plot m.binary -o folder.svg",
            1,
            &["folder.svg: cannot write: expected a file name, found a folder"],
        ),
        (
            "convert m.binary a.bsdf",
            2,
            &[
                "a.bsdf: expected an output ending in .binary",
                "found \"bsdf\"",
            ],
        ),
        (
            "convert m.binary gone/a.astm",
            1,
            &["gone/a.astm: cannot write"],
        ),
        (
            "convert m.binary a.brdf",
            1,
            &["m.binary: expected rows of spectra", "found"],
        ),
        (
            "mix m.binary:1 m.binary:1 -o a.astm",
            1,
            &["a.astm: expected an output ending in .binary"],
        ),
        (
            "mix m.binary:1 m.binary -o a.binary",
            2,
            &["m.binary: expected FILE:WEIGHT", "found no colon"],
        ),
        (
            "mix m.binary:1 m.binary:many -o a.binary",
            2,
            &["expected FILE:WEIGHT", "found \"many\""],
        ),
        (
            "mix m.binary:1 m.binary:inf -o a.binary",
            2,
            &["expected FILE:WEIGHT", "found \"inf\""],
        ),
        ("mix m.binary:1 -o a.binary", 2, &["2 values required"]),
        ("measure ggx", 2, &["expected an output"]),
        (
            "measure ggx -o a.txt",
            2,
            &["a.txt: expected an output ending in .binary"],
        ),
        (
            "measure glass -o a.binary",
            1,
            &["`glass`", "known are lambert"],
        ),
        (
            "measure ggx:alpha=9 -o a.binary",
            1,
            &["`ggx`", "`alpha`", "9 is outside"],
        ),
        (
            "measure ggx:alpha=x -o a.binary",
            1,
            &["`ggx`", "`alpha`", "`x`"],
        ),
        (
            "measure ggx:roughness=1 -o a.binary",
            1,
            &["`ggx`", "`roughness`"],
        ),
        (
            "measure ggx --noise -1 -o a.binary",
            2,
            &["--noise", "expected a number, 0 or more"],
        ),
        ("measure ggx --blind-spot 900 -o a.astm", 1, &["blind"]),
        (
            "measure ggx -o gone/a.astm",
            1,
            &["gone/a.astm: cannot write"],
        ),
        (
            "render -o a.png",
            2,
            &["a.png", "expected an output ending in .exr"],
        ),
        (
            "render -o gone/a.exr",
            1,
            &["gone/a.exr: cannot write: no such file or folder"],
        ),
        (
            "render -o folder.exr",
            1,
            &["folder.exr: cannot write: expected a file name, found a folder"],
        ),
        (
            "render --sampler best",
            2,
            &["--sampler", "expected a sampler", "found \"best\""],
        ),
        ("render --size 0x9", 2, &["--size", "expected WIDTHxHEIGHT"]),
        ("render --spp 0", 2, &["--spp", "0"]),
        ("render --threads 0", 2, &["--threads", "0"]),
        (
            "render --material gone.binary",
            1,
            &["gone.binary: ", "no such file"],
        ),
        (
            "render --interpolation squared-lambda --material m.binary",
            1,
            &[
                "m.binary",
                "expected an interpolation",
                "found \"squared-lambda\"",
            ],
        ),
    ];
    if cfg!(target_os = "linux") {
        cases.push(("render -o /proc/a.exr", 1, &["/proc/a.exr: cannot write"]));
        cases.push((
            "measure ggx -o /dev/full",
            2,
            &["/dev/full: expected an output ending in"],
        ));
        cases.push((
            "info /dev/zero",
            1,
            &["/dev/zero: expected a file, found a pipe or device"],
        ));
    }
    check(&bench, &cases);
}
