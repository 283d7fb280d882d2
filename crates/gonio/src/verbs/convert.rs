//! `gonio convert IN OUT`.

use super::Context;
use crate::args::Convert;
use crate::load;
use anyhow::Result;
use scene_io::convert::{Conversion, convert};
use serde_json::json;
use std::fmt::Write;
use std::path::Path;

pub(crate) fn run(context: &Context, args: &Convert) -> Result<()> {
    load::check_material_output(&args.output)?;
    let input = context.places.data.find(&args.input, Path::new(""))?;
    let options = args.reading.options();
    report(
        context,
        &args.output,
        &convert(&input, &args.output, &options)?,
    )
}

/// What was written, and what of the input it cannot say.
pub(super) fn report(context: &Context, output: &Path, done: &Conversion) -> Result<()> {
    let value = json!({
        "written": [output],
        "lost": done.lost,
        "round_trip_error": done.round_trip_error,
        "changes": done.lost,
    });
    context.report(&value, |out| {
        writeln!(out, "wrote {}", output.display())?;
        for line in &done.lost {
            writeln!(out, "  lost: {line}")?;
        }
        let error = done.round_trip_error;
        writeln!(out, "  relative RMS difference when read back: {error:.2e}")
    })
}
