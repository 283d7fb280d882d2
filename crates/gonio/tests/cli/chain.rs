//! The verbs in a chain: what one writes the next reads, and the numbers agree.

#![expect(clippy::too_many_lines, reason = "one chain of verbs is one test")]

use crate::fixtures::{astm_rgb, pbrt_text};
use crate::program::{Bench, numbers};
use scene_io::image::{Picture, read_exr};
use serde_json::Value;
use std::f64::consts::FRAC_1_PI;

/// The keys of docs, each present.
fn has_keys(value: &Value, keys: &[&str]) {
    for key in keys {
        assert!(value.get(key).is_some(), "{key} is missing in {value}");
    }
}

const AT: &str = "--theta-i 30 --phi-i 0 --theta-o 40 --phi-o 170";

#[test]
fn from_a_model_to_a_picture() {
    let bench = Bench::new();
    let measured = bench.json("measure lambert:kd=0.2/0.4/0.6 -o a.binary");
    has_keys(&measured, &["written", "model", "parameters", "grid"]);
    assert_eq!(measured["model"], "lambert");
    bench.text("measure ggx:alpha=0.4 -o b.binary");

    let info = bench.json("info a.binary");
    has_keys(
        &info,
        &[
            "format",
            "dims",
            "channels",
            "primaries",
            "white",
            "scale",
            "valid_fraction",
            "negatives",
            "bytes",
            "header",
        ],
    );
    assert_eq!(
        (&info["format"], &info["dims"]),
        (&"merl".into(), &serde_json::json!([90, 90, 180]))
    );
    assert!(
        bench
            .text("info a.binary")
            .contains("MERL isotropic binary"),
        "text of info"
    );

    // f_r of a diffuse material is kd/pi; the table holds f32
    for name in ["linear", "nearest"] {
        let value = bench.json(&format!("eval a.binary {AT} --interpolation {name}"));
        has_keys(
            &value,
            &["format", "channels", "value", "status", "linear_srgb"],
        );
        for key in ["value", "linear_srgb"] {
            for (v, kd) in numbers(&value[key]).iter().zip([0.2, 0.4, 0.6]) {
                assert!((v / (kd * FRAC_1_PI) - 1.0).abs() < 1e-6, "{name}: {value}");
            }
        }
    }

    let plotted = bench.json("plot a.binary b.binary --theta-i 45,75 --log -o both.svg");
    assert_eq!(plotted["written"], serde_json::json!(["both.svg"]));
    for (kind, ending) in [("polar", "png"), ("albedo", "svg"), ("slice", "svg")] {
        bench.text(&format!("plot b.binary --kind {kind} -o {kind}.{ending}"));
    }
    let albedo = String::from_utf8(bench.read("albedo.svg")).unwrap();
    assert!(albedo.contains("directional albedo"), "title");

    let mixed = bench.json("mix a.binary:0.25 b.binary:0.75 -o mix.binary");
    has_keys(&mixed, &["written", "lost", "round_trip_error", "changes"]);
    let [a, b, mix] =
        ["a", "b", "mix"].map(|n| numbers(&bench.json(&format!("eval {n}.binary {AT}"))["value"]));
    for c in 0..3 {
        let expected = 0.25 * a[c] + 0.75 * b[c];
        assert!(
            (mix[c] / expected - 1.0).abs() < 1e-6,
            "{mix:?}: {a:?} {b:?}"
        );
    }

    let copied = bench.json("convert mix.binary copy.binary");
    assert_eq!(copied["round_trip_error"], 0.0);
    assert!(
        bench.read("mix.binary") == bench.read("copy.binary"),
        "a copy is bit-exact"
    );

    let rendered =
        bench.json("render --material mix.binary --size 24x16 --spp 32 --seed 1 -o 1.exr");
    has_keys(
        &rendered,
        &[
            "written",
            "scene",
            "sampler",
            "spectrum",
            "spp",
            "seconds",
            "cpu_seconds",
            "paths_per_second",
            "rel_rmse",
            "rel_rmse_ci",
            "left_out",
        ],
    );
    assert_eq!(rendered["spp"], 32);
    assert!(
        !rendered["left_out"].as_array().unwrap().is_empty(),
        "nothing left out"
    );
    bench.json("render --material mix.binary --size 24x16 --spp 32 --seed 2 -o 2.exr");
    let compared = bench.json("compare 1.exr 2.exr");
    has_keys(
        &compared,
        &["rmse", "rel_mse", "rel_rmse", "mae", "mean_a", "mean_b"],
    );
    // two renders of one scene: the error of each, times sqrt 2, within the spread of so few pixels
    let ratio = compared["rel_rmse"].as_f64().unwrap()
        / rendered["rel_rmse"].as_f64().unwrap()
        / 2_f64.sqrt();
    assert!((0.7..1.4).contains(&ratio), "{compared} {rendered}");
}

