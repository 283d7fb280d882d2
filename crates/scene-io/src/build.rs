//! From a checked scene file to what the tracer renders.

mod lights;
mod materials;
mod shapes;

pub use materials::MaterialReport;
pub(crate) use materials::native_bands;

use crate::cache::Cache;
use crate::data_dirs::DataDirs;
use crate::error::Error;
use crate::image::{Picture, ToneMap};
use crate::overrides::Overrides;
use crate::scene::{ExposureSpec, FilterSpec, MaterialSpec, PointsName, SceneFile};
use crate::spectral::{self, AnyScene, Palette, RgbPalette};
use glam::DVec3;
use std::time::Instant;
use tracer::{Camera, Description, LightSelection, PixelFilter, PointSet, Scene, Settings};

/// Where the files of a scene are found and kept.
#[derive(Clone, Debug, Default)]
pub struct Places {
    /// Searched for materials, meshes and images.
    pub data: DataDirs,
    /// Where slow results are kept.
    pub cache: Cache,
}

/// A scene ready to be rendered.
#[derive(Debug)]
pub struct BuiltScene<S = Scene<3>> {
    /// Geometry, materials, lights.
    pub scene: S,
    /// Samples, depth, seed, points, filter.
    pub settings: Settings,
    /// Pixels across and down.
    pub size: (u32, u32),
    /// How PNGs are exposed.
    pub exposure: ExposureSpec,
    /// The scene with all overrides applied.
    pub file: SceneFile,
    /// One entry a material in use, the main material first.
    pub materials: Vec<MaterialReport>,
    /// Seconds it took to read meshes and pictures, and then to build the scene of all.
    pub seconds: [f64; 2],
    /// What the scene does not use and therefore cost nothing.
    pub left_out: Vec<String>,
    /// What happened on the way and may matter.
    pub notes: Vec<String>,
}

impl<S> BuiltScene<S> {
    /// How `picture` is brought to the screen.
    #[must_use]
    pub fn tone_map(&self, picture: &Picture) -> ToneMap {
        let scale = match self.exposure {
            ExposureSpec::Auto => ToneMap::auto(picture).scale,
            ExposureSpec::Scale(scale) => scale.0 as f32,
        };
        ToneMap {
            scale,
            gamut: self.file.film.gamut.mapping(),
        }
    }
}

/// Loads everything the scene uses, and nothing else; in linear sRGB, whatever spectrum it names.
///
/// # Errors
/// Missing or broken files, materials that cannot be made, shapes the tracer refuses; each names the scene file
/// and the field.
pub fn build_scene(
    file: SceneFile,
    overrides: &Overrides,
    places: &Places,
) -> Result<BuiltScene, Error> {
    assemble(file, overrides, |file, notes| {
        parts(file, places, &RgbPalette, notes)
    })
}

/// Like [`build_scene`], in the spectrum the scene names.
///
/// # Errors
/// As [`build_scene`].
pub fn build_any_scene(
    file: SceneFile,
    overrides: &Overrides,
    places: &Places,
) -> Result<BuiltScene<AnyScene>, Error> {
    assemble(file, overrides, |file, notes| {
        spectral::build(file, places, notes)
    })
}

fn assemble<S>(
    file: SceneFile,
    overrides: &Overrides,
    make: impl FnOnce(&SceneFile, &mut Vec<String>) -> Result<Parts<S>, Error>,
) -> Result<BuiltScene<S>, Error> {
    let path = file.path.clone();
    let file = overrides.apply(file)?;
    let mut notes = Vec::new();
    let made = make(&file, &mut notes).map_err(|e| {
        if path.as_os_str().is_empty() {
            e
        } else {
            e.in_file(&path)
        }
    })?;
    Ok(BuiltScene {
        settings: settings(&file),
        size: (file.film.width, file.film.height),
        exposure: file.film.exposure,
        left_out: left_out(&file, &made.index),
        materials: made.reports,
        seconds: made.seconds,
        scene: made.scene,
        file,
        notes,
    })
}

/// A scene, and what became of its materials.
pub(crate) struct Parts<S> {
    scene: S,
    reports: Vec<MaterialReport>,
    seconds: [f64; 2],
    index: materials::Index,
}

impl<S> Parts<S> {
    /// The same of another form.
    pub(crate) fn map<T>(self, f: impl FnOnce(S) -> T) -> Parts<T> {
        Parts {
            scene: f(self.scene),
            reports: self.reports,
            seconds: self.seconds,
            index: self.index,
        }
    }
}

/// Makes the scene of what `palette` makes of its parts.
pub(crate) fn parts<const N: usize, P: Palette<N>>(
    file: &SceneFile,
    places: &Places,
    palette: &P,
    notes: &mut Vec<String>,
) -> Result<Parts<Scene<N, P::Mode>>, Error> {
    let used = materials::load(file, places, palette)?;
    let start = Instant::now();
    let objects = shapes::objects(file, (&used.index, palette), places, notes)?;
    let (lights, environment) = lights::lights(file, places, palette)?;
    let description = Description {
        camera: Camera {
            eye: DVec3::from(file.camera.position),
            target: DVec3::from(file.camera.target),
            up: DVec3::from(file.camera.up),
            vertical_fov_deg: file.camera.fov_y_deg,
        },
        materials: used.materials,
        objects,
        lights,
        environment,
        selection: LightSelection::Auto,
    };
    notes.extend(uneven(file, &used.reports));
    let read = start.elapsed().as_secs_f64();
    let scene =
        Scene::with_mode(palette.mode(), description).map_err(|e| Error::invalid(e.to_string()))?;
    Ok(Parts {
        scene,
        reports: used.reports,
        seconds: [read, start.elapsed().as_secs_f64() - read],
        index: used.index,
    })
}

/// Warns of samplers that undo what even points are for.
fn uneven(file: &SceneFile, materials: &[MaterialReport]) -> Vec<String> {
    let even = file.render.points != PointsName::Independent;
    let broken = materials.iter().filter(|m| even && !m.sampler.stratified);
    broken
        .map(|m| {
            format!(
                "material \"{}\": sampler {} breaks the stratification of the points: the error falls no faster than with independent ones",
                m.name, m.sampler.name
            )
        })
        .collect()
}

fn settings(file: &SceneFile) -> Settings {
    Settings {
        spp: file.render.spp,
        seed: file.render.seed,
        max_depth: file.render.depth,
        roulette: file.render.roulette,
        points: match file.render.points {
            PointsName::Sobol => PointSet::Sobol,
            PointsName::Halton => PointSet::Halton,
            PointsName::Independent => PointSet::Independent,
        },
        filter: match file.film.filter {
            FilterSpec::Box => PixelFilter::Box,
            FilterSpec::Gaussian { sigma, radius } => PixelFilter::Gaussian {
                sigma: sigma.0 as f32,
                radius: radius.0 as f32,
            },
        },
        ..Settings::default()
    }
}

fn left_out(file: &SceneFile, used: &materials::Index) -> Vec<String> {
    let mut out = Vec::new();
    for (name, spec) in &file.materials {
        if !used.contains_key(name) {
            let what = match spec {
                MaterialSpec::File(m) => format!("{} was not read", m.path.display()),
                _ => "was not built".into(),
            };
            out.push(format!("material \"{name}\" is on no shape: {what}"));
        }
    }
    if file.lights.is_empty() {
        out.push("no point, directional or environment light: no code of theirs runs".into());
    }
    out
}
