//! `gonio plot FILE...`: polar lobes, slices, albedo.

use super::Context;
use crate::args::{Plot, PlotKind};
use crate::output::Usage;
use crate::{curves, load};
use anyhow::Result;
use brdf::Measured;
use plot::{Axis, Chart, Curve, HeatMap, PolarPlot, Radius, Scale, Stroke};
use serde_json::json;
use std::fmt::Write;
use std::sync::Arc;

/// Powers of ten shown by a logarithmic polar plot.
const DECADES: f64 = 4.0;

type Named = (String, Arc<dyn Measured>);

pub(crate) fn run(context: &Context, args: &Plot) -> Result<()> {
    scene_io::write::check(&args.output)?;
    if args.kind == PlotKind::Slice && args.files.len() > 1 {
        let found = args.files.len();
        return Err(Usage(format!("expected one file for a slice, found {found}")).into());
    }
    let mut materials: Vec<Named> = Vec::new();
    for file in &args.files {
        let subject = load::subject(context, file, args.reading)?;
        materials.push((subject.label, subject.measured));
    }
    let svg = match args.kind {
        PlotKind::Polar => polar(&materials, args).svg(900)?,
        PlotKind::Albedo => albedo(&materials, args.log).svg((900, 560))?,
        PlotKind::Slice => slice(&materials[0], args.log).svg((760, 640))?,
    };
    load::write_picture(&args.output, &svg)?;
    context.report(&json!({ "written": [args.output] }), |out| {
        writeln!(out, "wrote {}", args.output.display())
    })
}

fn polar(materials: &[Named], args: &Plot) -> PolarPlot {
    let mut drawn = Vec::new();
    let mut incident = Vec::new();
    for (k, theta_deg) in args.theta_i.iter().enumerate() {
        let theta = theta_deg.to_radians();
        incident.push((-theta, [0, 0, 0]));
        for (n, (name, material)) in materials.iter().enumerate() {
            let several = args.theta_i.len() > 1;
            let mut lobes = if materials.len() > 1 {
                vec![curves::luminance_lobe(
                    material.as_ref(),
                    name,
                    theta,
                    plot::palette(n),
                )]
            } else {
                curves::lobes(material.as_ref(), theta)
            };
            for curve in &mut lobes {
                distinguish(curve, several.then_some((k, *theta_deg)));
            }
            drawn.extend(lobes);
        }
    }
    let names: Vec<&str> = materials.iter().map(|m| m.0.as_str()).collect();
    let of = if materials.len() > 1 {
        " (luminance)"
    } else {
        ""
    };
    let angles: Vec<String> = args.theta_i.iter().map(f64::to_string).collect();
    PolarPlot {
        title: format!(
            "{}{of}, light at {} degrees",
            names.join(", "),
            angles.join(", ")
        ),
        radius_label: "f_r (1/sr)".into(),
        radius: if args.log {
            Radius::Log { decades: DECADES }
        } else {
            Radius::Linear
        },
        curves: drawn,
        incident,
    }
}

/// Tells the curves of several incident angles apart by label and dashes.
fn distinguish(curve: &mut Curve, angle: Option<(usize, f64)>) {
    if let Some((k, theta_deg)) = angle {
        curve.label = format!("{} {theta_deg}°", curve.label.trim());
        curve.stroke = [Stroke::Solid, Stroke::Dashed, Stroke::Dots][k % 3];
    }
}

/// One curve a channel for one material, the luminance of each for several.
fn albedo(materials: &[Named], log: bool) -> Chart {
    let drawn = match materials {
        [(_, material)] => curves::albedo(material.as_ref()),
        several => several
            .iter()
            .enumerate()
            .map(|(n, (name, m))| curves::luminance_albedo(m.as_ref(), name, plot::palette(n)))
            .collect(),
    };
    let of = if materials.len() > 1 {
        " (luminance)"
    } else {
        ""
    };
    let names: Vec<&str> = materials.iter().map(|m| m.0.as_str()).collect();
    Chart {
        title: format!("{}: directional albedo{of}", names.join(", ")),
        x: Axis {
            range: Some((0.0, 90.0)),
            ..Axis::linear("theta_o (degrees)")
        },
        y: if log {
            Axis::log("albedo")
        } else {
            Axis::linear("albedo")
        },
        curves: drawn,
    }
}

fn slice((name, material): &Named, log: bool) -> HeatMap {
    const SIDE: usize = 180;
    HeatMap {
        title: format!("{name}: luminance of f_r at phi_d = 90 degrees (1/sr)"),
        x: ("theta_h (degrees)".into(), 0.0, 90.0),
        y: ("theta_d (degrees)".into(), 0.0, 90.0),
        columns: SIDE,
        values: curves::slice(material.as_ref(), SIDE),
        scale: if log { Scale::Log } else { Scale::Linear },
    }
}
