//! `gonio eval FILE`: f_r at given directions.

use super::Context;
use crate::args::Eval;
use crate::load;
use anyhow::{Result, bail};
use brdf::{Measured, Status, direction};
use serde::Serialize;
use spectrum::Basis;
use std::fmt::{self, Write};

#[derive(Serialize)]
struct Report {
    format: &'static str,
    #[serde(flatten)]
    channels: Channels,
    #[serde(flatten)]
    result: Outcome,
}

/// The channels, named or by wavelength.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Channels {
    Channels(Vec<String>),
    WavelengthsNm(Vec<f64>),
}

impl Channels {
    pub(crate) fn of(basis: &Basis) -> Self {
        match basis {
            Basis::Bands(nm) => Self::WavelengthsNm(nm.clone()),
            other => Self::Channels(other.names()),
        }
    }
}

#[derive(Serialize)]
#[serde(untagged)]
enum Outcome {
    One(Reading),
    Many {
        values: Vec<Vec<f64>>,
        statuses: Vec<&'static str>,
        linear_srgb: Vec<[f64; 3]>,
    },
}

/// What a material says about one pair of directions.
#[derive(Serialize)]
struct Reading {
    /// f_r in 1/sr, one a channel.
    value: Vec<f64>,
    status: &'static str,
    /// The same as rendering sees it.
    linear_srgb: [f64; 3],
}

pub(crate) fn run(context: &Context, args: &Eval) -> Result<()> {
    let subject = load::subject(context, &args.file, args.reading)?;
    let probe = Probe::new(subject.measured.as_ref());
    let result = if let Some(batch) = &args.batch {
        let text = scene_io::load::text(batch, scene_io::load::MAX_FILE_BYTES)?;
        let (mut values, mut statuses, mut linear_srgb) = (Vec::new(), Vec::new(), Vec::new());
        for angles in read_directions(&text, &batch.display().to_string())? {
            let reading = probe.read(angles);
            values.push(reading.value);
            statuses.push(reading.status);
            linear_srgb.push(reading.linear_srgb);
        }
        Outcome::Many {
            values,
            statuses,
            linear_srgb,
        }
    } else {
        // the parser has checked that both are there
        let theta_i = args.theta_i.unwrap_or_default();
        let theta_o = args.theta_o.unwrap_or_default();
        Outcome::One(probe.read([theta_i, args.phi_i, theta_o, args.phi_o]))
    };
    let basis = probe.material.basis();
    let report = Report {
        format: subject.format,
        channels: Channels::of(basis),
        result,
    };
    context.report(&report, |out| print(&report, basis, out))
}

/// A material and how its channels become f_r and colour.
struct Probe<'a> {
    material: &'a dyn Measured,
    to_linear_srgb: Vec<[f64; 3]>,
    scale: f64,
}

impl<'a> Probe<'a> {
    fn new(material: &'a dyn Measured) -> Self {
        let basis = material.basis();
        Self {
            material,
            to_linear_srgb: basis.to_linear_srgb(),
            scale: load::brdf_scale(basis),
        }
    }

    /// Degrees theta_i, phi_i, theta_o, phi_o to f_r.
    fn read(&self, degrees: [f64; 4]) -> Reading {
        let [theta_i, phi_i, theta_o, phi_o] = degrees.map(f64::to_radians);
        let (wi, wo) = (direction(theta_i, phi_i), direction(theta_o, phi_o));
        let mut value = vec![0.0; self.to_linear_srgb.len()];
        let status = self.material.eval_native(wi, wo, &mut value);
        let mut linear_srgb = [0.0; 3];
        for (v, row) in value.iter().zip(&self.to_linear_srgb) {
            (0..3).for_each(|c| linear_srgb[c] += v * row[c]);
        }
        value.iter_mut().for_each(|v| *v *= self.scale);
        Reading {
            value,
            status: status_name(status),
            linear_srgb,
        }
    }
}

fn status_name(status: Status) -> &'static str {
    match status {
        Status::Measured => "measured",
        Status::Interpolated => "interpolated",
        Status::Filled => "filled",
    }
}

/// Lines of four numbers; empty lines, `#` comments and a heading that begins with `theta` are passed over.
fn read_directions(text: &str, name: &str) -> Result<Vec<[f64; 4]>> {
    let mut rows: Vec<[f64; 4]> = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        let heading = rows.is_empty() && line.starts_with("theta");
        if line.is_empty() || line.starts_with('#') || heading {
            continue;
        }
        let fields: Vec<f64> = line
            .split(',')
            .map_while(|f| f.trim().parse().ok())
            .filter(|v: &f64| v.is_finite())
            .collect();
        let Ok(row) = <[f64; 4]>::try_from(fields) else {
            bail!(
                "{name}:{}: expected theta_i,phi_i,theta_o,phi_o in degrees, found {line:?}",
                number + 1
            );
        };
        if !(0.0..=90.0).contains(&row[0]) || !(0.0..=90.0).contains(&row[2]) {
            bail!(
                "{name}:{}: expected theta from 0 to 90 degrees, found {line:?}",
                number + 1
            );
        }
        rows.push(row);
    }
    if rows.is_empty() {
        bail!("{name}: expected lines of theta_i,phi_i,theta_o,phi_o in degrees, found none");
    }
    Ok(rows)
}

fn print(report: &Report, basis: &Basis, out: &mut String) -> fmt::Result {
    match &report.result {
        Outcome::One(reading) => {
            for (name, v) in basis.names().iter().zip(&reading.value) {
                writeln!(out, "{name:>13}  {v:.7e}")?;
            }
            let [r, g, b] = reading.linear_srgb;
            writeln!(out, "  linear sRGB  {r:.5e} {g:.5e} {b:.5e}")?;
            let status = reading.status;
            writeln!(
                out,
                "       status  {status}    (f_r in 1/sr, without the cosine)"
            )
        }
        Outcome::Many {
            values, statuses, ..
        } => {
            writeln!(out, "{},status", basis.names().join(","))?;
            for (value, status) in values.iter().zip(statuses) {
                let fields: Vec<String> = value.iter().map(|v| format!("{v:.9e}")).collect();
                writeln!(out, "{},{status}", fields.join(","))?;
            }
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::read_directions;

    #[test]
    fn directions_are_read_and_bad_lines_named() {
        let rows = read_directions(
            "theta_i,phi_i,theta_o,phi_o\n# note\n10,0,20,180\n",
            "d.csv",
        )
        .unwrap();
        assert_eq!(rows, vec![[10.0, 0.0, 20.0, 180.0]]);
        for (text, expected) in [
            ("1,2,3\n", "d.csv:1: expected theta_i,phi_i"),
            ("1,2,3,x\n", "d.csv:1: expected theta_i,phi_i"),
            (
                "1,0,2,0\n95,0,2,0\n",
                "d.csv:2: expected theta from 0 to 90",
            ),
            ("nan,0,1,0\n", "d.csv:1: expected theta_i,phi_i"),
            ("# only words\n", "d.csv: expected lines of theta_i"),
            ("1,2,3,4,5\n", "d.csv:1: expected theta_i,phi_i"),
            ("1,0,nan,0\n", "d.csv:1: expected theta_i,phi_i"),
        ] {
            let error = read_directions(text, "d.csv").unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
