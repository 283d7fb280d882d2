//! `--target-error` and `--time`.

use crate::program::{Bench, repository};
use scene_io::image::read_exr;

#[test]
fn a_target_chooses_samples_and_nothing_else() {
    let bench = Bench::new();
    let scene = repository("scenes/closed-form/scene.ron");
    let render = format!("render {scene} --size 32x20");
    let said = bench.json(&format!(
        "{render} --target-error 1% --confidence 90% -o a.exr"
    ));
    let target = &said["target"];
    assert_eq!(target["reached"], true, "{said}");
    assert!(target["bound"].as_f64().unwrap() <= 0.01, "{said}");
    assert!(
        (target["confidence"].as_f64().unwrap() - 0.9).abs() < 1e-12,
        "{said}"
    );
    let spp = said["spp"].as_u64().unwrap();
    bench.text(&format!("{render} --spp {spp} -o b.exr"));
    let [a, b] = ["a.exr", "b.exr"].map(|name| read_exr(&bench.path(name)).unwrap());
    assert!(a.pixels == b.pixels, "not the picture of --spp {spp}");
}

#[test]
fn a_target_out_of_reach_is_said() {
    let bench = Bench::new();
    let run = bench.text("render --size 16x16 --target-error 0.01% --spp 64 -o a.exr");
    assert!(run.starts_with("64 samples a pixel"), "{run}");
    assert!(run.contains("target 0.010 % not met"), "{run}");
}

#[test]
fn time_is_kept() {
    let bench = Bench::new();
    let said = bench.json("render --size 32x20 --time 1s -o a.exr");
    let seconds = said["seconds"].as_f64().unwrap();
    // other processes may take the processor away in the last half
    assert!(seconds > 0.5 && seconds < 2.0, "{said}");
    assert_eq!(said["spp"].as_u64().unwrap() % 8, 0, "{said}");
}

#[test]
fn light_strategies_are_chosen_and_explained() {
    let bench = Bench::new();
    let run = bench.run("render --size 16x16 --spp 8 --explain -o a.exr");
    assert!(run.err.contains("squared error times work"), "{}", run.err);
    let said = bench.json("render --size 16x16 --spp 8 --light-strategy ris -o a.exr");
    assert_eq!(said["light_strategy"], "ris");
    for wrong in [
        "--target-error 0",
        "--time never",
        "--shard 4/3 --checkpoint x",
        "--shard 1/3",
        "--confidence 90%",
    ] {
        assert_eq!(bench.run(&format!("render {wrong}")).code, 2, "{wrong}");
    }
}
