//! RGL tensor files.

use super::check;
use crate::fixtures::tensor;
use crate::program::Bench;

#[test]
fn tensor_files() {
    let bench = Bench::new();
    let data = 1.0_f32.to_le_bytes().repeat(6);
    let start = 18 + 2 + 7 + 2 + 1 + 8 + 16;
    let sound = tensor(10, start, [2, 3], &data);
    bench.write("truncated.bsdf", &sound[..40]);
    bench.write("cut.bsdf", &sound[..sound.len() - 4]);
    bench.write("lacking.bsdf", &sound);
    bench.write("shape.bsdf", tensor(10, start, [2, 1 << 40], &data));
    bench.write("offset.bsdf", tensor(10, 1 << 50, [2, 3], &data));
    bench.write("dtype.bsdf", tensor(77, start, [2, 3], &data));
    let mut version = sound.clone();
    version[12] = 9;
    bench.write("version.bsdf", &version);
    check(
        &bench,
        &[
            (
                "info truncated.bsdf",
                1,
                &["truncated.bsdf: byte ", "expected", "found"],
            ),
            (
                "info cut.bsdf",
                1,
                &[
                    "cut.bsdf: byte ",
                    "expected data within the file's",
                    "found",
                ],
            ),
            (
                "info lacking.bsdf",
                1,
                &["lacking.bsdf: ", "expected", "found"],
            ),
            (
                "info shape.bsdf",
                1,
                &[
                    "shape.bsdf: byte ",
                    "expected data within the file's",
                    "found shape",
                ],
            ),
            (
                "info offset.bsdf",
                1,
                &[
                    "offset.bsdf: byte ",
                    "expected data within the file's",
                    "found shape",
                ],
            ),
            (
                "info dtype.bsdf",
                1,
                &["dtype.bsdf: byte ", "dtype", "found 77"],
            ),
            (
                "info version.bsdf",
                1,
                &["version.bsdf: byte ", "version: expected 1.x", "found 9"],
            ),
            (
                "render --material lacking.bsdf -o a.exr",
                1,
                &["lacking.bsdf", "expected", "found"],
            ),
        ],
    );
}
