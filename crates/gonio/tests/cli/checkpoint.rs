//! Killed, shared and stopped renders end at the same bits.

use crate::program::{Bench, repository};
use scene_io::image::read_exr;
use std::process::Stdio;
use std::time::Duration;

/// A scene that is built in no time.
fn scene() -> String {
    let file = repository("scenes/closed-form/scene.ron");
    format!("render {file} --size 40x24 --seed 5 --light-strategy mis")
}

/// Pixels and variances; not the metadata, which hold the seconds.
fn bits(bench: &Bench, name: &str) -> Vec<u32> {
    let picture = read_exr(&bench.path(name)).unwrap();
    let variance = picture.variance.unwrap();
    let all = picture.pixels.iter().chain(&variance).flatten();
    all.map(|v| v.to_bits()).collect()
}

#[test]
fn a_render_that_goes_on_is_the_render_that_never_stopped() {
    let (bench, scene) = (Bench::new(), scene());
    bench.text(&format!("{scene} --spp 64 --threads 1 -o whole.exr"));
    bench.text(&format!("{scene} --spp 24 --checkpoint film -o part.exr"));
    let run = bench.run(&format!(
        "{scene} --spp 64 --checkpoint film --threads 2 -o resumed.exr"
    ));
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(
        run.err.contains("going on from film: 24 of 64"),
        "{}",
        run.err
    );
    assert!(
        bits(&bench, "whole.exr") == bits(&bench, "resumed.exr"),
        "other bits"
    );
    assert!(
        bits(&bench, "whole.exr") != bits(&bench, "part.exr"),
        "nothing was added"
    );
}

#[test]
fn shards_merge_to_the_same_bits() {
    let (bench, scene) = (Bench::new(), scene());
    bench.text(&format!("{scene} --spp 32 -o whole.exr"));
    for k in 1..=3 {
        let threads = 1 + k % 2;
        bench.text(&format!(
            "{scene} --spp 32 --shard {k}/3 --checkpoint s{k} --threads {threads}"
        ));
    }
    let said = bench.json("merge s3 s1 s2 -o merged.exr");
    assert_eq!(said["shards"], 3);
    assert_eq!(said["spp"], 32);
    assert!(said["rel_rmse"].as_f64().unwrap() > 0.0, "{said}");
    assert!(
        bits(&bench, "whole.exr") == bits(&bench, "merged.exr"),
        "other bits"
    );
    let [a, b] = ["whole.png", "merged.png"].map(|name| bench.read(name));
    assert!(a == b, "another PNG");

    bench.text(&format!("{scene} --spp 16 --shard 2/3 --checkpoint short"));
    bench.text(
        &format!("{scene} --spp 32 --seed 6 --shard 2/3 --checkpoint foreign")
            .replace("--seed 5 ", ""),
    );
    bench.text(&format!("{scene} --spp 8 --checkpoint film -o x.exr"));
    for (shards, expected) in [
        ("s1 s3", "found none for 2/3"),
        ("s1 s2 s2", "found shard 2/3 again after s2"),
        ("s1 short s3", "short: expected a shard of the render of s1"),
        (
            "s1 foreign s3",
            "foreign: expected a shard of the render of s1",
        ),
        (
            "s1 s2 film",
            "film: expected a shard, found the checkpoint of a whole picture",
        ),
        ("s1 none", "none: "),
    ] {
        let run = bench.run(&format!("merge {shards} -o y.exr"));
        assert_eq!(run.code, 1, "{shards}: {}", run.err);
        assert!(run.err.contains(expected), "{shards}: {}", run.err);
        assert_eq!(run.err.lines().count(), 1, "{}", run.err);
        assert!(!bench.path("y.exr").exists(), "{shards}");
    }
}

