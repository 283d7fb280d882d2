//! Streams: results on stdout, the rest on stderr, whatever they are connected to.

use crate::fixtures::merl;
use crate::program::Bench;
use std::process::Stdio;

/// A reader that has seen enough closes its end: no panic, no error.
#[test]
fn closed_pipe_is_no_error() {
    let bench = Bench::new();
    let mut child = bench
        .command("measure list")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(
        output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[cfg(target_os = "linux")]
#[test]
fn full_disk_is_an_error_and_a_full_log_is_not() {
    let bench = Bench::new();
    bench.write("m.binary", merl([6, 6, 12], |_| 1.0));
    let full = || {
        std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap()
    };
    let output = bench
        .command("info m.binary")
        .stdout(full())
        .output()
        .unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(
        error.starts_with("gonio: standard output: cannot write") && error.lines().count() == 1,
        "{error}"
    );
    let status = bench
        .command("render --size 4x4 --spp 1 --explain")
        .stderr(full())
        .stdout(Stdio::null())
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(0), "a log that cannot be written");
}

#[test]
fn logs_go_to_stderr_and_results_to_stdout() {
    let bench = Bench::new();
    let run = bench.run("render --size 16x9 --spp 16 --explain");
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(
        run.err.contains(
            "left out:\n  triangles: no tree is built or walked (with it 1.16 times the time)\n"
        ),
        "{}",
        run.err
    );
    assert!(
        run.err.contains("rendered 100 %\n") && !run.err.contains('\r'),
        "plain lines: {}",
        run.err
    );
    for expected in [
        "16 samples a pixel",
        "relative RMSE",
        "wrote gonio.exr",
        "wrote gonio.png",
        "gonio info FILE",
    ] {
        assert!(run.out.contains(expected), "{expected}: {}", run.out);
    }
}
