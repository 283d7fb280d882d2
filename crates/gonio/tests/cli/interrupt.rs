//! Ctrl-C.

#![cfg(unix)]

use crate::program::Bench;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::time::Duration;

#[test]
fn ctrl_c_keeps_what_there_is() {
    let bench = Bench::new();
    let mut child = bench
        .command("render --size 64x36 --spp 16000000 --threads 1 --explain -o long.exr")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut log = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    // the last line before rendering begins
    while !line.contains("pixel filter") {
        line.clear();
        assert!(
            log.read_line(&mut line).unwrap() > 0,
            "ended before it rendered"
        );
    }
    std::thread::sleep(Duration::from_millis(500));
    let sent = Command::new("kill")
        .arg("-INT")
        .arg(child.id().to_string())
        .status()
        .unwrap();
    assert!(sent.success(), "kill");
    let mut rest = String::new();
    log.read_to_string(&mut rest).unwrap();
    let output = child.wait_with_output().unwrap();
    let out = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{rest}");
    assert!(
        rest.contains("interrupted: finishing the tiles at hand"),
        "{rest}"
    );
    assert!(
        out.starts_with("interrupted: the picture holds what was rendered until then\n"),
        "{out}"
    );
    let picture = scene_io::image::read_exr(&bench.path("long.exr")).unwrap();
    assert_eq!((picture.width, picture.height), (64, 36));
    assert!(
        picture.pixels.iter().flatten().all(|v| v.is_finite()),
        "not finite"
    );
    assert!(picture.pixels.iter().flatten().any(|v| *v > 0.0), "black");
    assert!(bench.read("long.png").starts_with(b"\x89PNG"), "no PNG");
}
