//! `gonio fit`: what it prints and writes, goes on with and refuses.

use crate::fixtures::merl;
use crate::program::Bench;

/// A small MERL file of a diffuse material that is red: f = kd/pi with kd = 0.6, 0.3, 0.15.
fn red() -> Vec<u8> {
    let cells = 12 * 12 * 16;
    let scale = [1500.0, 1500.0 / 1.15, 1500.0 / 1.66];
    let mut file = merl([12, 12, 16], |_| 0.0);
    for (c, kd) in [0.6, 0.3, 0.15].into_iter().enumerate() {
        let value: f64 = kd * std::f64::consts::FRAC_1_PI * scale[c];
        for k in 0..cells {
            let at = 12 + 8 * (c * cells + k);
            file[at..at + 8].copy_from_slice(&value.to_le_bytes());
        }
    }
    file
}

#[test]
fn one_file_gets_a_table_pictures_and_exports() {
    let bench = Bench::new();
    bench.write("red.binary", red());
    let report = bench.json("fit red.binary --models lambert,ward -o out --no-spheres");
    assert_eq!(report["metric"], "ngan");
    let models = report["models"].as_array().unwrap();
    assert_eq!(models.len(), 2, "{report}");
    for model in models {
        for key in ["name", "error", "parameters", "ci", "seconds"] {
            assert!(model.get(key).is_some(), "{key} is missing in {model}");
        }
        // single precision of the table
        let kd = model["parameters"]["kd"].as_array().unwrap();
        for (value, expected) in kd.iter().zip([0.6, 0.3, 0.15]) {
            let value = value.as_f64().unwrap();
            assert!((value - expected).abs() < 1e-6, "{model}");
        }
    }
    for name in [
        "fit.json",
        "best.ron",
        "best.xml",
        "best.pbrt",
        "best.glsl",
        "best.abg.txt",
        "polar.svg",
    ] {
        assert!(bench.path("out").join(name).is_file(), "{name}");
    }
    // what was exported as a scene is read back and is the fit
    let text = String::from_utf8(bench.read("out/best.ron")).unwrap();
    assert!(text.contains("Model(model: \""), "{text}");
    bench.text("render out/best.ron --spp 1 --size 8x8 -o ball.exr");
}

#[test]
fn spheres_are_rendered_side_by_side() {
    let bench = Bench::new();
    let report = bench.json("fit lambert:kd=0.5 --models lambert,eon --cutoff 60 -o out");
    assert_eq!(report["models"][0]["name"], "lambert", "{report}");
    let picture = bench.read("out/spheres.png");
    // a PNG says its size after its signature and the name of its first part: three spheres of 160 pixels
    assert_eq!(picture[16..24], [0, 0, 1, 224, 0, 0, 0, 160], "480 x 160");
}

#[test]
fn a_folder_goes_on_where_it_was() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("in")).unwrap();
    bench.write("in/a.binary", red());
    bench.write("in/b.binary", red());
    bench.write("in/notes.txt", "not a measurement");
    let first = bench.json("fit in --models lambert -o out");
    assert_eq!(
        (
            first["kept"].as_u64(),
            first["files"].as_array().unwrap().len()
        ),
        (Some(0), 2)
    );
    let before = bench.read("out/a.binary.json");
    // one file changes, the other is kept; a report that was cut short is made again
    let mut changed = red();
    changed[12..20].copy_from_slice(&300.0_f64.to_le_bytes());
    bench.write("in/b.binary", changed);
    let second = bench.json("fit in --models lambert -o out");
    assert_eq!(second["kept"], 1, "{second}");
    assert_eq!(bench.read("out/a.binary.json"), before, "not touched");
    bench.write("out/a.binary.json", "{ cut short");
    assert_eq!(
        bench.json("fit in --models lambert -o out")["kept"],
        1,
        "b alone"
    );
    // another question is answered anew
    assert_eq!(
        bench.json("fit in --models lambert --metric log -o out")["kept"],
        0,
        "log"
    );
}

#[test]
fn what_cannot_be_fitted_is_said_in_one_line() {
    let bench = Bench::new();
    bench.write("red.binary", red());
    bench.write("black.binary", merl([12, 12, 16], |_| 0.0));
    for (line, code, expected) in [
        ("fit none.binary -o out", 1, "none.binary"),
        ("fit red.binary", 2, "--output"),
        (
            "fit red.binary --models wart -o out",
            2,
            "no model `wart` to fit",
        ),
        (
            "fit red.binary --models eon --lobes 2 -o out",
            2,
            "model `eon`: expected one lobe, found 2",
        ),
        (
            "fit red.binary --metric rms -o out",
            2,
            "expected one of ngan, log, cuberoot, relvar",
        ),
        ("fit red.binary --cutoff 0 -o out", 2, "1 to 90"),
        ("fit ward:alpha=7 -o out", 1, "`alpha`: 7 is outside"),
        (
            "fit black.binary --models ward -o out",
            1,
            "expected positive reflectance, found none",
        ),
        ("fit red.binary -o red.binary", 1, "red.binary"),
    ] {
        let run = bench.run(line);
        assert_eq!(run.code, code, "gonio {line}: {}", run.err);
        let last = run.err.lines().last().unwrap_or_default();
        assert!(
            last.starts_with("gonio: ") && last.contains(expected),
            "gonio {line}: {}",
            run.err
        );
        assert!(run.out.is_empty(), "gonio {line}: {}", run.out);
    }
}
