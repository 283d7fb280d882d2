//! `gonio converge`: files, keys, refusals, and figures that are known beforehand.

use crate::program::{Bench, numbers, repository};
use serde_json::Value;

/// A small comparison: 16 x 12 pixels of the benchmark scene with a diffuse sphere.
fn line(rest: &str) -> String {
    let scene = repository("scenes/benchmark/scene.ron");
    format!(
        "converge {scene} --material lambert:kd=0.5 --size 16x12 --seconds 3600 --reference-spp 4096 {rest} -o out"
    )
}

fn curve<'a>(value: &'a Value, method: &str) -> &'a Value {
    let curves = value["curves"].as_array().unwrap();
    curves.iter().find(|c| c["method"] == method).unwrap()
}

#[test]
fn writes_all_files_with_the_documented_keys() {
    let bench = Bench::new();
    let value = bench.json(&line("--methods cosine,uniform+random+bsdf --spp-max 16"));
    for file in [
        "converge.csv",
        "converge.json",
        "converge.svg",
        "converge.png",
        "reference.exr",
    ] {
        assert!(!bench.read(&format!("out/{file}")).is_empty(), "{file}");
    }
    assert_eq!(value["written"].as_array().unwrap().len(), 5, "{value}");
    let own = value["reference_rel_rmse"].as_f64().unwrap();
    assert!(own > 0.0 && own < 0.01, "reference: {own}");
    let names: Vec<&Value> = (value["curves"].as_array().unwrap().iter())
        .map(|c| &c["method"])
        .collect();
    assert_eq!(names, ["cosine+sobol+mis", "uniform+random+bsdf"]);
    for curve in value["curves"].as_array().unwrap() {
        let points = curve["points"].as_array().unwrap();
        let spp: Vec<u64> = points.iter().map(|p| p["spp"].as_u64().unwrap()).collect();
        assert_eq!(spp, [1, 2, 4, 8, 16], "{curve}");
        for key in ["slope", "slope_error", "slope_spp", "seconds_to_target"] {
            assert!(curve[key].is_number(), "{key}: {curve}");
        }
        for p in points {
            let [low, high] = *numbers(&p["ci"]).first_chunk::<2>().unwrap();
            let error = p["rel_rmse"].as_f64().unwrap();
            assert!(low <= error && error <= high, "{p}");
            assert!(p["seconds"].as_f64().unwrap() > 0.0, "{p}");
        }
    }
    let csv = String::from_utf8(bench.read("out/converge.csv")).unwrap();
    assert_eq!(csv.lines().count(), 11, "{csv}");
    let stored: Value = serde_json::from_slice(&bench.read("out/converge.json")).unwrap();
    assert_eq!(stored, value, "the file says what is printed");
}

#[test]
fn random_points_fall_with_the_square_root_and_sobol_faster() {
    let bench = Bench::new();
    let value = bench.json(&line("--methods cosine,cosine+random --spp-max 64"));
    let slope = |method| {
        let c = curve(&value, method);
        [&c["slope_spp"], &c["slope_spp_error"]].map(|v| v.as_f64().unwrap())
    };
    let [random, error] = slope("cosine+random+mis");
    assert!(
        (random + 0.5).abs() < 4.0 * error && error < 0.05,
        "{random} +- {error}"
    );
    let [sobol, error] = slope("cosine+sobol+mis");
    assert!(sobol + 4.0 * error < -0.55, "{sobol} +- {error}");
}

/// A method against itself with other seeds: the same error after the same samples, within the intervals.
#[test]
fn a_method_has_the_variance_of_its_copy() {
    let bench = Bench::new();
    let value = bench.json(&line(
        "--methods uniform+random,uniform+random --spp-max 32 --runs 12",
    ));
    let curves = value["curves"].as_array().unwrap();
    let at = |c: usize, k: usize| {
        let p = &curves[c]["points"][k];
        let [low, high] = *numbers(&p["ci"]).first_chunk::<2>().unwrap();
        // half the interval in the logarithm, over Student's t of 11 degrees [Abramowitz1964, table 26.10]
        (
            p["rel_rmse"].as_f64().unwrap().ln(),
            (high / low).ln() / (2.0 * 2.201),
        )
    };
    // errors of one curve go together, so the last point stands for all; 4 sigma
    let ((a, ea), (b, eb)) = (at(0, 5), at(1, 5));
    assert!(
        (a - b).abs() < 4.0 * ea.hypot(eb),
        "{a} +- {ea}, {b} +- {eb}"
    );
    assert!(a.to_bits() != b.to_bits(), "seeds of their own");
    let ratio = &value["ratios"][0];
    assert!(ratio["ratio"].as_f64().unwrap() >= 1.0, "{ratio}");
    assert_eq!(ratio["slower"], ratio["faster"], "{ratio}");
}