/// Every mode keeps its channels: bins and bands come back from shards and from a film that was stopped.
#[test]
fn every_mode_is_resumed_and_merged_to_the_same_bits() {
    let (bench, scene) = (Bench::new(), scene());
    let planes = |name: &str| scene_io::image::read_spectral_exr(&bench.path(name)).ok();
    for mode in ["rgb", "xyz", "8", "16", "45", "native", "hero"] {
        let scene = format!("{scene} --spectrum {mode}");
        bench.text(&format!("{scene} --spp 32 --threads 1 -o whole.exr"));
        let film = format!("film-{mode}");
        bench.text(&format!("{scene} --spp 8 --checkpoint {film} -o part.exr"));
        bench.text(&format!(
            "{scene} --spp 32 --checkpoint {film} -o resumed.exr"
        ));
        for k in 1..=2 {
            bench.text(&format!(
                "{scene} --spp 32 --shard {k}/2 --checkpoint {mode}-{k}"
            ));
        }
        let said = bench.json(&format!("merge {mode}-2 {mode}-1 -o merged.exr"));
        assert_eq!(said["shards"], 2, "{mode}: {said}");
        for other in ["resumed", "merged"] {
            let name = format!("{other}.exr");
            assert!(
                bits(&bench, "whole.exr") == bits(&bench, &name),
                "{mode}: {other}"
            );
            assert!(planes("whole.exr") == planes(&name), "{mode}: {other}");
            let [a, b] = ["whole.png", &format!("{other}.png")].map(|name| bench.read(name));
            assert!(a == b, "{mode}: another PNG of {other}");
        }
        let spectral = !matches!(mode, "rgb" | "xyz" | "hero");
        assert_eq!(planes("merged.exr").is_some(), spectral, "{mode}");
    }
    // shards of two modes are not of one render
    let run = bench.run("merge 8-1 16-2 -o x.exr");
    assert_eq!(run.code, 1, "{}", run.err);
    assert!(
        run.err.contains("expected a shard of the render of 8-1"),
        "{}",
        run.err
    );
    let run = bench.run(&format!(
        "{scene} --spectrum 16 --spp 32 --checkpoint film-8 -o x.exr"
    ));
    assert!(
        run.code == 1 && run.err.contains("belongs to other input"),
        "{}",
        run.err
    );
}

