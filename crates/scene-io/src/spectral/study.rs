//! One scene in every mode: pictures, seconds, how far colours are from the finest answer.

use super::difference::{ColourDifference, Look, difference};
use super::light::LightSum;
use super::{AnyScene, scene_lights};
use crate::build::{BuiltScene, Places, build_any_scene, build_scene, native_bands};
use crate::error::Error;
use crate::image::{Picture, ToneMap};
use crate::overrides::Overrides;
use crate::scene::{Colour, LightSpec, MaterialSpec, SceneFile, SpectrumName};
use std::time::Instant;
use tracer::{Film, Progress};

/// Independent scrambles, from whose differences errors are estimated.
const REPLICATES: u32 = 8;
/// Confidence of the interval around the error.
const CONFIDENCE: f64 = 0.95;
/// Reflectance that tells the main material from the sky, which is 1.
const HALF: f64 = 0.5;
/// Samples a pixel that find out where the main material is.
const MASK_SPP: u32 = 16;

/// The scene in one mode.
#[derive(Clone, Debug)]
pub struct ModeResult {
    /// Which.
    pub name: SpectrumName,
    /// Seconds of rendering.
    pub seconds: f64,
    /// Seconds of loading and building before that.
    pub build_seconds: f64,
    /// Error of the picture as it states it itself.
    pub rel_rmse: f64,
    /// Interval of that.
    pub rel_rmse_ci: [f64; 2],
    /// Distance from the reference.
    pub difference: ColourDifference,
    /// In linear sRGB.
    pub picture: Picture,
}

/// What [`study`] found.
#[derive(Clone, Debug)]
pub struct Study {
    /// Which mode all are compared with.
    pub reference: SpectrumName,
    /// In the order asked for.
    pub modes: Vec<ModeResult>,
    /// How all pictures are shown.
    pub tone: ToneMap,
}

/// The mode whose answer is finest: the bands of a measurement, or one-nanometre wavelengths where nothing has bands.
///
/// # Errors
/// If a file cannot be identified.
pub fn finest(
    file: &SceneFile,
    overrides: &Overrides,
    places: &Places,
) -> Result<SpectrumName, Error> {
    let file = overrides.apply(file.clone())?;
    let measured = native_bands(&file, places)?.1;
    Ok(if measured {
        SpectrumName::Native
    } else {
        SpectrumName::Hero
    })
}

/// Renders the scene in every mode with the same samples, so that most of their noise is common, and compares the
/// colours of the main material (of all lit pixels, if there is none) with those of `reference`.
///
/// # Errors
/// As [`build_any_scene`]; if nothing of the main material is seen.
pub fn study(
    file: &SceneFile,
    overrides: &Overrides,
    places: &Places,
    (modes, reference): (&[SpectrumName], SpectrumName),
    progress: &dyn Progress<3>,
) -> Result<Study, Error> {
    let run = |name: SpectrumName| -> Result<(Run, BuiltScene<AnyScene>), Error> {
        let overrides = Overrides {
            spectrum: Some(name),
            ..overrides.clone()
        };
        let start = Instant::now();
        let built = build_any_scene(file.clone(), &overrides, places)?;
        let build_seconds = start.elapsed().as_secs_f64();
        let (width, height) = built.size;
        let mut film = built.scene.film([width, height], REPLICATES);
        let start = Instant::now();
        built.scene.render(&built.settings, &mut film, progress)?;
        let seconds = start.elapsed().as_secs_f64();
        let film = film.rgb().into_owned();
        let run = Run {
            film,
            seconds,
            build_seconds,
        };
        Ok((run, built))
    };
    let (truth, built) = run(reference)?;
    let tone = built.tone_map(&Picture::of_film(&truth.film)?);
    let pixels = mask(&built.file, places)?;
    let lights: LightSum = scene_lights(&built.file)?;
    let look = Look {
        exposure: f64::from(tone.scale),
        white: super::light::xyz(&lights.reference()),
    };
    drop(built);
    let mut results = Vec::new();
    for &name in modes {
        if progress.cancelled() {
            return Err(Error::invalid("interrupted before all modes were rendered"));
        }
        let own = match name == reference {
            true => None,
            false => Some(run(name)?.0),
        };
        let run = own.as_ref().unwrap_or(&truth);
        let estimate = run.film.estimate(CONFIDENCE);
        results.push(ModeResult {
            name,
            seconds: run.seconds,
            build_seconds: run.build_seconds,
            rel_rmse: estimate.rel_rmse,
            rel_rmse_ci: estimate.rel_rmse_ci,
            difference: difference(&run.film, &truth.film, &look, &pixels)?,
            picture: Picture::of_film(&run.film)?,
        });
    }
    Ok(Study {
        reference,
        modes: results,
        tone,
    })
}

struct Run {
    film: Film<3>,
    seconds: f64,
    build_seconds: f64,
}

/// Pixels in which the main material is seen: those it makes bright when all else is black, under an even sky.
fn mask(file: &SceneFile, places: &Places) -> Result<Vec<bool>, Error> {
    let mut file = file.clone();
    let main = file.main_material.clone();
    let grey = |v: f64| MaterialSpec::Lambert {
        reflectance: Colour([v; 3]),
        spectrum: None,
    };
    for (name, spec) in &mut file.materials {
        let seen = main.as_ref().is_none_or(|m| m == name);
        *spec = grey(if seen { HALF } else { 0.0 });
    }
    for shape in &mut file.shapes {
        (shape.emission, shape.emission_spectrum) = (None, None);
    }
    file.lights = vec![LightSpec::Constant {
        radiance: Colour([1.0; 3]),
        spectrum: None,
    }];
    let overrides = Overrides {
        spp: Some(MASK_SPP),
        depth: Some(1),
        ..Overrides::default()
    };
    let built = build_scene(file, &overrides, places)?;
    let mut film = Film::<3>::new(built.size.0, built.size.1, 1);
    tracer::render(&built.scene, &built.settings, &mut film, &())
        .map_err(|e| Error::invalid(e.to_string()))?;
    // the sky itself is 1 in every sample, what is black is 0
    Ok(film
        .mean()
        .iter()
        .map(|p| p[0] > 0.0 && p[0] <= HALF + 1e-4)
        .collect())
}
