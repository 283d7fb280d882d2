//! `gonio measure MODEL -o OUT`: a virtual gonioreflectometer.

use super::Context;
use crate::args::Measure;
use crate::output::Usage;
use anyhow::Result;
use brdf_measure::{Bracketing, Instrument, MERL_DIMS, measure_astm, measure_merl};
use brdf_models::{DefaultValue, MODELS, ModelInfo, parse_model};
use serde_json::json;
use spectrum::{Basis, RgbSpace};
use std::fmt::{self, Write};

pub(crate) fn run(context: &Context, args: &Measure) -> Result<()> {
    if args.model == "list" {
        let models: Vec<_> = MODELS.iter().map(described).collect();
        return context.report(&json!({ "models": models }), list);
    }
    let output = (args.output.as_ref())
        .ok_or_else(|| Usage("expected an output: -o OUT.binary or -o OUT.astm".into()))?;
    let ending = output.extension().and_then(|e| e.to_str());
    if !matches!(ending, Some("binary" | "astm")) {
        return Err(Usage(format!(
            "{}: expected an output ending in .binary (MERL grid) or .astm (Cornell grid)",
            output.display()
        ))
        .into());
    }
    scene_io::write::check(output)?;
    let model = parse_model(&args.model)?;
    let instrument = Instrument {
        noise: args.noise,
        bracketing: args.bracketed.then_some(Bracketing::MERL),
        blind_spot_deg: args.blind_spot,
    };
    let brdf = model.built.brdf.as_ref();
    let (grid, bytes) = match ending {
        Some("binary") => {
            let file = measure_merl(brdf, MERL_DIMS, &instrument, args.seed)?;
            (format!("MERL {MERL_DIMS:?}"), file.into_bytes())
        }
        _ => {
            let basis = Basis::Rgb(RgbSpace::trinitron());
            let file = measure_astm(brdf, &basis, &model.to_string(), &instrument, args.seed)?;
            (
                format!("Cornell, {} rows", file.row_count()),
                file.to_bytes(),
            )
        }
    };
    scene_io::write::bytes(output, &bytes)?;
    let report = json!({
        "written": [output],
        "model": model.info.name,
        "parameters": model.values.to_string(),
        "grid": grid,
    });
    context.report(&report, |out| {
        writeln!(out, "measured {model}\nwrote {} ({grid})", output.display())
    })
}

/// A model for programs.
fn described(info: &ModelInfo) -> serde_json::Value {
    let parameters: Vec<_> = (info.parameters.iter())
        .map(|p| json!({ "name": p.name, "title": p.title, "unit": p.unit, "range": [p.range.0, p.range.1], "choices": p.choices }))
        .collect();
    json!({ "name": info.name, "title": info.title, "citation": info.citation, "parameters": parameters })
}

/// The models and their parameters.
fn list(out: &mut String) -> fmt::Result {
    for info in MODELS {
        writeln!(out, "{}  {}  {}", info.name, info.title, info.citation)?;
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
            let range = match p.choices {
                [] => format!("{} to {}{}", p.range.0, p.range.1, unit(p.unit)),
                choices => choices.join(", "),
            };
            writeln!(
                out,
                "    {:<12} {} [{range}], {default}{colour}",
                p.name, p.title
            )?;
        }
    }
    Ok(())
}

fn unit(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    }
}
