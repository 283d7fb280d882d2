//! `gonio mix A:0.3 B:0.7 -o C`.

use super::Context;
use crate::args::Mix;
use crate::load;
use anyhow::Result;
use scene_io::convert::mix_files;
use std::path::{Path, PathBuf};

pub(crate) fn run(context: &Context, args: &Mix) -> Result<()> {
    load::check_material_output(&args.output)?;
    let mut parts: Vec<(PathBuf, f64)> = Vec::new();
    for part in &args.parts {
        let (file, weight) = load::weighted(part)?;
        parts.push((context.places.data.find(file, Path::new(""))?, weight));
    }
    let parts: Vec<(&Path, f64)> = parts.iter().map(|(p, w)| (p.as_path(), *w)).collect();
    let done = mix_files(&parts, &args.output, &args.reading.options())?;
    super::convert::report(context, &args.output, &done)
}