#[test]
fn same_seed_same_bits() {
    let bench = Bench::new();
    let pixels = |options: &str, name: &str| -> Picture {
        bench.text(&format!("render --size 40x24 --spp 16 {options} -o {name}"));
        read_exr(&bench.path(name)).unwrap()
    };
    let one = pixels("--threads 1 --seed 7", "a.exr");
    let two = pixels("--threads 2 --seed 7", "b.exr");
    let other = pixels("--threads 2 --seed 8", "c.exr");
    let bits =
        |p: &Picture| -> Vec<u32> { p.pixels.iter().flatten().map(|v| v.to_bits()).collect() };
    assert!(bits(&one) == bits(&two), "threads change the picture");
    assert!(one.variance == two.variance, "threads change the variance");
    assert!(bits(&one) != bits(&other), "the seed changes nothing");
    assert_eq!((one.metadata.seed, one.metadata.spp), (Some(7), Some(16)));
}

#[test]
fn spectra_travel_between_their_two_forms() {
    let bench = Bench::new();
    bench.write("a.brdf", pbrt_text());
    let there = bench.json("convert a.brdf b.astm");
    assert!(there["lost"].to_string().contains("comments"), "{there}");
    let error = there["round_trip_error"].as_f64().unwrap();
    assert!(error < 1e-12, "the same rows: {error}");
    let back = bench.json("convert b.astm c.brdf");
    assert!(back["lost"].to_string().contains("header"), "{back}");
    let rows = |name: &str| {
        brdf_formats::PbrtTextFile::from_bytes(&bench.read(name))
            .unwrap()
            .rows()
            .to_vec()
    };
    assert_eq!(
        rows("a.brdf"),
        rows("c.brdf"),
        "numbers come back to the bit"
    );
    let info = bench.json("info b.astm");
    assert_eq!(numbers(&info["wavelengths_nm"]), [400.0, 550.0, 700.0]);
    let text = bench.text("convert b.astm again.astm");
    assert!(text.contains("wrote again.astm"), "{text}");
    assert!(
        bench.read("b.astm") == bench.read("again.astm"),
        "a copy is bit-exact"
    );
}

/// RGB with white at 0.358 is brought to the scale of a BRDF, and every row is returned at its own angles.
#[test]
fn rows_come_back_at_their_own_angles() {
    let bench = Bench::new();
    bench.write("a.astm", astm_rgb());
    rows_come_back(&bench, "a.astm", 97);
}

