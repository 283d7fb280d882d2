//! A picture in memory, as it is written to and read from EXR.

use crate::error::Error;
use tracer::Film;

/// Scene-linear RGB, row by row from the top left, and what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Radiance; linear sRGB primaries. May be negative (colour out of gamut).
    pub pixels: Vec<[f32; 3]>,
    /// Variance of the mean of every pixel and channel, if it was estimated.
    pub variance: Option<Vec<[f32; 3]>>,
    /// How the picture came about.
    pub metadata: Metadata,
}

/// How a picture came about; every entry may be missing in a file of other origin.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// The scene's path or name.
    pub scene: Option<String>,
    /// Seed.
    pub seed: Option<u64>,
    /// Samples a pixel.
    pub spp: Option<u64>,
    /// Wall-clock seconds of rendering.
    pub seconds: Option<f64>,
    /// Version of the program that rendered it.
    pub version: Option<String>,
    /// Sampler of the main material.
    pub sampler: Option<String>,
}

impl Picture {
    /// A picture without variance and metadata.
    ///
    /// # Errors
    /// If the number of pixels is not `width * height`, or zero.
    pub fn new(width: usize, height: usize, pixels: Vec<[f32; 3]>) -> Result<Self, Error> {
        let picture = Self {
            width,
            height,
            pixels,
            variance: None,
            metadata: Metadata::default(),
        };
        picture.check()?;
        Ok(picture)
    }

    /// The picture on a film, with the variance of its mean if the film has at least two replicates.
    ///
    /// # Errors
    /// If the film is larger than any picture may be.
    pub fn of_film(film: &Film<3>) -> Result<Self, Error> {
        let moments = film.moments_as(|value| value as f32);
        let picture = Self {
            width: film.width() as usize,
            height: film.height() as usize,
            pixels: moments.mean,
            variance: (film.replicates() > 1).then_some(moments.variance),
            metadata: Metadata {
                spp: Some(u64::from(film.spp())),
                ..Metadata::default()
            },
        };
        picture.check()?;
        Ok(picture)
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        let expected = self.width.checked_mul(self.height);
        let counts = [Some(&self.pixels), self.variance.as_ref()];
        for found in counts.into_iter().flatten().map(Vec::len) {
            if expected != Some(found) || found == 0 || found > super::MAX_PIXELS {
                return Err(Error::invalid(format!(
                    "expected {} x {} pixels (at most {}), found {found}",
                    self.width,
                    self.height,
                    super::MAX_PIXELS
                )));
            }
        }
        Ok(())
    }
}
