//! Pictures side by side with their names: a contact sheet.

use super::study::Study;
use crate::error::Error;
use crate::write;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use std::fmt::Write as _;
use std::io;
use std::path::Path;

/// Height of the line of text under a picture, pixels.
const LINE: usize = 22;
/// Between pictures, pixels.
const GAP: usize = 6;

/// Writes all modes of a study as one PNG, four in a row, each with its name, colour difference and seconds under it.
///
/// # Errors
/// If the text cannot be drawn or the file not be written.
pub fn write_sheet(path: &Path, study: &Study) -> Result<(), Error> {
    let Some(first) = study.modes.first() else {
        return Err(Error::invalid("expected at least one picture, found none").in_file(path));
    };
    let (w, h) = (first.picture.width, first.picture.height);
    let columns = study.modes.len().min(4);
    let rows = study.modes.len().div_ceil(columns);
    let (cell_w, cell_h) = (w + GAP, h + LINE + GAP);
    let (width, height) = (columns * cell_w + GAP, rows * cell_h + GAP);
    let mut sheet = vec![255_u8; 3 * width * height];
    for (k, mode) in study.modes.iter().enumerate() {
        let (x, y) = (GAP + k % columns * cell_w, GAP + k / columns * cell_h);
        for row in 0..h {
            let pixels = &mode.picture.pixels[row * w..(row + 1) * w];
            let at = 3 * ((y + row) * width + x);
            let bytes = pixels.iter().flat_map(|p| study.tone.show(*p));
            sheet[at..at + 3 * w]
                .iter_mut()
                .zip(bytes)
                .for_each(|(s, b)| *s = b);
        }
        let d = &mode.difference;
        let text = if mode.name == study.reference {
            format!("{}: the reference, {:.1} s", mode.name, mode.seconds)
        } else {
            format!(
                "{}: \u{394}E {:.3}, {:.1} s",
                mode.name, d.mean, mode.seconds
            )
        };
        let (line, line_w) = line_of(&text, w).map_err(|e| e.in_file(path))?;
        for row in 0..LINE.min(line.len() / (3 * line_w).max(1)) {
            let n = 3 * w.min(line_w);
            let at = 3 * ((y + h + row) * width + x);
            sheet[at..at + n].copy_from_slice(&line[3 * row * line_w..3 * row * line_w + n]);
        }
    }
    let side = |n: usize| {
        u32::try_from(n).map_err(|_| Error::invalid("expected a side below 2^32").in_file(path))
    };
    let (width, height) = (side(width)?, side(height)?);
    write::atomically(path, |out| {
        PngEncoder::new(out)
            .write_image(&sheet, width, height, ExtendedColorType::Rgb8)
            .map_err(|e| io::Error::other(e.to_string()))
    })
}

/// A line of text as RGB bytes, and its width in pixels.
fn line_of(text: &str, width: usize) -> Result<(Vec<u8>, usize), Error> {
    let size = (width as f64 / 16.0).clamp(6.0, 13.0);
    let mut svg = String::new();
    // writing to a string cannot fail
    let _infallible = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{LINE}\">\
         <rect width=\"{width}\" height=\"{LINE}\" fill=\"white\"/>\
         <text x=\"2\" y=\"15\" font-size=\"{size}\" font-family=\"sans-serif\">{text}</text></svg>"
    );
    let drawn = |e: &dyn std::fmt::Display| Error::invalid(format!("cannot draw text: {e}"));
    let png = plot::png(&svg, 1.0).map_err(|e| drawn(&e))?;
    let picture = image::load_from_memory(&png)
        .map_err(|e| drawn(&e))?
        .to_rgb8();
    let width = picture.width() as usize;
    Ok((picture.into_raw(), width))
}
