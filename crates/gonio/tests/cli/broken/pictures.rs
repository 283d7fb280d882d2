//! Pictures.

use super::check;
use crate::program::Bench;

#[test]
fn pictures() {
    let bench = Bench::new();
    for (name, side) in [("a.exr", 4), ("b.exr", 5)] {
        let pixels = vec![[1.0; 3]; side * side];
        let picture = scene_io::image::Picture::new(side, side, pixels).unwrap();
        scene_io::image::write_exr(&bench.path(name), &picture).unwrap();
    }
    let sound = bench.read("a.exr");
    bench.write("truncated.exr", &sound[..sound.len() / 2]);
    bench.write("cut.exr", &sound[..sound.len() - 9]);
    bench.write("text.exr", "not a picture");
    bench.write("empty.exr", "");
    check(
        &bench,
        &[
            (
                "compare truncated.exr a.exr",
                1,
                &["truncated.exr", "broken EXR file"],
            ),
            ("compare a.exr cut.exr", 1, &["cut.exr", "broken EXR file"]),
            (
                "compare text.exr a.exr",
                1,
                &["text.exr", "broken EXR file"],
            ),
            (
                "compare a.exr empty.exr",
                1,
                &["empty.exr", "broken EXR file"],
            ),
            (
                "compare a.exr b.exr",
                1,
                &[
                    "a.exr and b.exr",
                    "expected pictures of one size",
                    "found 4 x 4 and 5 x 5",
                ],
            ),
            ("compare a.exr gone.exr", 1, &["gone.exr", "no such file"]),
            (
                "compare a.exr .",
                1,
                &[".: expected a file", "found a folder"],
            ),
            ("compare a.exr", 2, &["required", "<B>"]),
        ],
    );
}
