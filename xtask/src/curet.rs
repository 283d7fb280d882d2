//! `cargo xtask curet`: rough diffuse models fitted to the 61 samples of CUReT [Dana1999].

use anyhow::{Context, Result, bail};
use brdf::direction;
use brdf_fit::{Estimate, FitData, Metric, Pair, Samples, family, fit};
use std::path::{Path, PathBuf};

/// The models, compared sample by sample.
const MODELS: [&str; 5] = [
    "lambert",
    "oren-nayar",
    "eon",
    "koenderink-2",
    "koenderink-8",
];

pub(crate) fn run() -> Result<()> {
    let data = std::env::var_os("GONIO_DATA").context("set GONIO_DATA")?;
    let folder = PathBuf::from(data).join("curet");
    let pairs = pairs(&folder.join("table.txt"))?;
    println!(
        "| sample | black | lambert | oren-nayar | sigma | kd | eon | koenderink-2 | koenderink-8 |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut better = 0;
    let samples = rows(&folder.join("abrdf.dat"), 1 + pairs.len())?;
    for row in &samples {
        let mut measured = Samples::new(1);
        for (pair, value) in pairs.iter().zip(&row[1..]) {
            measured.push(*pair, &[*value]);
        }
        let weight: f64 = measured.pairs().iter().map(|p| p.weight).sum();
        let light: f64 = measured
            .iter()
            .map(|(p, y)| p.weight * (y[0] * p.wi.z).powi(2))
            .sum();
        let data = FitData::new(measured, Metric::Ngan);
        let fits = MODELS
            .iter()
            .map(|name| Ok(fit(&*family(name, 1)?, &data)?))
            .collect::<Result<Vec<_>>>()?;
        let [sigma, kd] = [&fits[1].estimates[0], &fits[1].estimates[1]];
        better += u32::from(fits[1].error < fits[0].error);
        println!(
            "| {} | {:.4} | {:.4} | {:.4} | {} | {} | {:.4} | {:.4} | {:.4} |",
            row[0],
            (light / weight).sqrt(),
            fits[0].error,
            fits[1].error,
            with_interval(sigma),
            with_interval(kd),
            fits[2].error,
            fits[3].error,
            fits[4].error
        );
    }
    println!(
        "\nOren-Nayar is nearer than Lambert for {better} of {} samples",
        samples.len()
    );
    Ok(())
}

/// A number with its interval, if it has one.
fn with_interval(e: &Estimate) -> String {
    if e.ci.0.is_finite() {
        format!("{:.3} ({:.3} to {:.3})", e.value, e.ci.0, e.ci.1)
    } else {
        format!("{:.3} (bound)", e.value)
    }
}

/// The 205 geometries, each of the same weight: theta and phi of the light, then of the viewer, radians.
fn pairs(table: &Path) -> Result<Vec<Pair>> {
    let rows = rows(table, 5)?;
    let pairs = rows.iter().map(|r| Pair {
        wi: direction(r[1], r[2]),
        wo: direction(r[3], r[4]),
        weight: 1.0,
    });
    Ok(pairs.collect())
}

/// Lines of `count` numbers.
fn rows(file: &Path, count: usize) -> Result<Vec<Vec<f64>>> {
    let text = std::fs::read_to_string(file).with_context(|| file.display().to_string())?;
    let mut rows = Vec::new();
    for (k, line) in text
        .lines()
        .enumerate()
        .filter(|(_, l)| !l.trim().is_empty())
    {
        let place = || format!("{}:{}", file.display(), k + 1);
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        let numbers = numbers.with_context(place)?;
        if numbers.len() != count {
            bail!(
                "{}: expected {count} numbers, found {}",
                place(),
                numbers.len()
            );
        }
        rows.push(numbers);
    }
    Ok(rows)
}