/// Evaluates every `step`-th row of an RGB ASTM file.
pub(crate) fn rows_come_back(bench: &Bench, file: &str, step: usize) {
    let astm = brdf_formats::AstmFile::from_bytes(&bench.read(file)).unwrap();
    let scale = numbers(&bench.json(&format!("info {file}"))["scale"]);
    let rows: Vec<usize> = (0..astm.row_count()).step_by(step).collect();
    let mut csv = String::new();
    for row in &rows {
        // 17 digits: radians survive the way through degrees to about 1e-16
        let angles = astm
            .angles(*row)
            .map(|a| format!("{:.16e}", a.to_degrees()));
        csv.push_str(&format!("{}\n", angles.join(",")));
    }
    bench.write("rows.csv", csv);
    let found = bench.json(&format!("eval {file} --batch rows.csv"));
    let values = found["values"].as_array().unwrap();
    assert_eq!(values.len(), rows.len());
    for (row, found) in rows.iter().zip(values) {
        let expected: Vec<f64> = astm
            .values(*row)
            .iter()
            .zip(&scale)
            .map(|(v, s)| v * s)
            .collect();
        let size = expected.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        for (e, f) in expected.iter().zip(numbers(found)) {
            assert!(
                (e - f).abs() <= 1e-6 * size,
                "row {row}: {expected:?} {found}"
            );
        }
    }
}

#[test]
fn noise_follows_its_seed() {
    let bench = Bench::new();
    for (name, seed) in [("a", 1), ("b", 1), ("c", 2)] {
        bench.text(&format!(
            "measure ggx --noise 0.05 --bracketed --seed {seed} -o {name}.astm"
        ));
    }
    assert!(bench.read("a.astm") == bench.read("b.astm"), "same seed");
    assert!(bench.read("a.astm") != bench.read("c.astm"), "other seed");
    let rows = |line: &str| {
        bench.text(line);
        brdf_formats::AstmFile::from_bytes(&bench.read("d.astm"))
            .unwrap()
            .row_count()
    };
    let seen = rows("measure ggx -o d.astm");
    let blind = rows("measure ggx --blind-spot 17 -o d.astm");
    assert!(
        blind < seen,
        "the blind spot hides {} of {seen} rows",
        seen - blind
    );
}

#[test]
fn models_are_listed_for_people_and_programs() {
    let bench = Bench::new();
    assert!(bench.text("measure list").contains("alpha"), "parameters");
    let models = bench.json("measure list");
    assert!(models["models"].as_array().unwrap().len() > 5, "{models}");
}

/// Scattered rows onto the MERL grid: the whole circle of azimuths through the interpolant.
#[test]
fn slow_rows_become_a_grid() {
    let bench = Bench::new();
    bench.write("a.astm", astm_rgb());
    let done = bench.json("convert a.astm a.binary");
    let error = done["round_trip_error"].as_f64().unwrap();
    // a smooth material: the linear interpolation of one-degree cells
    assert!(error > 0.0 && error < 0.01, "{done}");
    let lost = done["lost"].to_string();
    assert!(lost.contains("not reciprocal: 360 azimuths"), "{lost}");
    let [rows, grid] = ["astm", "binary"]
        .map(|e| numbers(&bench.json(&format!("eval a.{e} {AT}"))["linear_srgb"]));
    for c in 0..3 {
        assert!((grid[c] / rows[c] - 1.0).abs() < 0.01, "{grid:?} {rows:?}");
    }
}

#[test]
fn models_are_evaluated_and_plotted_like_files() {
    let bench = Bench::new();
    let value = bench.json("eval lambert:kd=0.5/0.25/1 --theta-i 20 --theta-o 70");
    assert_eq!(value["format"], "model", "{value}");
    for (f, kd) in numbers(&value["value"]).into_iter().zip([0.5, 0.25, 1.0]) {
        assert!((f * std::f64::consts::PI - kd).abs() < 1e-12, "{value}");
    }
    bench.text("plot ggx:alpha=0.1 lambert:kd=0.5 --theta-i 30 -o both.svg");
    let drawn = String::from_utf8(bench.read("both.svg")).unwrap();
    assert!(
        drawn.contains("ggx:alpha=0.1") && drawn.contains("lambert:kd=0.5"),
        "no legend"
    );
    let refused = bench.run("plot ggx:alpha=9 -o broken.svg");
    assert_eq!(refused.code, 1);
    assert!(refused.err.contains("alpha"), "{}", refused.err);
    assert!(!bench.path("broken.svg").exists());
}
