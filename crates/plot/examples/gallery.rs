//! Draws one picture of each kind: `cargo run -p plot --example gallery -- FOLDER`.

#![expect(clippy::disallowed_methods, reason = "an example writes its pictures")]

use plot::{
    Axis, Chart, Curve, HeatMap, PlotError, PolarPlot, Radius, Scale, Stroke, palette, png,
};
use std::error::Error;

fn lobe(k: usize, power: i32, mirror: f64) -> Curve {
    let value = |t: f64| 0.1 + (t - mirror).cos().max(0.0).powi(power);
    let points = (-900..=900)
        .map(|d| (f64::from(d) / 10.0).to_radians())
        .map(|t| (t, value(t)))
        .collect();
    Curve {
        label: format!("cos^{power}"),
        color: palette(k),
        stroke: Stroke::Solid,
        points,
    }
}

fn pictures() -> Result<[(&'static str, String); 4], PlotError> {
    let polar = |radius| PolarPlot {
        title: "Three lobes at 45 degrees".into(),
        radius_label: "f_r (1/sr)".into(),
        radius,
        curves: vec![lobe(0, 4, 0.785), lobe(1, 32, 0.785), lobe(2, 256, 0.785)],
        incident: vec![(-0.785, [0, 0, 0])],
    };
    let decay = |k: usize, slope: f64| Curve {
        label: format!("slope {slope}"),
        color: palette(k),
        stroke: if k == 2 {
            Stroke::Dashed
        } else {
            Stroke::Solid
        },
        points: (0..20)
            .map(|n| 1.5_f64.powi(n))
            .map(|x| (x, x.powf(slope)))
            .collect(),
    };
    let chart = Chart {
        title: "Error against run time".into(),
        x: Axis::log("seconds"),
        y: Axis::log("relative RMSE"),
        curves: vec![decay(0, -0.5), decay(1, -0.8), decay(2, -1.0)],
    };
    let values = (0..64 * 64)
        .map(|k| (f64::from(k % 64 - 32).hypot(f64::from(k / 64 - 32)) / -4.0).exp())
        .collect();
    let map = HeatMap {
        title: "A slice".into(),
        x: ("theta_h (deg)".into(), 0.0, 90.0),
        y: ("theta_d (deg)".into(), 0.0, 90.0),
        columns: 64,
        values,
        scale: Scale::Log,
    };
    Ok([
        ("polar", polar(Radius::Linear).svg(640)?),
        ("polar-log", polar(Radius::Log { decades: 3.0 }).svg(640)?),
        ("chart", chart.svg((720, 480))?),
        ("map", map.svg((560, 440))?),
    ])
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: gallery FOLDER")?;
    for (name, svg) in pictures()? {
        std::fs::write(format!("{folder}/{name}.png"), png(&svg, 1.0)?)?;
        std::fs::write(format!("{folder}/{name}.svg"), svg)?;
    }
    Ok(())
}
