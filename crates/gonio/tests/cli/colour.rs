//! What files' numbers mean and what pictures can't show, as users meet it.

use crate::fixtures::{astm_rgb, merl, pbrt_text};
use crate::program::{Bench, numbers};

fn bench() -> Bench {
    let bench = Bench::new();
    bench.write("m.binary", merl([6, 6, 12], |_| 100.0));
    bench.write("c.astm", astm_rgb());
    bench.write("s.brdf", pbrt_text());
    bench
}

#[test]
fn info_shows_what_is_in_effect_and_who_says_so() {
    let bench = bench();
    let plain = bench.json("info m.binary");
    assert_eq!(plain["primaries_name"], "sRGB");
    for key in ["channels_from", "white_from", "scale_from"] {
        assert_eq!(plain[key], "convention", "{plain}");
    }
    assert!(
        (numbers(&plain["scale"])[0] * 1500.0 - 1.0).abs() < 1e-12,
        "{plain}"
    );
    let said = bench.json("info m.binary --primaries Rec.2020 --white D50 --scale 1,2,3");
    assert_eq!(said["primaries_name"], "Rec.2020");
    assert_eq!(numbers(&said["scale"]), vec![1.0, 2.0, 3.0]);
    for key in ["channels_from", "white_from", "scale_from"] {
        assert_eq!(said[key], "user", "{said}");
    }
    let text = bench.text("info c.astm --scale 2.8");
    for expected in [
        "Trinitron (Cornell)",
        "(convention)",
        "2.800000, 2.800000, 2.800000 from numbers to f_r (user)",
    ] {
        assert!(text.contains(expected), "{expected}: {text}");
    }
    let text = bench.text("info s.brdf");
    assert!(text.contains("3 bands, 400 to 700 nm (file)"), "{text}");
}

#[test]
fn eval_and_render_read_files_as_said() {
    let bench = bench();
    let value = |line: &str| {
        numbers(&bench.json(&format!("eval {line} --theta-i 20 --theta-o 30 --phi-o 60"))["value"])
    };
    let [plain, said] = [value("m.binary"), value("m.binary --scale 0.001")];
    // MERL's own factors are 1, 1.15 and 1.66 over 1500 [Matusik2003]
    for (c, k) in [1.0, 1.15, 1.66].into_iter().enumerate() {
        assert!((plain[c] - 100.0 * k / 1500.0).abs() < 1e-6, "{plain:?}");
        assert!((said[c] - 0.1).abs() < 1e-6, "{said:?}");
    }
    let render = "render --material m.binary --size 16x12 --spp 8 -o";
    bench.text(&format!("{render} a.exr"));
    bench.text(&format!("{render} b.exr --scale 0.0002"));
    bench.text(&format!(
        "{render} c.exr --primaries 0.7,0.3,0.2,0.7,0.14,0.05"
    ));
    let [a, b, c] = ["a.exr", "b.exr", "c.exr"].map(|n| bench.read(n));
    assert!(a != b && a != c, "the same pictures");
}

#[test]
fn converting_mixing_and_plotting_read_files_as_said() {
    let bench = bench();
    let value = |file: &str| {
        numbers(&bench.json(&format!("eval {file} --theta-i 20 --theta-o 30 --phi-o 60"))["value"])
    };
    bench.text("convert m.binary scaled.binary --scale 0.001");
    bench.text("mix m.binary:1 m.binary:2 --scale 0.001 -o mixed.binary");
    for (file, expected) in [("scaled.binary", 0.1), ("mixed.binary", 0.3)] {
        for v in value(file) {
            assert!((v - expected).abs() < 1e-6, "{file}: {v}");
        }
    }
    // rows stay rows, there and back
    bench.text("convert s.brdf there.astm --scale 2");
    bench.text("convert there.astm back.brdf --scale 0.5,0.5,1");
    let (as_is, there, back) = (value("s.brdf"), value("there.astm"), value("back.brdf"));
    for c in 0..3 {
        let factor = if c == 2 { 2.0 } else { 1.0 };
        assert!((there[c] - 2.0 * as_is[c]).abs() < 1e-6, "{there:?}");
        assert!((back[c] - factor * as_is[c]).abs() < 1e-6, "{back:?}");
    }
    bench.text("plot m.binary -o plain.svg");
    bench.text("plot m.binary --scale 0.001 -o said.svg");
    assert!(
        bench.read("plain.svg") != bench.read("said.svg"),
        "the same curves"
    );
}

