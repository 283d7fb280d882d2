//! `gonio measure MODEL -o OUT`: a virtual gonioreflectometer.

use super::Context;
use crate::args::Measure;
use anyhow::{Context as _, Result, bail};
use brdf_measure::{Bracketing, Instrument, MERL_DIMS, measure_astm, measure_merl};
use brdf_models::{DefaultValue, MODELS, parse_model};
use serde_json::json;
use spectrum::{Basis, RgbSpace};

pub(crate) fn run(context: &Context, args: &Measure) -> Result<()> {
    if args.model == "list" {
        list();
        return Ok(());
    }
    let output = args
        .output
        .as_ref()
        .context("expected an output: -o OUT.binary or -o OUT.astm")?;
    let model = parse_model(&args.model)?;
    let instrument = Instrument {
        noise: args.noise,
        bracketing: args.bracketed.then_some(Bracketing::MERL),
        blind_spot_deg: args.blind_spot,
    };
    let brdf = model.built.brdf.as_ref();
    let (grid, bytes) = match output.extension().and_then(|e| e.to_str()) {
        Some("binary") => {
            let file = measure_merl(brdf, MERL_DIMS, &instrument, args.seed)?;
            (format!("MERL {MERL_DIMS:?}"), file.into_bytes())
        }
        Some("astm") => {
            let basis = Basis::Rgb(RgbSpace::trinitron());
            let file = measure_astm(brdf, &basis, &model.to_string(), &instrument, args.seed)?;
            (
                format!("Cornell, {} rows", file.row_count()),
                file.to_bytes(),
            )
        }
        _ => bail!(
            "{}: expected an output ending in .binary (MERL grid) or .astm (Cornell grid)",
            output.display()
        ),
    };
    scene_io::write::bytes(output, &bytes)?;
    let report = json!({
        "written": [output],
        "model": model.info.name,
        "parameters": model.values.to_string(),
        "grid": grid,
    });
    context.report(&report, || {
        println!("measured {model}\nwrote {} ({grid})", output.display())
    })
}

/// The models and their parameters.
fn list() {
    for info in MODELS {
        println!("{}  {}  {}", info.name, info.title, info.citation);
        for p in info.parameters {
            let default = match p.default {
                DefaultValue::Value(v) => format!("default {v}"),
                DefaultValue::SameAs(other) => format!("default: {other}"),
                DefaultValue::Absent => "optional".into(),
            };
            let colour = if p.per_channel {
                ", one value or R/G/B"
            } else {
                ""
            };
            println!(
                "    {:<12} {} [{} to {}{}], {default}{colour}",
                p.name,
                p.title,
                p.range.0,
                p.range.1,
                unit(p.unit)
            );
        }
    }
}

fn unit(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    }
}