/// The reference of one comparison serves another, and its error is what it said.
#[test]
fn a_reference_can_be_used_again() {
    let bench = Bench::new();
    let first = bench.json(&line("--methods cosine --spp-max 4"));
    let scene = repository("scenes/benchmark/scene.ron");
    let again = bench.json(&format!(
        "converge {scene} --material lambert:kd=0.5 --size 16x12 --methods cosine --spp-max 4 \
         --reference out/reference.exr -o again"
    ));
    let error = |v: &Value| v["reference_rel_rmse"].as_f64().unwrap();
    assert!(
        (error(&first) / error(&again) - 1.0).abs() < 1e-5,
        "stored as f32"
    );
    let points = |v: &Value| -> Vec<f64> {
        let points = v["curves"][0]["points"].as_array().unwrap();
        points
            .iter()
            .map(|p| p["rel_rmse"].as_f64().unwrap())
            .collect()
    };
    assert_eq!(points(&first), points(&again), "same seeds, same errors");
    assert!(
        !bench.path("again/reference.exr").exists(),
        "only what was rendered is written"
    );
}

#[test]
fn what_cannot_be_compared_is_refused_in_one_line() {
    let bench = Bench::new();
    bench.write("point.ron", crate::fixtures::scene(
        "materials: { \"m\": Lambert(reflectance: 0.5) },\n  shapes: [(form: Sphere(center: (0, 1, 0), radius: 1), material: \"m\")],\n  \
         lights: [Point(position: (0, 4, 2), intensity: 3)],",
    ));
    let scene = repository("scenes/benchmark/scene.ron");
    let exr = "render --size 8x8 --spp 16 -o small.exr";
    bench.text(exr);
    for (line, code, said) in [
        (
            format!("converge {scene} --methods hvd -o out"),
            2,
            "\"hvd\"",
        ),
        (
            format!("converge {scene} --methods hvt+sobl -o out"),
            2,
            "\"sobl\"",
        ),
        (
            format!("converge {scene} --seconds -1 -o out"),
            2,
            "--seconds",
        ),
        (format!("converge {scene} --target 0 -o out"), 2, "--target"),
        (format!("converge {scene} --runs 2 -o out"), 2, "--runs"),
        (format!("converge {scene}"), 2, "--output"),
        (
            format!("converge {scene} --reference none.exr -o out"),
            1,
            "none.exr",
        ),
        (
            format!("converge {scene} --size 16x12 --reference small.exr -o out"),
            1,
            "16 x 12",
        ),
        (
            format!("converge {scene} --size 4000x4000 --runs 64 -o out"),
            1,
            "smaller size",
        ),
        (
            "converge point.ron --methods cosine+bsdf -o out".into(),
            1,
            "point and directional lights",
        ),
        ("converge none.ron -o out".into(), 1, "none.ron"),
        (format!("converge {scene} -o small.exr"), 1, "small.exr"),
    ] {
        let run = bench.run(&line);
        assert_eq!(run.code, code, "gonio {line}: {}", run.err);
        assert!(run.err.contains(said), "gonio {line}: {}", run.err);
        assert_eq!(run.err.lines().count(), 1, "gonio {line}: {}", run.err);
        assert!(run.out.is_empty(), "gonio {line}: {}", run.out);
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_complete() {
    let bench = Bench::new();
    let child = bench
        .command(&line("--methods cosine,uniform --json"))
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    // the reference is written when it is done; soon after, the first levels are
    let wait = |ms| std::thread::sleep(std::time::Duration::from_millis(ms));
    for _ in 0..1000 {
        if bench.path("out/reference.exr").exists() {
            break;
        }
        wait(20);
    }
    wait(300);
    let id = child.id().to_string();
    let killed = std::process::Command::new("kill")
        .args(["-INT", &id])
        .status()
        .unwrap();
    assert!(killed.success(), "kill");
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{error}");
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(value["interrupted"], true, "{value}");
    assert!(
        !value["curves"][0]["points"].as_array().unwrap().is_empty(),
        "{value}"
    );
    assert!(
        !bench.read("out/converge.csv").is_empty(),
        "partial results"
    );
}