#[test]
fn fits_read_files_as_said() {
    let bench = bench();
    // f is 100 times the scale: albedo pi f
    for (scale, albedo) in [("0.001", 0.314_159), ("0.002", 0.628_319)] {
        let line =
            format!("fit m.binary --models lambert --no-spheres --scale {scale} -o f{scale}");
        let model = &bench.json(&line)["models"][0];
        let text = model.to_string();
        assert!(text.contains(&albedo.to_string()[..6]), "{scale}: {text}");
    }
}

#[test]
fn bad_colours_are_one_line() {
    let bench = bench();
    for (line, code, expected) in [
        (
            "info m.binary --primaries PAL",
            2,
            "expected sRGB, Rec.2020, ACEScg, Trinitron or",
        ),
        (
            "info m.binary --white D66",
            2,
            "expected A, C, D50, D65, E, F2, F11",
        ),
        (
            "info m.binary --scale 0",
            2,
            "expected factors above 0 and at most 1e6, found 0",
        ),
        ("info m.binary --scale -1", 2, "expected factors above 0"),
        (
            "info m.binary --scale 1,2",
            2,
            "expected a factor, or three with commas between",
        ),
        (
            "info s.brdf --primaries sRGB",
            1,
            "primaries: expected an RGB file for other primaries, found 3 bands",
        ),
        (
            "info m.binary --primaries 0.2,0.2,0.3,0.3,0.4,0.4",
            1,
            "expected primaries of which white can be mixed",
        ),
        (
            "eval s.brdf --white E --theta-i 1 --theta-o 1",
            1,
            "white: expected an RGB file",
        ),
        (
            "samplers s.brdf --white E",
            1,
            "white: expected an RGB file",
        ),
        (
            "converge --material s.brdf --white E --seconds 0.1 -o x",
            1,
            "white: expected an RGB file",
        ),
        (
            "render --material ggx:alpha=0.3 --scale 2 -o x.exr",
            1,
            "expected a file as main material",
        ),
        (
            "render --spectrum 8 --range 700..400 -o x.exr",
            2,
            "expected FROM..TO in nm",
        ),
        ("render --gamut perceptual -o x.exr", 2, "clip, desaturate"),
    ] {
        let run = bench.run(line);
        assert_eq!(run.code, code, "{line}: {}", run.err);
        assert!(run.err.contains(expected), "{line}: {}", run.err);
        assert_eq!(run.err.lines().count(), 1, "{line}: {}", run.err);
    }
}

#[test]
fn renders_say_what_their_png_cannot_show() {
    let bench = Bench::new();
    // a laser's red on a white wall: outside of sRGB
    bench.write("scene.ron", SCENE);
    let clip = bench.json("render scene.ron -o a.exr");
    assert_eq!(clip["gamut"]["mapping"], "clip");
    assert_eq!(
        (&clip["gamut"]["outside"], &clip["gamut"]["pixels"]),
        (&64.into(), &64.into())
    );
    assert!(clip["gamut"]["worst"].as_f64().unwrap() < -0.01, "{clip}");
    let grey = bench.json("render scene.ron --gamut desaturate -o b.exr");
    assert_eq!(grey["gamut"]["mapping"], "desaturate");
    assert!(bench.read("a.png") != bench.read("b.png"), "the same PNG");
    let [a, b] = ["a.exr", "b.exr"].map(|n| scene_io::image::read_exr(&bench.path(n)).unwrap());
    assert!(a.pixels == b.pixels, "the film was touched");
    assert!(
        a.pixels[0].iter().any(|v| *v < 0.0),
        "clipped: {:?}",
        a.pixels[0]
    );
    let text = bench.text("render scene.ron -o a.exr");
    assert!(
        text.contains("out of gamut: 64 of 64 pixels") && text.contains("by \"clip\""),
        "{text}"
    );
    let inside = bench.text("render scene.ron --spectrum rgb --size 4x4 -o c.exr");
    assert!(
        inside.contains("out of gamut: 16 of 16"),
        "its light in RGB is outside as well: {inside}"
    );
}

const SCENE: &str = r#"(
    camera: (position: (0, 0, 3), target: (0, 0, 0), fov_y_deg: 40),
    film: (width: 8, height: 8),
    render: (spp: 16, depth: 1, spectrum: "hero"),
    materials: { "wall": Lambert(reflectance: 0.8) },
    shapes: [(form: Quad(corner: (-5, -5, 0), edge_u: (10, 0, 0), edge_v: (0, 10, 0)), material: "wall")],
    lights: [Constant(radiance: 1, spectrum: Table([(618, 0), (620, 1), (622, 0)]))],
)"#;