#[test]
fn checkpoints_that_do_not_fit_are_refused_in_one_line() {
    let (bench, scene) = (Bench::new(), scene());
    bench.text(&format!("{scene} --spp 16 --checkpoint film -o a.exr"));
    let whole = bench.read("film");
    bench.write("cut", &whole[..whole.len() / 2]);
    let mut flipped = whole.clone();
    flipped[200] ^= 1;
    bench.write("flipped", &flipped);
    bench.write("text", "no checkpoint");
    for (line, expected) in [
        (
            format!("{scene} --spp 16 --checkpoint cut"),
            "cut: not a checkpoint of this render: expected",
        ),
        (
            format!("{scene} --spp 16 --checkpoint flipped"),
            "flipped: not a checkpoint of this render: the checksum",
        ),
        (
            format!("{scene} --spp 16 --checkpoint text"),
            "text: not a checkpoint",
        ),
        (
            format!("{scene} --spp 8 --checkpoint film"),
            "film: expected at most 8 samples a pixel, found 16",
        ),
        (
            format!("{scene} --spp 16 --sampler cosine --checkpoint film"),
            "film: not a checkpoint of this render: belongs to other input",
        ),
        (
            format!("{scene} --spp 16 --checkpoint none/film"),
            "none/film: cannot write",
        ),
    ] {
        let run = bench.run(&format!("{line} -o b.exr"));
        assert_eq!(run.code, 1, "{line}: {}", run.err);
        assert!(run.err.contains(expected), "{line}: {}", run.err);
        assert!(!bench.path("b.exr").exists(), "{line}");
    }
    assert_eq!(
        bench.read("film"),
        whole,
        "a refused checkpoint was touched"
    );
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_the_checkpoint() {
    let (bench, scene) = (Bench::new(), scene());
    let mut child = bench
        .command(&format!(
            "{scene} --spp 1000000 --threads 1 --checkpoint film --checkpoint-every 0.1 -o a.exr"
        ))
        .stderr(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while !bench.path("film").exists() {
        std::thread::sleep(Duration::from_millis(20));
    }
    let id = child.id().to_string();
    let sent = std::process::Command::new("kill")
        .args(["-INT", &id])
        .status();
    assert!(sent.unwrap().success(), "kill");
    assert!(child.wait().unwrap().success(), "ended otherwise");
    let found = scene_io::checkpoint::open::<3>(&bench.path("film")).unwrap();
    // the picture was made of the very samples the checkpoint holds
    let kept = scene_io::image::Picture::of_film(&found.film).unwrap();
    assert!(
        kept.pixels == read_exr(&bench.path("a.exr")).unwrap().pixels,
        "other samples"
    );
}

#[cfg(unix)]
#[test]
fn slow_ten_kills_lose_nothing() {
    let (bench, scene) = (Bench::new(), scene());
    let render = format!("{scene} --spp 4096");
    let start = std::time::Instant::now();
    bench.text(&format!("{render} --threads 1 -o whole.exr"));
    let whole = start.elapsed().as_secs_f64();
    let mut rng = 0x9e37_79b9_u64;
    let mut kept = 0;
    for kill in 0..10 {
        let mut child = bench
            .command(&format!(
                "{render} --threads {} --checkpoint film --checkpoint-every 0.02 -o a.exr",
                1 + kill % 2
            ))
            .stderr(Stdio::null())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        rng = rng.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        // all ten together stay below the time of the whole render
        let wait = whole * 0.02 + whole * 0.1 * (rng >> 40) as f64 / (1 << 24) as f64;
        std::thread::sleep(Duration::from_secs_f64(wait));
        // kill -9
        child.kill().unwrap();
        child.wait().unwrap();
        if bench.path("film").exists() {
            // readable, whole, and never less than before
            let found = scene_io::checkpoint::open::<3>(&bench.path("film")).unwrap();
            assert!(found.film.samples() >= kept, "kill {kill} lost samples");
            kept = found.film.samples();
        }
    }
    assert!(kept > 0, "no checkpoint was ever written");
    bench.text(&format!("{render} --checkpoint film -o resumed.exr"));
    assert!(
        bits(&bench, "whole.exr") == bits(&bench, "resumed.exr"),
        "other bits"
    );
}

/// Runs a command line that may write no file beyond `blocks` of 512 bytes: what a full disk is to a program.
#[cfg(unix)]
fn on_full_disk(bench: &Bench, line: &str, blocks: u32) -> (Option<i32>, String) {
    let gonio = bench.command(line);
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let output = std::process::Command::new("sh")
        .args(["-c", &script])
        .arg(gonio.get_program())
        .args(gonio.get_args())
        .current_dir(bench.path(""))
        .env("GONIO_CACHE", bench.path(".cache"))
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    (output.status.code(), said)
}

#[cfg(unix)]
#[test]
fn a_full_disk_costs_the_checkpoint_alone() {
    let (bench, scene) = (Bench::new(), scene());
    bench.text(&format!("{scene} --spp 64 -o whole.exr"));
    bench.text(&format!("{scene} --spp 16 --checkpoint film -o part.exr"));
    let before = (bench.read("film"), bench.files());
    // the film takes 184 kB, the pictures less than 64 KiB
    let line = format!("{scene} --spp 64 --checkpoint film -o part.exr --json");
    let (code, said) = on_full_disk(&bench, &line, 128);
    assert_eq!(code, Some(1), "{said}");
    let last = said.lines().last().unwrap();
    assert!(
        last.starts_with(
            "gonio: the picture was written, but not its samples: film: cannot write: "
        ),
        "{said}"
    );
    assert!(
        bits(&bench, "whole.exr") == bits(&bench, "part.exr"),
        "the picture has all samples"
    );
    assert_eq!(
        (bench.read("film"), bench.files()),
        before,
        "the old checkpoint stays, and nothing else"
    );
    bench.text(&format!(
        "{scene} --spp 64 --checkpoint film -o resumed.exr"
    ));
    assert!(
        bits(&bench, "whole.exr") == bits(&bench, "resumed.exr"),
        "other bits"
    );

    // not even the pictures fit
    let (code, said) = on_full_disk(&bench, &line, 1);
    assert_eq!(code, Some(1), "{said}");
    let last = said.lines().last().unwrap();
    assert!(
        last.starts_with("gonio: part.exr: cannot write: "),
        "{said}"
    );
    assert!(
        bits(&bench, "whole.exr") == bits(&bench, "part.exr"),
        "the old picture stays"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_may_not_be_written_is_known_before_rendering() {
    let (bench, scene) = (Bench::new(), scene());
    // nobody may make files there, not even root
    let run = bench.run(&format!("{scene} --spp 100000 --checkpoint /proc/film"));
    assert_eq!(run.code, 1, "{}", run.err);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    assert!(
        run.err.starts_with("gonio: /proc/film: cannot write: "),
        "{}",
        run.err
    );
    assert!(bench.files().is_empty(), "{:?}", bench.files());
}
