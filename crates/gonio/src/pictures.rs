//! The pictures of a film: EXR, with bins and bands if it has them, and PNG.

use anyhow::{Context as _, Result};
use scene_io::image::{Picture, ToneMap, write_exr, write_png, write_spectral_exr};
use scene_io::spectral::AnyFilm;
use serde::Serialize;
use spectrum::{GamutMapping, GamutReport};
use std::fmt::{self, Write};
use std::path::{Path, PathBuf};

/// Writes `output` and a PNG beside it; the PNG's name, and what it cannot show.
pub(crate) fn write_pictures(
    output: &Path,
    film: &AnyFilm,
    picture: &Picture,
    tone: ToneMap,
) -> Result<(PathBuf, GamutReport)> {
    let png = output.with_extension("png");
    // side by side: both compress
    let (exr, report) = std::thread::scope(|scope| {
        let other = scope.spawn(|| write_png(&png, picture, tone));
        let exr = match film.spectral() {
            Some(spectral) => write_spectral_exr(output, picture, &spectral),
            None => write_exr(output, picture),
        };
        (exr, other.join())
    });
    exr?;
    let report = match report {
        Ok(report) => report.context("the EXR was written")?,
        Err(panic) => std::panic::resume_unwind(panic),
    };
    Ok((png, report))
}

/// Which pixels a PNG shows in another colour than they have, and how.
#[derive(Serialize)]
pub(crate) struct Gamut {
    /// Of negative components: `clip` or `desaturate`.
    mapping: &'static str,
    /// Pixels with a negative component.
    outside: u64,
    /// All pixels.
    pixels: u64,
    /// The most negative component over the largest of its pixel.
    worst: f64,
}

impl Gamut {
    pub(crate) fn new(tone: ToneMap, report: GamutReport) -> Self {
        Self {
            mapping: match tone.gamut {
                GamutMapping::Desaturate => "desaturate",
                GamutMapping::Clip => "clip",
                _ => "none",
            },
            outside: report.outside,
            pixels: report.of,
            worst: report.worst,
        }
    }

    /// A line, if there is something to say.
    pub(crate) fn print(&self, out: &mut String) -> fmt::Result {
        if self.outside == 0 {
            return Ok(());
        }
        writeln!(
            out,
            "out of gamut: {} of {} pixels, at worst {:.3} of the largest component; the PNG shows them by \"{}\", the EXR as they are",
            self.outside, self.pixels, self.worst, self.mapping
        )
    }
}
