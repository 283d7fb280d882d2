//! Small sound files that the tests break, convert and compare.

use brdf_formats::{AstmFile, Channels};
use brdf_measure::cornell_directions;

/// A MERL file of these dimensions, every value `of(cell)`.
pub(crate) fn merl(dims: [i32; 3], of: impl Fn(usize) -> f64) -> Vec<u8> {
    let cells = dims.iter().product::<i32>() as usize;
    let mut bytes: Vec<u8> = dims.iter().flat_map(|d| d.to_le_bytes()).collect();
    for _ in 0..3 {
        bytes.extend((0..cells).flat_map(|k| of(k).to_le_bytes()));
    }
    bytes
}

/// pbrt-v2 text with three wavelengths in Cornell's directions: a diffuse material that is red.
pub(crate) fn pbrt_text() -> String {
    let mut text = String::from("# a comment\n\n3\n\n400 550 700\n\n");
    for angles in cornell_directions(17.0) {
        for a in angles {
            text.push_str(&format!("{a:.6} "));
        }
        text.push_str(&format!("0.02 0.05 {:.6}\n", 0.2 + 0.01 * angles[2]));
    }
    text
}

/// A measurement of a material that is darker toward the rim, in the RGB of Cornell's files.
pub(crate) fn astm_rgb() -> Vec<u8> {
    let directions = cornell_directions(17.0);
    let rows = directions.iter().flat_map(|a| {
        let level = 0.02 + 0.05 * a[2].cos() * a[0].cos();
        [a[0], a[1], a[2], a[3], level, 0.5 * level, 0.25 * level]
    });
    let fields = [("SAMPLE_NAME", "test")];
    let file = AstmFile::new(&fields, Channels::Rgb, rows.collect()).unwrap();
    file.to_bytes()
}

/// A tensor file with one field, as its offset, shape and type claim.
pub(crate) fn tensor(dtype: u8, offset: u64, shape: [u64; 2], data: &[u8]) -> Vec<u8> {
    let mut bytes = b"tensor_file\0\x01\0".to_vec();
    bytes.extend(1_u32.to_le_bytes());
    bytes.extend(7_u16.to_le_bytes());
    bytes.extend(b"theta_i");
    bytes.extend(2_u16.to_le_bytes());
    bytes.push(dtype);
    bytes.extend(offset.to_le_bytes());
    bytes.extend(shape.iter().flat_map(|s| s.to_le_bytes()));
    bytes.extend(data);
    bytes
}

/// A scene of one sphere around `fields`.
pub(crate) fn scene(fields: &str) -> String {
    format!(
        "(\n  camera: (position: (0, 1, 5), target: (0, 1, 0)),\n  film: (width: 8, height: 8),\n  \
         render: (spp: 1),\n  {fields}\n)"
    )
}
