//! PNG out: the tone-mapped picture beside the EXR.

use super::picture::Picture;
use super::tone::ToneMap;
use crate::error::Error;
use crate::write;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use rayon::prelude::*;
use spectrum::GamutReport;
use std::io;
use std::path::Path;

/// Writes `picture` atomically as 8-bit sRGB; says what of it such a picture cannot show.
///
/// # Errors
/// If the counts of the picture contradict each other, or the file cannot be written.
pub fn write_png(path: &Path, picture: &Picture, tone: ToneMap) -> Result<GamutReport, Error> {
    picture.check().map_err(|e| e.in_file(path))?;
    let side = |n: usize| {
        u32::try_from(n).map_err(|_| Error::invalid("expected a side below 2^32").in_file(path))
    };
    let (width, height) = (side(picture.width)?, side(picture.height)?);
    let shown = picture.pixels.par_iter().map(|p| tone.show(*p));
    let bytes = shown.collect::<Vec<_>>().into_flattened();
    write::atomically(path, |w| {
        PngEncoder::new(w)
            .write_image(&bytes, width, height, ExtendedColorType::Rgb8)
            .map_err(|e| match e {
                image::ImageError::IoError(e) => e,
                other => io::Error::other(other.to_string()),
            })
    })?;
    Ok(tone.report(picture))
}
