//! Every type that reflects light or chooses directions is in the conformance tests: by its name, or by the registry
//! of models that they run over.

use crate::repo;
use anyhow::Result;
use regex_lite::Regex;
use std::path::Path;

/// The list that the models' conformance tests run over.
const REGISTRY: &str = "crates/brdf-models/src/registry.rs";

pub(super) fn complaints() -> Result<Vec<String>> {
    let implementation =
        Regex::new(r"\b(Brdf<[^>]*>|DirectionSampler|Measured) for (?:\w+::)*(\w+)")?;
    let tests = conformance_tests()?;
    let registry = repo::read(&repo::root().join(REGISTRY))?;
    let mut complaints = Vec::new();
    for path in repo::files("crates", ".rs")?
        .iter()
        .filter(|p| is_source(p))
    {
        let text = repo::read(path)?;
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        for found in implementation.captures_iter(code) {
            let (Some(role), Some(name)) = (found.get(1), found.get(2)) else {
                continue;
            };
            let in_registry =
                repo::shown(path).starts_with("crates/brdf-models/") && names(&registry, &stem)?;
            if !in_registry && !names(&tests, name.as_str())? {
                complaints.push(format!(
                    "{}: {} ({}) is in no conformance test",
                    repo::shown(path),
                    name.as_str(),
                    role.as_str()
                ));
            }
        }
    }
    Ok(complaints)
}

/// Sources of crates other than the contract's own, which only forwards through pointers and linear maps.
fn is_source(path: &Path) -> bool {
    let shown = repo::shown(path);
    shown.contains("/src/") && !shown.starts_with("crates/brdf/")
}

fn names(text: &str, word: &str) -> Result<bool> {
    Ok(Regex::new(&format!(r"\b{word}\b"))?.is_match(text))
}

/// All conformance tests of all crates: `tests/conformance.rs`, or files below `tests/conformance/`.
fn conformance_tests() -> Result<String> {
    let mut text = String::new();
    for path in repo::files("crates", ".rs")? {
        let shown = repo::shown(&path);
        if shown.contains("/tests/") && shown.contains("conformance") {
            text += &repo::read(&path)?;
        }
    }
    Ok(text)
}
