//! Every type that reflects light or chooses directions is named in its crate's conformance tests.

use crate::repo;
use anyhow::Result;
use regex_lite::Regex;
use std::path::Path;

pub(super) fn complaints() -> Result<Vec<String>> {
    let implementation =
        Regex::new(r"\b(Brdf<[^>]*>|DirectionSampler|Measured) for (?:\w+::)*(\w+)")?;
    let mut complaints = Vec::new();
    for path in repo::files("crates", ".rs")? {
        let Some(folder) = crate_of(&path) else {
            continue;
        };
        let text = repo::read(&path)?;
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for found in implementation.captures_iter(code) {
            let (Some(role), Some(name)) = (found.get(1), found.get(2)) else {
                continue;
            };
            if !conformance_text(&folder)?.contains(name.as_str()) {
                complaints.push(format!(
                    "{}: {} ({}) is not in {folder}/tests/conformance*",
                    repo::shown(&path),
                    name.as_str(),
                    role.as_str()
                ));
            }
        }
    }
    Ok(complaints)
}

/// `crates/NAME` for a source file of a crate other than the contract's own.
fn crate_of(path: &Path) -> Option<String> {
    let shown = repo::shown(path);
    let (folder, rest) = shown.strip_prefix("crates/")?.split_once('/')?;
    (rest.starts_with("src/") && folder != "brdf").then(|| format!("crates/{folder}"))
}

fn conformance_text(folder: &str) -> Result<String> {
    let mut text = String::new();
    for path in repo::files(&format!("{folder}/tests"), ".rs")? {
        if repo::shown(&path).contains("conformance") {
            text += &repo::read(&path)?;
        }
    }
    Ok(text)
}
