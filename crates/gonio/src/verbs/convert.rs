//! `gonio convert IN OUT`.

use super::Context;
use crate::args::Convert;
use anyhow::Result;
use scene_io::convert::{Conversion, convert};
use scene_io::material::MaterialOptions;
use scene_io::scene::InterpolationName;
use serde_json::json;
use std::path::Path;

pub(crate) fn run(context: &Context, args: &Convert) -> Result<()> {
    let input = context.places.data.find(&args.input, Path::new(""))?;
    let options = MaterialOptions {
        interpolation: args.interpolation.unwrap_or(InterpolationName::Auto),
        ..MaterialOptions::default()
    };
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
    context.report(&value, || {
        println!("wrote {}", output.display());
        for line in &done.lost {
            println!("  lost: {line}");
        }
        println!(
            "  relative RMS difference when read back: {:.2e}",
            done.round_trip_error
        );
    })
}
