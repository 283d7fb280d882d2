//! `gonio eval FILE`: f_r at given directions.

use super::Context;
use crate::args::Eval;
use crate::load;
use anyhow::{Result, bail};
use brdf::{Measured, Status, direction};
use serde::Serialize;
use spectrum::Basis;

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
    One {
        value: Vec<f64>,
        status: &'static str,
    },
    Many {
        values: Vec<Vec<f64>>,
        statuses: Vec<&'static str>,
    },
}

pub(crate) fn run(context: &Context, args: &Eval) -> Result<()> {
    let loaded = load::measured(context, &args.file, args.interpolation)?;
    let material = loaded.measured.as_ref();
    let result = if let Some(batch) = &args.batch {
        let rows = read_directions(
            &scene_io::load::text(batch, scene_io::load::MAX_FILE_BYTES)?,
            &batch.display().to_string(),
        )?;
        let (values, statuses) = rows
            .into_iter()
            .map(|angles| evaluate(material, angles))
            .unzip();
        Outcome::Many { values, statuses }
    } else {
        // clap has checked that both are there
        let (theta_i, theta_o) = (
            args.theta_i.unwrap_or_default(),
            args.theta_o.unwrap_or_default(),
        );
        let (value, status) = evaluate(material, [theta_i, args.phi_i, theta_o, args.phi_o]);
        Outcome::One { value, status }
    };
    let report = Report {
        format: loaded.format.name,
        channels: Channels::of(material.basis()),
        result,
    };
    context.report(&report, || print(&report, material.basis()))
}

/// Degrees theta_i, phi_i, theta_o, phi_o to f_r per channel and its status.
fn evaluate(material: &dyn Measured, degrees: [f64; 4]) -> (Vec<f64>, &'static str) {
    let [theta_i, phi_i, theta_o, phi_o] = degrees.map(f64::to_radians);
    let mut value = vec![0.0; material.basis().len()];
    let status = material.eval_native(
        direction(theta_i, phi_i),
        direction(theta_o, phi_o),
        &mut value,
    );
    (value, status_name(status))
}

fn status_name(status: Status) -> &'static str {
    match status {
        Status::Measured => "measured",
        Status::Interpolated => "interpolated",
        Status::Filled => "filled",
    }
}

/// Lines of four numbers; empty lines, `#` comments and a heading of words are passed over.
fn read_directions(text: &str, name: &str) -> Result<Vec<[f64; 4]>> {
    let mut rows = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty()
            || line.starts_with('#')
            || (rows.is_empty() && line.starts_with(|c: char| c.is_ascii_alphabetic()))
        {
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
    Ok(rows)
}

fn print(report: &Report, basis: &Basis) {
    match &report.result {
        Outcome::One { value, status } => {
            for (name, v) in basis.names().iter().zip(value) {
                println!("{name:>8}  {v:.7e}");
            }
            println!("  status  {status}    (f_r in 1/sr, without the cosine)");
        }
        Outcome::Many { values, statuses } => {
            println!("{},status", basis.names().join(","));
            for (value, status) in values.iter().zip(statuses) {
                println!(
                    "{},{status}",
                    value
                        .iter()
                        .map(|v| format!("{v:.9e}"))
                        .collect::<Vec<_>>()
                        .join(",")
                );
            }
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
            ("1,0,nan,0\n", "d.csv:1: expected theta_i,phi_i"),
        ] {
            let error = read_directions(text, "d.csv").unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
