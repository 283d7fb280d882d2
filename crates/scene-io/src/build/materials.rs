//! The materials of a scene: those on a shape, each loaded once.

use super::Places;
use crate::error::Error;
use crate::material::{SamplerReport, Surface};
use crate::scene::{
    FileMaterial, MaterialSpec, MixMaterial, ModelMaterial, SamplerName, SceneFile,
};
use brdf::Material;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Where each used material stands in the tracer's list.
pub(super) type Index = BTreeMap<String, usize>;

/// One material in use.
#[derive(Clone, Debug)]
pub struct MaterialReport {
    /// Its name in the scene.
    pub name: String,
    /// The file it was read from, if any.
    pub file: Option<PathBuf>,
    /// Its sampler.
    pub sampler: SamplerReport,
}

pub(super) struct Used {
    pub(super) materials: Vec<Box<dyn Material<3>>>,
    pub(super) reports: Vec<MaterialReport>,
    pub(super) index: Index,
}

pub(super) fn load(file: &SceneFile, places: &Places) -> Result<Used, Error> {
    let on_shapes = |name: &String| file.shapes.iter().any(|s| s.material == *name);
    let main = file.main_material.iter();
    let others = (file.materials.keys()).filter(|n| Some(*n) != file.main_material.as_ref());
    let mut used = Used {
        materials: Vec::new(),
        reports: Vec::new(),
        index: Index::new(),
    };
    for name in main.chain(others).filter(|n| on_shapes(n)) {
        let (material, report) =
            one(file, name, places).map_err(|e| e.in_field(&format!("materials.{name}")))?;
        used.index.insert(name.clone(), used.materials.len());
        used.materials.push(material);
        used.reports.push(report);
    }
    Ok(used)
}

fn one(
    file: &SceneFile,
    name: &str,
    places: &Places,
) -> Result<(Box<dyn Material<3>>, MaterialReport), Error> {
    let spec = file.materials.get(name).ok_or_else(|| {
        Error::invalid(format!(
            "expected a material, found nothing named \"{name}\""
        ))
    })?;
    let default = file.render.sampler;
    let (surface, path) = surface(file, spec, places)?;
    let sampler = match spec {
        MaterialSpec::File(FileMaterial { sampler, .. })
        | MaterialSpec::Model(ModelMaterial { sampler, .. })
        | MaterialSpec::Measured(ModelMaterial { sampler, .. })
        | MaterialSpec::Mix(MixMaterial { sampler, .. }) => sampler.unwrap_or(default),
        // Its own sampling is exact: no choice made for others could better it.
        MaterialSpec::Lambert { .. } => SamplerName::Native,
    };
    let (material, sampler) = surface.material(sampler, &places.cache)?;
    let report = MaterialReport {
        name: name.to_owned(),
        file: path,
        sampler,
    };
    Ok((material, report))
}

fn surface(
    file: &SceneFile,
    spec: &MaterialSpec,
    places: &Places,
) -> Result<(Surface, Option<PathBuf>), Error> {
    match spec {
        MaterialSpec::Mix(mix) => {
            let mut parts = Vec::new();
            for (name, weight) in &mix.parts {
                // Mixtures of mixtures were refused when the scene was checked.
                let spec = file.materials.get(name).ok_or_else(|| {
                    Error::invalid(format!(
                        "expected a material, found nothing named \"{name}\""
                    ))
                })?;
                parts.push((surface(file, spec, places)?.0, weight.0));
            }
            Ok((Surface::mix(&parts)?, None))
        }
        alone => Surface::of_spec(alone, places),
    }
}
