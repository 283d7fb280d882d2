//! What the command line changes about a scene.

use crate::error::Error;
use crate::scene::{
    FileMaterial, InterpolationName, MaterialSpec, ModelMaterial, PointsName, SamplerName,
    SceneFile, SpectrumName,
};
use std::path::PathBuf;

/// Changes to a scene; `None` leaves what the scene says.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Takes the place of the main material.
    pub material: Option<MaterialSpec>,
    /// Of the main material.
    pub interpolation: Option<InterpolationName>,
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
        if self.material.is_some() || self.interpolation.is_some() {
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
