//! The linear basis of reflectances for the primaries of sRGB [MallettYuksel2019], by our own optimiser.

use super::quadratic::Programme;
use anyhow::{Result, ensure};
use spectrum::Basis;
use std::fmt::Write as _;

/// Samples of each of the three spectra: 380 to 780 nm by 5 nm, as in the paper.
const COUNT: usize = 81;
const FIRST_NM: f64 = 380.0;
const STEP_NM: f64 = 5.0;

/// Units of the last printed digit: 1e-9.
const UNIT: f64 = 1e9;

pub(super) fn generate() -> Result<String> {
    let rows = solve()?;
    let mut out = String::from(
        "//! Reflectances of the primaries of linear sRGB under D65, the smoothest that sum to 1 [MallettYuksel2019].\n\
         //! Solved and written by `cargo xtask codegen`; don't edit.\n\n",
    );
    let _ = writeln!(
        out,
        "/// The first wavelength, nm.\npub(crate) const FIRST_NM: f64 = {FIRST_NM:?};"
    );
    let _ = writeln!(
        out,
        "/// Between wavelengths, nm.\npub(crate) const STEP_NM: f64 = {STEP_NM:?};\n"
    );
    let _ = writeln!(
        out,
        "/// Of red, green and blue.\npub(crate) static TABLE: [[f64; 3]; {COUNT}] = ["
    );
    for [r, g, b] in rows {
        let _ = writeln!(out, "    [{r:?}, {g:?}, {b:?}],");
    }
    out.push_str("];\n");
    Ok(out)
}

/// The three spectra, rounded to nine decimals so that they still sum to 1.
fn solve() -> Result<Vec<[f64; 3]>> {
    let x = programme().solve()?;
    (0..COUNT)
        .map(|k| {
            let [r, g] = [x[k], x[COUNT + k]].map(|v| (v * UNIT).round());
            let b = UNIT - r - g;
            ensure!(r >= 0.0 && g >= 0.0 && b >= 0.0, "below zero at sample {k}");
            Ok([r, g, b].map(|v| v / UNIT))
        })
        .collect()
}

/// Unknowns: red at all wavelengths, then green, then blue.
fn programme() -> Programme {
    let n = 3 * COUNT;
    // the sum of squared differences of neighbours, for each spectrum
    let mut hessian = vec![vec![0.0; n]; n];
    for k in (0..n - 1).filter(|k| (k + 1) % COUNT != 0) {
        hessian[k][k] += 1.0;
        hessian[k + 1][k + 1] += 1.0;
        hessian[k][k + 1] -= 1.0;
        hessian[k + 1][k] -= 1.0;
    }
    let mut equations = Vec::new();
    let mut values = Vec::new();
    // the three sum to 1 everywhere
    for k in 0..COUNT {
        let mut row = vec![0.0; n];
        for s in 0..3 {
            row[s * COUNT + k] = 1.0;
        }
        equations.push(row);
        values.push(1.0);
    }
    // red and green have the colours of their primaries; blue's follows, as white has that of white
    let weights =
        Basis::Bands((0..COUNT).map(|k| FIRST_NM + STEP_NM * k as f64).collect()).to_linear_srgb();
    for s in 0..2 {
        for c in 0..3 {
            let mut row = vec![0.0; n];
            for k in 0..COUNT {
                row[s * COUNT + k] = weights[k][c];
            }
            equations.push(row);
            values.push(f64::from(u8::from(s == c)));
        }
    }
    Programme {
        hessian,
        equations,
        values,
    }
}
