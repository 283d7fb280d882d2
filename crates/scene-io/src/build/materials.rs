//! The materials of a scene: those on a shape, each loaded once.

use super::Places;
use crate::error::Error;
use crate::material::{SamplerReport, identify};
use crate::scene::{
    FileMaterial, MaterialSpec, MixMaterial, ModelMaterial, SamplerName, SceneFile,
};
use crate::spectral::{FromScene, Palette};
use brdf::Material;
use spectrum::Basis;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;
use tracer::Mode;

/// Where each used material stands in the tracer's list.
pub(super) type Index = BTreeMap<String, usize>;

/// One material in use.
#[derive(Clone, Debug)]
pub struct MaterialReport {
    /// Its name in the scene.
    pub name: String,
    /// The file it was read from, if any.
    pub file: Option<PathBuf>,
    /// Seconds it took to read it and make its table, and then its sampler.
    pub seconds: [f64; 2],
    /// Bytes of its table; its sampler's are its own.
    pub table_bytes: usize,
    /// Its sampler.
    pub sampler: SamplerReport,
}

pub(super) struct Used<const N: usize, S: Mode<N>> {
    pub(super) materials: Vec<Box<dyn Material<N, S::Tag>>>,
    pub(super) reports: Vec<MaterialReport>,
    pub(super) index: Index,
}

pub(super) fn load<const N: usize, P: Palette<N>>(
    file: &SceneFile,
    places: &Places,
    palette: &P,
) -> Result<Used<N, P::Mode>, Error> {
    let on_shapes = |name: &String| file.shapes.iter().any(|s| s.material == *name);
    let main = file.main_material.iter();
    let others = (file.materials.keys()).filter(|n| Some(*n) != file.main_material.as_ref());
    let mut used = Used {
        materials: Vec::new(),
        reports: Vec::new(),
        index: Index::new(),
    };
    for name in main.chain(others).filter(|n| on_shapes(n)) {
        let (material, report) = one(file, name, places, palette)
            .map_err(|e| e.in_field(&format!("materials.{name}")))?;
        used.index.insert(name.clone(), used.materials.len());
        used.materials.push(material);
        used.reports.push(report);
    }
    Ok(used)
}

type One<const N: usize, S> = (Box<dyn Material<N, <S as Mode<N>>::Tag>>, MaterialReport);

fn one<const N: usize, P: Palette<N>>(
    file: &SceneFile,
    name: &str,
    places: &Places,
    palette: &P,
) -> Result<One<N, P::Mode>, Error> {
    let spec = file.materials.get(name).ok_or_else(|| {
        Error::invalid(format!(
            "expected a material, found nothing named \"{name}\""
        ))
    })?;
    let default = file.render.sampler;
    let start = Instant::now();
    let (surface, path) = surface::<P::Surface>(file, spec, places)?;
    let read = start.elapsed().as_secs_f64();
    let sampler = match spec {
        MaterialSpec::File(FileMaterial { sampler, .. })
        | MaterialSpec::Model(ModelMaterial { sampler, .. })
        | MaterialSpec::Measured(ModelMaterial { sampler, .. })
        | MaterialSpec::Mix(MixMaterial { sampler, .. }) => sampler.unwrap_or(default),
        // Its own sampling is exact: no choice made for others could better it.
        MaterialSpec::Lambert { .. } => SamplerName::Native,
    };
    let (material, sampler) = palette.material(surface, sampler, &places.cache)?;
    let report = MaterialReport {
        name: name.to_owned(),
        file: path,
        seconds: [read, start.elapsed().as_secs_f64() - read],
        table_bytes: material.table_bytes(),
        sampler,
    };
    Ok((material, report))
}

fn surface<F: FromScene>(
    file: &SceneFile,
    spec: &MaterialSpec,
    places: &Places,
) -> Result<(F, Option<PathBuf>), Error> {
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
                parts.push((surface::<F>(file, spec, places)?.0, weight.0));
            }
            Ok((F::mix(parts)?, None))
        }
        alone => F::of_spec(alone, places),
    }
}

/// The bands that `native` means for a scene: those of the main material's file, or of the first other file that has
/// 31 or 65, and true; 65 from 400 to 720 nm and false if none has.
pub(crate) fn native_bands(file: &SceneFile, places: &Places) -> Result<(Vec<f64>, bool), Error> {
    let main = file.main_material.iter();
    for name in main.chain(file.materials.keys()) {
        let used = file.shapes.iter().any(|s| s.material == *name);
        if let (true, Some(MaterialSpec::File(m))) = (used, file.materials.get(name)) {
            let in_material = |e: Error| e.in_field(&format!("materials.{name}"));
            let path = places.data.find(&m.path, &m.home).map_err(in_material)?;
            let identity = identify(&path, &m.colour).map_err(in_material)?;
            if let Basis::Bands(nm) = identity.basis
                && matches!(nm.len(), 31 | 65)
            {
                return Ok((nm, true));
            }
        }
    }
    let standard = (0..65).map(|k| 400.0 + 5.0 * f64::from(k));
    Ok((standard.collect(), false))
}
