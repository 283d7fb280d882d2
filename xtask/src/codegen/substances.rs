//! Refractive indices by wavelength, with what they are in linear sRGB.

use super::table;
use anyhow::{Context, Result, ensure};
use brdf_models::seen;
use spectrum::{Basis, RgbSpace, Spectrum};
use std::fmt::Write as _;

/// Name, title and source of every substance in `refractive_indices.csv`, in the order of the names.
const SUBSTANCES: [[&str; 3]; 13] = [
    ["ag", "silver", "JohnsonChristy1972"],
    ["al", "aluminium", "Rakic1995"],
    ["au", "gold", "JohnsonChristy1972"],
    ["cr", "chromium", "JohnsonChristy1974"],
    ["cu", "copper", "JohnsonChristy1972"],
    ["fe", "iron", "JohnsonChristy1974"],
    ["ni", "nickel", "JohnsonChristy1974"],
    ["ti", "titanium", "JohnsonChristy1974"],
    ["bk7", "borosilicate crown glass", "Schott2017"],
    ["diamond", "diamond", "Peter1923"],
    ["sapphire", "sapphire, ordinary ray", "Dodge1986"],
    ["silica", "fused silica", "Malitson1965"],
    ["water", "water at 20 C", "Daimon2007"],
];

/// Wavelengths whose indices the channels of linear sRGB mix: those at which its primaries look like spectral light.
const RGB_NM: [f64; 3] = [611.4, 549.1, 464.2];

const HEAD: &str = "//! Complex refractive indices by wavelength, from the refractiveindex.info database [Polyanskiy2024].
//! Written by `cargo xtask codegen`; don't edit.

use crate::index::{Seen, Substance};
";

pub(super) fn generate() -> Result<String> {
    let text = table::text("refractive_indices")?;
    let basis = Basis::Rgb(RgbSpace::srgb());
    let mut out = format!(
        "{HEAD}\npub(crate) const TABLE: [Substance; {}] = [\n",
        SUBSTANCES.len()
    );
    for [name, title, citation] in SUBSTANCES {
        let rows = rows(&text, name)?;
        let srgb = seen(&rows, &RGB_NM, &|s: &Spectrum| basis.project(s));
        let _ = writeln!(out, "    Substance {{");
        let _ = writeln!(
            out,
            "        name: {name:?},\n        title: {title:?},\n        citation: {citation:?},"
        );
        out.push_str("        rows: &[\n");
        for [nm, n, k] in rows {
            let _ = writeln!(out, "            [{nm:?}, {n:?}, {k:?}],");
        }
        out.push_str("        ],\n        srgb: [\n");
        for channel in srgb {
            let [n, k] = [channel.n, channel.k].map(rounded);
            let mix = channel.mix.map(rounded);
            let _ = writeln!(
                out,
                "            Seen {{\n                n: {n:?},\n                k: {k:?},\n                mix: {mix:?},\n            }},"
            );
        }
        out.push_str("        ],\n    },\n");
    }
    out.push_str("];\n");
    Ok(out)
}

/// Wavelength, n and k of the rows called `name`.
fn rows(text: &str, name: &str) -> Result<Vec<[f64; 3]>> {
    let mut rows = Vec::new();
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let fields: Vec<&str> = line.split(',').collect();
        if fields[0] == name {
            ensure!(
                fields.len() == 4,
                "row {line:?}: expected substance, nm, n, k"
            );
            let number = |k: usize| fields[k].parse().with_context(|| format!("row {line:?}"));
            rows.push([number(1)?, number(2)?, number(3)?]);
        }
    }
    ensure!(!rows.is_empty(), "no rows of {name}");
    Ok(rows)
}

/// Six decimals: less than what differs between machines.
fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}
