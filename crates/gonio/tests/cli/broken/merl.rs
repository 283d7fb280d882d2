//! MERL files.

use super::check;
use crate::fixtures::merl;
use crate::program::Bench;

#[test]
fn merl_files() {
    let bench = Bench::new();
    let sound = merl([6, 6, 12], |k| 1.0 + k as f64);
    bench.write("sound.binary", &sound);
    bench.write("truncated.binary", &sound[..sound.len() - 5]);
    bench.write("longer.binary", [&sound[..], b"12345678"].concat());
    let dims = |d: [i32; 3]| {
        [
            &d.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>()[..],
            &sound[12..],
        ]
        .concat()
    };
    bench.write("lying.binary", dims([6, 6, 13]));
    bench.write("huge.binary", dims([i32::MAX, i32::MAX, i32::MAX]));
    bench.write("negative.binary", dims([-6, -6, 12]));
    bench.write("zero.binary", dims([0, 6, 12]));
    bench.write("empty.binary", b"");
    bench.write("short.binary", b"\x06\0\0\0");
    bench.write("nan.binary", merl([6, 6, 12], |_| f64::NAN));
    bench.write("unmeasured.binary", merl([6, 6, 12], |_| -1.0));
    bench.write("text.binary", "once upon a time\n");
    std::fs::create_dir(bench.path("folder.binary")).unwrap();
    assert_eq!(bench.run("info sound.binary").code, 0, "the sound file");
    check(
        &bench,
        &[
            (
                "info truncated.binary",
                1,
                &["truncated.binary", "expected", "found"],
            ),
            (
                "info longer.binary",
                1,
                &["longer.binary", "expected", "found"],
            ),
            (
                "info lying.binary",
                1,
                &["lying.binary", "expected", "found"],
            ),
            ("info huge.binary", 1, &["huge.binary", "expected", "found"]),
            (
                "info negative.binary",
                1,
                &["negative.binary", "expected", "found"],
            ),
            ("info zero.binary", 1, &["zero.binary", "expected", "found"]),
            (
                "info empty.binary",
                1,
                &["empty.binary", "expected", "an empty file"],
            ),
            (
                "info short.binary",
                1,
                &["short.binary", "expected", "found"],
            ),
            (
                "info nan.binary",
                1,
                &["nan.binary", "expected measured cells", "found none"],
            ),
            (
                "info unmeasured.binary",
                1,
                &["unmeasured.binary", "expected measured cells", "found none"],
            ),
            (
                "info text.binary",
                1,
                &[
                    "text.binary",
                    "expected one of",
                    "merl",
                    "found `once upon a time",
                ],
            ),
            (
                "info folder.binary",
                1,
                &["folder.binary", "expected a file", "found a folder"],
            ),
            (
                "info missing.binary",
                1,
                &["missing.binary", "no such file", "GONIO_DATA"],
            ),
            (
                "eval truncated.binary --theta-i 1 --theta-o 1",
                1,
                &["truncated.binary", "expected", "found"],
            ),
            (
                "plot nan.binary -o a.svg",
                1,
                &["nan.binary", "expected measured cells"],
            ),
            (
                "convert lying.binary a.astm",
                1,
                &["lying.binary", "expected", "found"],
            ),
            (
                "mix sound.binary:1 nan.binary:1 -o a.binary",
                1,
                &["nan.binary", "expected measured cells"],
            ),
            (
                "render --material truncated.binary -o a.exr",
                1,
                &["truncated.binary", "expected", "found"],
            ),
            (
                "eval sound.binary --theta-i 1 --theta-o 1 --interpolation thin-plate",
                1,
                &[
                    "sound.binary",
                    "expected an interpolation",
                    "found \"thin-plate\"",
                ],
            ),
        ],
    );
}
