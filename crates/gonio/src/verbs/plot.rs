//! `gonio plot FILE...`: polar lobes, slices, albedo.

use super::Context;
use crate::args::{Plot, PlotKind};
use crate::{curves, load};
use anyhow::{Result, bail};
use brdf::Measured;
use plot::{Axis, Chart, Curve, HeatMap, PolarPlot, Radius, Scale, Stroke};
use serde_json::json;
use std::sync::Arc;

/// Powers of ten shown by a logarithmic polar plot.
const DECADES: f64 = 4.0;

type Named = (String, Arc<dyn Measured>);

pub(crate) fn run(context: &Context, args: &Plot) -> Result<()> {
    let mut materials: Vec<Named> = Vec::new();
    for file in &args.files {
        let loaded = load::measured(context, file, args.interpolation)?;
        materials.push((load::label(file), loaded.measured));
    }
    let svg = match args.kind {
        PlotKind::Polar => polar(&materials, args).svg(900)?,
        PlotKind::Albedo => albedo(&materials, args.log).svg((900, 560))?,
        PlotKind::Slice => slice(&materials, args.log)?.svg((760, 640))?,
    };
    load::write_picture(&args.output, &svg)?;
    context.report(&json!({ "written": [args.output] }), || {
        println!("wrote {}", args.output.display())
    })
}

fn polar(materials: &[Named], args: &Plot) -> PolarPlot {
    let mut drawn = Vec::new();
    let mut incident = Vec::new();
    for (k, theta_deg) in args.theta_i.iter().enumerate() {
        let theta = theta_deg.to_radians();
        incident.push((
            -theta,
            if args.theta_i.len() == 1 {
                [0, 0, 0]
            } else {
                plot::palette(k)
            },
        ));
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
                curves::lobes(material.as_ref(), "", theta)
            };
            for curve in &mut lobes {
                distinguish(curve, several.then_some((k, *theta_deg)));
            }
            drawn.extend(lobes);
        }
    }
    let names: Vec<&str> = materials.iter().map(|m| m.0.as_str()).collect();
    let angles: Vec<String> = args.theta_i.iter().map(f64::to_string).collect();
    PolarPlot {
        title: format!(
            "{}, light at {} degrees",
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
        curve.stroke = if k % 2 == 1 {
            Stroke::Dashed
        } else {
            Stroke::Solid
        };
    }
}

fn albedo(materials: &[Named], log: bool) -> Chart {
    let single = materials.len() == 1;
    let mut drawn = Vec::new();
    for (n, (name, material)) in materials.iter().enumerate() {
        let mut of_material = curves::albedo(material.as_ref(), if single { "" } else { name });
        if !single {
            of_material
                .iter_mut()
                .for_each(|c| c.color = plot::palette(n));
        }
        drawn.extend(of_material);
    }
    Chart {
        title: "Directional albedo".into(),
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

fn slice(materials: &[Named], log: bool) -> Result<HeatMap> {
    let [(name, material)] = materials else {
        bail!("a slice shows one file, found {}", materials.len());
    };
    const SIDE: usize = 180;
    Ok(HeatMap {
        title: format!("{name}: luminance of f_r at phi_d = 90 degrees (1/sr)"),
        x: ("theta_h (degrees)".into(), 0.0, 90.0),
        y: ("theta_d (degrees)".into(), 0.0, 90.0),
        columns: SIDE,
        values: curves::slice(material.as_ref(), SIDE),
        scale: if log { Scale::Log } else { Scale::Linear },
    })
}
