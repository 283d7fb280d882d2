//! What a render says of its error: rows, layers, maps, warnings.

use crate::program::{Bench, numbers};

#[test]
fn rows_are_written_as_csv_and_json_and_end_at_the_reported_error() {
    let bench = Bench::new();
    let said = bench
        .json("render --size 24x16 --spp 64 --rows rows.csv --error-map map.png --seed 3 -o a.exr");
    let rows = said["rows"].as_array().unwrap();
    let spp: Vec<u64> = rows.iter().map(|r| r["spp"].as_u64().unwrap()).collect();
    assert_eq!(spp, [8, 16, 32, 64], "a row after each pass");
    assert_eq!(rows[3]["rel_rmse"], said["rel_rmse"]);
    let times: Vec<f64> = rows
        .iter()
        .map(|r| r["seconds"].as_f64().unwrap())
        .collect();
    assert!(times.is_sorted(), "{times:?}");
    let csv = String::from_utf8(bench.read("rows.csv")).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 5, "{csv}");
    assert_eq!(
        lines[0],
        "seconds,cpu_seconds,spp,rel_rmse,rel_rmse_low,rel_rmse_high"
    );
    let last: Vec<f64> = lines[4].split(',').map(|v| v.parse().unwrap()).collect();
    assert!(
        (last[3] - said["rel_rmse"].as_f64().unwrap()).abs() < 1e-15,
        "{last:?}"
    );
    let [low, high] = numbers(&said["rmse_ci"])[..] else {
        panic!("{said}")
    };
    let rmse = said["rmse"].as_f64().unwrap();
    assert!(low < rmse && rmse < high, "{low} {rmse} {high}");
    assert!(bench.read("map.png").starts_with(b"\x89PNG"), "no map");
}

#[test]
fn places_that_can_not_be_written_are_refused_before_rendering() {
    let bench = Bench::new();
    for flag in ["--rows none/rows.csv", "--error-map none/map.png"] {
        let run = bench.run(&format!("render --size 8x8 --spp 8 {flag} -o a.exr"));
        assert_eq!(run.code, 1, "{}", run.err);
        assert!(
            run.err.contains("none/") && run.err.contains("cannot write"),
            "{}",
            run.err
        );
        assert!(!bench.path("a.exr").exists(), "rendered for nothing");
    }
}

#[test]
fn samplers_that_break_the_points_are_warned_about() {
    let bench = Bench::new();
    let warning = "breaks the stratification of the points";
    let rejection = bench.run("render --size 8x8 --spp 8 --sampler rejection -o a.exr");
    assert!(rejection.err.contains(warning), "{}", rejection.err);
    let table = bench.run("render --size 8x8 --spp 8 --sampler hvt -o a.exr");
    assert!(!table.err.contains(warning), "{}", table.err);
}
