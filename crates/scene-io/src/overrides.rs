//! What the command line changes about a scene.

use crate::error::Error;
use crate::scene::{
    ColourChoice, FileMaterial, GamutName, InterpolationName, MaterialSpec, ModelMaterial,
    PointsName, SamplerName, SceneFile, SpectrumName,
};
use std::path::PathBuf;

/// Changes to a scene; `None` leaves what the scene says.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Takes the place of the main material.
    pub material: Option<MaterialSpec>,
    /// Of the main material.
    pub interpolation: Option<InterpolationName>,
    /// What the numbers of the main material's file mean; what is not said here is as the scene says.
    pub colour: ColourChoice,
    /// Of every material.
    pub sampler: Option<SamplerName>,
    /// Samples a pixel, at least 1.
    pub spp: Option<u32>,
    /// Scattering vertices.
    pub depth: Option<u32>,
    /// What the channels are.
    pub spectrum: Option<SpectrumName>,
    /// Seed.
    pub seed: Option<u64>,
    /// Point set.
    pub points: Option<PointsName>,
    /// How PNGs show colours out of gamut.
    pub gamut: Option<GamutName>,
    /// The range that fixed bins divide, nm.
    pub range_nm: Option<[f64; 2]>,
    /// Width and height of the film in pixels, at least 1.
    pub size: Option<(u32, u32)>,
}

impl MaterialSpec {
    /// What `--material TEXT` means: a model if TEXT begins with the name of one (`ggx:alpha=0.1`) and no such
    /// file exists, else a file, relative to the current folder.
    #[must_use]
    pub fn from_argument(text: &str) -> Self {
        let name = text.split(':').next().unwrap_or_default();
        let model = brdf_models::MODELS.iter().any(|m| m.name == name);
        if model && !PathBuf::from(text).exists() {
            return Self::Model(ModelMaterial {
                model: text.to_owned(),
                interpolation: None,
                scale: None,
                sampler: None,
            });
        }
        Self::File(FileMaterial {
            path: PathBuf::from(text),
            interpolation: None,
            negatives: None,
            gap: None,
            beyond: None,
            scale: None,
            colour: ColourChoice::default(),
            sampler: None,
            home: PathBuf::new(),
        })
    }
}

impl Overrides {
    /// The scene with the changes made.
    ///
    /// # Errors
    /// If a main material is to be changed and the scene names none.
    pub fn apply(&self, mut scene: SceneFile) -> Result<SceneFile, Error> {
        let coloured = self.colour != ColourChoice::default();
        if self.material.is_some() || self.interpolation.is_some() || coloured {
            self.replace_main(&mut scene)?;
        }
        if let Some(sampler) = self.sampler {
            scene.render.sampler = sampler;
            for spec in scene.materials.values_mut() {
                match spec {
                    MaterialSpec::File(m) => m.sampler = None,
                    MaterialSpec::Model(m) | MaterialSpec::Measured(m) => m.sampler = None,
                    MaterialSpec::Mix(m) => m.sampler = None,
                    MaterialSpec::Lambert { .. } => {}
                }
            }
        }
        let render = &mut scene.render;
        render.spp = self.spp.unwrap_or(render.spp).max(1);
        render.depth = self.depth.unwrap_or(render.depth);
        render.spectrum = self.spectrum.unwrap_or(render.spectrum);
        if let Some(range) = self.range_nm {
            render.range_nm = range;
            render.edges_nm = None;
        }
        scene.film.gamut = self.gamut.unwrap_or(scene.film.gamut);
        render.seed = self.seed.unwrap_or(render.seed);
        render.points = self.points.unwrap_or(render.points);
        if let Some((width, height)) = self.size {
            (scene.film.width, scene.film.height) = (width.max(1), height.max(1));
        }
        scene.check()?;
        Ok(scene)
    }

    fn replace_main(&self, scene: &mut SceneFile) -> Result<(), Error> {
        let main = scene.main_material.as_ref();
        let slot = main.and_then(|name| scene.materials.get_mut(name));
        let slot = slot.ok_or_else(|| {
            Error::invalid("expected the name of the material to replace, found nothing")
                .in_field("main_material")
                .in_file(&scene.path)
        })?;
        if let Some(material) = &self.material {
            *slot = material.clone();
        }
        let colour = &self.colour;
        match slot {
            MaterialSpec::File(m) => {
                m.colour.primaries = colour.primaries.or(m.colour.primaries);
                m.colour.white = colour.white.or(m.colour.white);
                m.colour.scale = colour.scale.or(m.colour.scale);
            }
            _ if *colour != ColourChoice::default() => {
                let message = "expected a file as main material for primaries, white or scale of a file, found none";
                return Err(Error::invalid(message)
                    .in_field("main_material")
                    .in_file(&scene.path));
            }
            _ => {}
        }
        match (slot, self.interpolation) {
            (MaterialSpec::File(m), Some(_)) => m.interpolation = self.interpolation,
            (MaterialSpec::Measured(m), Some(_)) => m.interpolation = self.interpolation,
            (_, Some(name)) => {
                return Err(Error::invalid(format!(
                    "expected a measured main material for interpolation \"{name}\", found a model"
                ))
                .in_field("main_material")
                .in_file(&scene.path));
            }
            (_, None) => {}
        }
        Ok(())
    }
}
