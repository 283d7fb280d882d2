//! What pictures are compared with, and how far it is itself from the truth.

use super::run::{Clock, Watch};
use super::{Method, Options};
use crate::build::{BuiltScene, Places, build_scene};
use crate::error::Error;
use crate::image::{Picture, read_exr};
use crate::overrides::Overrides;
use crate::scene::SceneFile;
use std::path::Path;
use tracer::Film;

/// Independent scrambles of a reference: their spread is its error.
const REPLICATES: u32 = 8;
/// Most samples a pixel of a reference: film sums stay exact far beyond.
const MAX_SPP: u32 = 1 << 20;

/// A picture of known error.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The picture.
    pub picture: Picture,
    /// Where it comes from, for people.
    pub origin: String,
    /// Estimate of its mean squared error over pixels and channels; 0 where the file does not say.
    pub mse: f64,
    /// Standard error of `mse`.
    pub mse_error: f64,
    /// Mean over pixels and channels of the squared true value, as well as it is known.
    pub mean_square: f64,
}

impl Reference {
    fn new(picture: Picture, origin: String) -> Result<Self, Error> {
        let flat = |plane: &[[f32; 3]]| -> Vec<f64> {
            plane.iter().flatten().map(|v| f64::from(*v)).collect()
        };
        let (values, variances) = (
            flat(&picture.pixels),
            flat(picture.variance.as_deref().unwrap_or_default()),
        );
        let n = values.len() as f64;
        if values.iter().chain(&variances).any(|v| !v.is_finite()) {
            return Err(Error::invalid(
                "expected a reference of finite values, found others",
            ));
        }
        let mse = variances.iter().sum::<f64>() / n;
        // a variance of seven degrees of freedom has a relative variance of 2/7; channels of a pixel err together
        let fourth = variances.iter().map(|v| v * v).sum::<f64>() / (n * n);
        let mse_error = (3.0 * fourth * 2.0 / f64::from(REPLICATES - 1)).sqrt();
        let mean_square = values.iter().map(|v| v * v).sum::<f64>() / n - mse;
        if mean_square <= 0.0 {
            return Err(Error::invalid(
                "expected a reference that differs from black, found none: relative errors would have no meaning",
            ));
        }
        Ok(Self {
            picture,
            origin,
            mse,
            mse_error,
            mean_square,
        })
    }

    /// A picture from a file, which must have the scene's size.
    pub(super) fn load(path: &Path, size: (u32, u32)) -> Result<Self, Error> {
        let picture = read_exr(path)?;
        let expected = (size.0 as usize, size.1 as usize);
        if (picture.width, picture.height) != expected {
            return Err(Error::invalid(format!(
                "expected a reference of {} x {} pixels, found {} x {}",
                expected.0, expected.1, picture.width, picture.height
            ))
            .in_file(path));
        }
        let known = if picture.variance.is_some() {
            ""
        } else {
            ", which does not state its error: 0 is assumed"
        };
        let origin = format!("{}{known}", path.display());
        Self::new(picture, origin).map_err(|e| e.in_file(path))
    }

    /// Renders one by `method` for `seconds`, in passes that double.
    pub(super) fn render(
        (scene, places): (&SceneFile, &Places),
        method: Method,
        options: &Options,
        clock: &Clock<'_>,
    ) -> Result<Self, Error> {
        let built = build(scene, method, options, places)?;
        let mut settings = built.settings.clone();
        settings.spp = options.reference_spp.unwrap_or(MAX_SPP);
        settings.seed = options.seed ^ 0x5ca1_ab1e;
        let mut film = Film::new(built.size.0, built.size.1, REPLICATES);
        let seconds = match options.reference_spp {
            Some(_) => f64::INFINITY,
            None => options.reference_seconds,
        };
        let watch = Watch::new(clock, seconds, true);
        tracer::render(&built.scene, &settings, &mut film, &watch)
            .map_err(|e| Error::invalid(e.to_string()))?;
        if film.spp() < 2 * REPLICATES {
            return Err(Error::invalid(
                "the reference was interrupted before it knew its error",
            ));
        }
        let origin = format!("{method}, {} samples a pixel", film.spp());
        Self::new(Picture::of_film(&film)?, origin)
    }

    /// Relative RMSE of the reference itself.
    #[must_use]
    pub fn rel_rmse(&self) -> f64 {
        (self.mse / self.mean_square).sqrt()
    }

    /// Mean over pixels and channels of the squared difference from `pixels`.
    pub(super) fn distance(&self, pixels: &[[f64; 3]]) -> f64 {
        let squares: f64 = (pixels.iter().zip(&self.picture.pixels))
            .flat_map(|(a, b)| (0..3).map(move |c| (a[c] - f64::from(b[c])).powi(2)))
            .sum();
        squares / (3 * pixels.len()).max(1) as f64
    }
}

/// The scene as `method` renders it.
pub(super) fn build(
    scene: &SceneFile,
    method: Method,
    options: &Options,
    places: &Places,
) -> Result<BuiltScene, Error> {
    let overrides = Overrides {
        sampler: Some(method.sampler),
        points: Some(method.points),
        ..options.overrides.clone()
    };
    let mut built = build_scene(scene.clone(), &overrides, places)
        .map_err(|e| e.in_field(&method.to_string()))?;
    built.settings.strategy = method.strategy;
    built.settings.threads = options.threads;
    Ok(built)
}
