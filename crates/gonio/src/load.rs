//! From what was typed to a loaded material.

use crate::args::Reading;
use crate::output::Usage;
use crate::verbs::Context;
use anyhow::Result;
use brdf::{Computed, Measured};
use brdf_models::parse_model;
use scene_io::material::{LoadedMeasured, load_measured};
use scene_io::scene::MaterialSpec;
use spectrum::Basis;
use std::path::Path;
use std::sync::Arc;

/// Loads a measured file, found in the current folder or a data folder.
pub(crate) fn measured(context: &Context, file: &Path, reading: Reading) -> Result<LoadedMeasured> {
    let path = context.places.data.find(file, Path::new(""))?;
    Ok(load_measured(&path, &reading.options())?)
}

/// What a verb looks at: a measured file, or a model by its description.
pub(crate) struct Subject {
    /// Short, for legends and titles.
    pub(crate) label: String,
    /// The format, or `model`.
    pub(crate) format: &'static str,
    pub(crate) measured: Arc<dyn Measured>,
}

/// Loads a measured file, or builds a model if the text describes one and no such file exists.
pub(crate) fn subject(context: &Context, text: &Path, reading: Reading) -> Result<Subject> {
    Ok(match MaterialSpec::from_argument(&text.to_string_lossy()) {
        MaterialSpec::Model(spec) => Subject {
            format: "model",
            measured: Arc::new(Computed::new(parse_model(&spec.model)?.built.brdf)),
            label: spec.model,
        },
        _ => {
            let loaded = measured(context, text, reading)?;
            Subject {
                label: label(text),
                format: loaded.format.name,
                measured: loaded.measured,
            }
        }
    })
}

/// A short name for legends: the file's name without folders and ending.
pub(crate) fn label(file: &Path) -> String {
    file.file_stem().map_or_else(
        || file.display().to_string(),
        |s| s.to_string_lossy().into_owned(),
    )
}

/// Writes a picture; the ending, checked when it was typed, decides between SVG and PNG.
pub(crate) fn write_picture(output: &Path, svg: &str) -> Result<()> {
    if output.extension().is_some_and(|e| e == "svg") {
        scene_io::write::bytes(output, svg.as_bytes())?;
    } else {
        scene_io::write::bytes(output, &plot::png(svg, 1.5)?)?;
    }
    Ok(())
}

/// Splits `FILE:WEIGHT` at the last colon.
pub(crate) fn weighted(part: &str) -> Result<(&Path, f64)> {
    let expected = |what: &str| {
        Usage(format!(
            "{part}: expected FILE:WEIGHT with a finite number after the last colon, found {what}"
        ))
    };
    let (file, weight) = part.rsplit_once(':').ok_or_else(|| expected("no colon"))?;
    match weight.parse::<f64>() {
        Ok(weight) if weight.is_finite() => Ok((Path::new(file), weight)),
        _ => Err(expected(&format!("{weight:?}")).into()),
    }
}

/// Factor from a file's channels to f_r in 1/sr: RGB files whose white is not at 1 (Cornell's) are brought to BRDF scale.
pub(crate) fn brdf_scale(basis: &Basis) -> f64 {
    match basis {
        Basis::Rgb(space) => space.white_level.recip(),
        _ => 1.0,
    }
}

/// Refuses an output that no format is written to, before any work is done.
pub(crate) fn check_material_output(output: &Path) -> Result<()> {
    scene_io::convert::output_format(output).map_err(|e| Usage(e.to_string()))?;
    Ok(scene_io::write::check(output)?)
}
