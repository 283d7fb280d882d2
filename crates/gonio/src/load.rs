//! From what was typed to a loaded material.

use crate::verbs::Context;
use anyhow::{Context as _, Result};
use scene_io::material::{LoadedMeasured, MaterialOptions, load_measured};
use scene_io::scene::InterpolationName;
use std::path::Path;

/// Loads a measured file, found in the current folder or a data folder.
pub(crate) fn measured(
    context: &Context,
    file: &Path,
    interpolation: Option<InterpolationName>,
) -> Result<LoadedMeasured> {
    let path = context.places.data.find(file, Path::new(""))?;
    let options = MaterialOptions {
        interpolation: interpolation.unwrap_or(InterpolationName::Auto),
        ..MaterialOptions::default()
    };
    Ok(load_measured(&path, &options)?)
}

/// A short name for legends: the file's name without folders and ending.
pub(crate) fn label(file: &Path) -> String {
    file.file_stem().map_or_else(
        || file.display().to_string(),
        |s| s.to_string_lossy().into_owned(),
    )
}

/// Writes a picture; the ending decides between SVG and PNG.
pub(crate) fn write_picture(output: &Path, svg: &str) -> Result<()> {
    match output.extension().and_then(|e| e.to_str()) {
        Some("svg") => scene_io::write::bytes(output, svg.as_bytes())?,
        Some("png") => scene_io::write::bytes(output, &plot::png(svg, 1.5)?)?,
        _ => anyhow::bail!(
            "{}: expected an output ending in .svg or .png",
            output.display()
        ),
    }
    Ok(())
}

/// Splits `FILE:WEIGHT` at the last colon.
pub(crate) fn weighted(part: &str) -> Result<(&Path, f64)> {
    let (file, weight) = part
        .rsplit_once(':')
        .with_context(|| format!("{part}: expected FILE:WEIGHT, found no colon"))?;
    let weight: f64 = weight
        .parse()
        .ok()
        .filter(|w: &f64| w.is_finite())
        .with_context(|| {
            format!("{part}: expected a number after the last colon, found {weight:?}")
        })?;
    Ok((Path::new(file), weight))
}
