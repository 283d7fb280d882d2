//! `cargo xtask model-plots`: a polar plot of every model's first example, into docs/images/models.

use crate::repo;
use anyhow::{Context, Result};
use brdf::{Brdf, direction};
use brdf_models::{MODELS, ModelInfo, parse_model};
use plot::{Curve, PolarPlot, Radius, Stroke, palette};
use std::f64::consts::PI;

/// Angles of incidence drawn, degrees.
const INCIDENCE_DEG: [f64; 3] = [0.0, 30.0, 60.0];
/// Largest angle of the viewer drawn, degrees: Ward's first three forms have no bound at the horizon.
const TO_DEG: f64 = 88.0;
/// Points on the half circle, a degree and a half apart; and within [`NEAR`] of the mirror direction.
const COARSE: u32 = 121;
const FINE: u32 = 41;
/// Half the width of the finer part, rad.
const NEAR: f64 = 0.06;
/// A peak this many times as high as what is around it is drawn in logarithms.
const STEEP: f64 = 20.0;

pub(crate) fn run() -> Result<()> {
    let folder = repo::root().join("docs/images/models");
    std::fs::create_dir_all(&folder)?;
    for info in MODELS {
        let path = folder.join(format!("{}.svg", info.name));
        std::fs::write(&path, svg(info)?).with_context(|| path.display().to_string())?;
        println!("{}", repo::shown(&path));
    }
    Ok(())
}

fn svg(info: &ModelInfo) -> Result<String> {
    let text = info.examples.first().context("a model without examples")?;
    let model = parse_model(&format!("{}:{text}", info.name))?;
    let curves: Vec<_> = (INCIDENCE_DEG.iter().enumerate())
        .map(|(k, degrees)| curve(&*model.built.brdf, *degrees, palette(k)))
        .collect();
    let values = || curves.iter().flat_map(|c| &c.points).map(|p| p.1);
    let max = values().fold(0.0, f64::max);
    let mean = values().sum::<f64>() / values().count() as f64;
    let plot = PolarPlot {
        title: info.name.to_owned(),
        radius_label: "f (1/sr)".into(),
        radius: if max > STEEP * mean {
            Radius::Log { decades: 4.0 }
        } else {
            Radius::Linear
        },
        incident: (INCIDENCE_DEG.iter().enumerate())
            .map(|(k, degrees)| (-degrees.to_radians(), palette(k)))
            .collect(),
        curves,
    };
    Ok(plot.svg(420)?)
}

/// f of the second channel (green, where there are colours) in the plane of incidence, light from the left.
fn curve(brdf: &dyn Brdf<3>, degrees: f64, color: plot::Color) -> Curve {
    let incidence = degrees.to_radians();
    let wi = direction(incidence, PI);
    let steps = |n: u32, from: f64, to: f64| {
        (0..n).map(move |k| from + (to - from) * f64::from(k) / f64::from(n - 1))
    };
    let last = TO_DEG.to_radians();
    let mut thetas: Vec<f64> = steps(COARSE, -last, last)
        .chain(steps(FINE, incidence - NEAR, incidence + NEAR))
        .collect();
    thetas.sort_by(f64::total_cmp);
    let value = |theta: f64| brdf.eval(wi, direction(theta, 0.0))[1].max(0.0);
    Curve {
        label: format!("{degrees} deg"),
        color,
        stroke: Stroke::Solid,
        points: thetas.into_iter().map(|t| (t, value(t))).collect(),
    }
}
