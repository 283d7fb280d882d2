//! One program for all machines: pictures agree across instruction sets.

use crate::program::{Bench, repository};

/// Where sums of f32 may be taken in another order.
const LIMIT: f64 = 1e-5;

#[test]
fn pictures_agree_without_wide_instructions() {
    let bench = Bench::new();
    let benchmark = repository("scenes/benchmark/scene.ron");
    let mesh = repository("scenes/benchmark-mesh/scene.ron");
    let base = repository("scenes/thesis/base.ron");
    for (scene, more) in [
        (&benchmark, ""),
        (&benchmark, "--sampler hvt --light-strategy ris"),
        (&benchmark, "--spectrum 8"),
        (&mesh, "--spectrum hero"),
        (&base, ""),
    ] {
        let line = format!("render {scene} {more} --size 48x36 --spp 8 --json -o");
        let wide = bench.text(&format!("{line} wide.exr"));
        let narrow = (bench.command(&format!("{line} narrow.exr")))
            .env("GONIO_NARROW", "1")
            .output()
            .unwrap();
        let narrow = String::from_utf8(narrow.stdout).unwrap();
        assert!(narrow.contains(r#""instructions":"plain""#), "{narrow}");
        assert!(!wide.is_empty(), "{more}");
        let apart = bench.json("compare wide.exr narrow.exr");
        let rel = apart["rel_rmse"].as_f64().unwrap();
        assert!(rel < LIMIT, "{scene} {more}: {rel:e}");
    }
}
