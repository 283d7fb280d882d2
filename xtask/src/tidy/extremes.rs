//! Whatever the stress table has to cover is named by its cases: types that reflect or choose directions, the tracer's
//! shapes and lights, warps and tabulated densities. Models are not looked for: the table iterates their registry.

use crate::repo;
use anyhow::Result;
use regex_lite::Regex;
use std::path::Path;

/// Where the cases are.
const CASES: &str = "crates/stress/src/cases";
/// Enumerations of which every variant wants a case.
const ENUMS: &[(&str, &str)] = &[
    ("crates/tracer/src/shape/mod.rs", "pub enum Shape"),
    ("crates/tracer/src/light/mod.rs", "pub enum PointLight"),
    ("crates/tracer/src/light/mod.rs", "pub(crate) enum Emitter"),
    (
        "crates/tracer/src/light/environment.rs",
        "pub enum Environment",
    ),
];
/// What needs none, and why.
const EXEMPT: &[(&str, &str)] = &[
    (
        "BinnedGrid",
        "GriddedN's look-up, channels summed, packed to 2^-15 of the largest",
    ),
    ("HeroGrid", "the same look-up by one of its channels"),
    ("HeroMeasured", "a table's values at drawn wavelengths"),
    ("Recoloured", "a table's values times a factor a channel"),
    ("RglN", "RglTable's values, channel by channel"),
    ("Model3", "a sum of registered models"),
    ("MetalMix", "what other programs make of an export"),
    ("Line", "a fit of sums, covered by its own tests"),
    ("Estimate", "two numbers"),
    ("Replicates", "made of Welford"),
];

pub(super) fn complaints() -> Result<Vec<String>> {
    let mut cases = String::new();
    for path in repo::files(CASES, ".rs")? {
        cases += &repo::read(&path)?;
    }
    let mut complaints = Vec::new();
    let wanted = wanted()?;
    for (name, _) in EXEMPT {
        if wanted.iter().all(|(_, n)| n != name) {
            complaints.push(format!("{name} is exempt from {CASES}, and does not exist"));
        }
    }
    for (place, name) in wanted {
        let exempt = EXEMPT.iter().any(|(n, _)| *n == name);
        let named = Regex::new(&format!(r"\b{name}\b"))?.is_match(&cases);
        if !named && !exempt {
            complaints.push(format!("{place}: {name} is in no case of {CASES}"));
        }
    }
    Ok(complaints)
}

/// File and name of everything that wants a case.
fn wanted() -> Result<Vec<(String, String)>> {
    let mut all = Vec::new();
    let reflects =
        Regex::new(r"\b(?:\w*Brdf<[^>]*>|DirectionSampler|Measured) for (?:\w+::)*(\w+)")?;
    for path in repo::files("crates", ".rs")?
        .iter()
        .filter(|p| is_source(p))
    {
        collect(&mut all, path, &reflects)?;
    }
    // a warp is what has an inverse
    let warp = Regex::new(r"pub fn (\w+)_inverse\(")?;
    for path in repo::files("crates/sampling/src/warp", ".rs")? {
        collect(&mut all, &path, &warp)?;
    }
    let public = Regex::new(r"(?m)^pub struct (\w+)")?;
    for path in repo::files("crates/sampling/src", ".rs")? {
        let shown = repo::shown(&path);
        // statistics of tests, and point sets of whole numbers
        if !["/warp/", "/points/", "/chi2/"]
            .iter()
            .any(|f| shown.contains(f))
        {
            collect(&mut all, &path, &public)?;
        }
    }
    for (file, head) in ENUMS {
        let text = repo::read(&repo::root().join(file))?;
        let names = variants(&text, head).into_iter();
        all.extend(names.map(|name| ((*file).to_owned(), name)));
    }
    Ok(all)
}

fn collect(all: &mut Vec<(String, String)>, path: &Path, pattern: &Regex) -> Result<()> {
    let text = repo::read(path)?;
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let names = pattern.captures_iter(code).filter_map(|c| c.get(1));
    all.extend(names.map(|name| (repo::shown(path), name.as_str().to_owned())));
    Ok(())
}

/// Sources of the crates that implement the contract, but for the contract itself and the registered models.
fn is_source(path: &Path) -> bool {
    let shown = repo::shown(path);
    let skipped = ["crates/brdf/", "crates/brdf-models/", "crates/stress/"];
    shown.contains("/src/") && !skipped.iter().any(|s| shown.starts_with(s))
}

/// The variants of the enumeration whose definition starts with `head`: what is indented once and starts upper-case.
fn variants(text: &str, head: &str) -> Vec<String> {
    let body = text.split(head).nth(1).unwrap_or_default();
    let body = body.split("\n}").next().unwrap_or_default();
    let lines = body.lines().filter_map(|line| line.strip_prefix("    "));
    lines
        .filter(|line| line.starts_with(|c: char| c.is_ascii_uppercase()))
        .map(|line| line.split(|c: char| !c.is_alphanumeric()).next())
        .map(|name| name.unwrap_or_default().to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{variants, wanted};

    #[test]
    fn finds_what_is_there() {
        let all = wanted().unwrap();
        let expected = [
            "Hvt",
            "RglTable",
            "ThinPlate",
            "GriddedN",
            "Sphere",
            "Mesh",
            "Triangles",
            "Image",
            "Directional",
            "Piecewise2",
            "ggx_half",
            "AliasTable",
        ];
        for name in expected {
            assert!(all.iter().any(|(_, n)| n == name), "{name} in {all:?}");
        }
    }

    #[test]
    fn reads_variants() {
        let text = "pub enum Shape {\n    /// One.\n    Ball {\n        radius: f64,\n    },\n    Net(Mesh),\n    Dot,\n}\nX";
        assert_eq!(variants(text, "pub enum Shape"), ["Ball", "Net", "Dot"]);
    }
}
