//! CIE's observers and illuminants at 1 nm.

use super::table::Table;
use anyhow::{Context, Result, ensure};
use spectrum::{Outside, Spectrum};
use std::fmt::Write as _;

/// Where the numbers are from, for the head of each file.
const SOURCE: &str = "[Cie15], as tabulated in colour-science 0.4.7.\n//! Written by `cargo xtask codegen`; don't edit.";

/// A file of colour-matching functions, 1 nm as published.
pub(super) fn observer(name: &str, title: &str) -> Result<String> {
    let table = Table::read(name)?;
    let mut out = format!("//! {title}, by 1 nm {SOURCE}\n\n");
    let first = table.rows.first().and_then(|r| r[0]).context("no rows")?;
    let _ = writeln!(
        out,
        "/// The first wavelength, nm.\npub(crate) const FIRST_NM: u16 = {first};\n"
    );
    let _ = writeln!(
        out,
        "/// x, y, z.\npub(crate) static TABLE: [[f64; 3]; {}] = [",
        table.rows.len()
    );
    for (k, row) in table.rows.iter().enumerate() {
        let numbers: Option<Vec<f64>> = row.iter().copied().collect();
        let numbers = numbers.context("an empty field")?;
        ensure!(numbers.len() == 4, "expected nm, x, y, z");
        ensure!(
            (numbers[0] - first - k as f64).abs() < 1e-9,
            "not by 1 nm at {}",
            numbers[0]
        );
        let _ = writeln!(
            out,
            "    [{:?}, {:?}, {:?}],",
            numbers[1], numbers[2], numbers[3]
        );
    }
    out.push_str("];\n");
    Ok(out)
}

/// The file of illuminants: A by CIE's formula, the others linear between the published 5 nm, as CIE
/// interpolates daylight.
pub(super) fn illuminants() -> Result<String> {
    let table = Table::read("cie_illuminants")?;
    let mut out = format!("//! Relative spectral powers of CIE illuminants at 1 nm {SOURCE}\n");
    for name in &table.names[1..] {
        let points = table.column(name)?;
        let (nm, values): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        let published = Spectrum::new(nm, values, Outside::Hold)?;
        let knots = published.lambda_nm();
        let first = knots[0];
        let last = if name == "A" {
            830.0
        } else {
            knots[knots.len() - 1]
        };
        let count = (last - first) as usize + 1;
        let at = |k: usize| {
            let lambda = first + k as f64;
            if name == "A" {
                incandescent(lambda)
            } else {
                published.at(lambda)
            }
        };
        if name == "A" {
            for (nm, value) in knots.iter().zip(published.values()) {
                // six digits are published
                ensure!(
                    (incandescent(*nm) / value - 1.0).abs() < 6e-6,
                    "A at {nm} nm"
                );
            }
        }
        let how = if name == "A" {
            "by its formula"
        } else {
            "linear between the published entries, 5 nm apart"
        };
        let _ = writeln!(out, "\n/// The first wavelength of {name}, nm.");
        let _ = writeln!(out, "pub(crate) const {name}_FIRST_NM: u16 = {first};");
        let _ = writeln!(out, "/// CIE {name}, {how}.");
        let _ = writeln!(out, "pub(crate) static {name}: [f64; {count}] = [");
        for start in (0..count).step_by(10) {
            let row: Vec<String> = (start..count.min(start + 10))
                .map(|k| format!("{:?}", rounded(at(k))))
                .collect();
            let _ = writeln!(out, "    {},", row.join(", "));
        }
        out.push_str("];\n");
    }
    Ok(out)
}

/// Illuminant A [Cie15]: 100 (560/l)^5 (exp(1.435e7/(2848 * 560)) - 1)/(exp(1.435e7/(2848 l)) - 1).
fn incandescent(lambda_nm: f64) -> f64 {
    let planck = |l: f64| (1.435e7 / (2848.0 * l)).exp_m1();
    100.0 * (560.0 / lambda_nm).powi(5) * planck(560.0) / planck(lambda_nm)
}

/// Eight decimals: more than was published, less than what differs between machines.
fn rounded(x: f64) -> f64 {
    (x * 1e8).round() / 1e8
}
