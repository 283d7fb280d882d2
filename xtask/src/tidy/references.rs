//! Every `[Key2007]` in code and documentation stands in docs/references.bib, and every paper there once.

use crate::repo;
use anyhow::Result;
use regex_lite::Regex;
use std::collections::BTreeSet;

pub(super) fn complaints() -> Result<Vec<String>> {
    let bib = repo::read(&repo::root().join("docs/references.bib"))?;
    let entry = Regex::new(r"(?m)^@\w+\{([^,\s]+),")?;
    let known: BTreeSet<&str> = entry
        .captures_iter(&bib)
        .filter_map(|c| c.get(1))
        .map(|m| m.as_str())
        .collect();
    let key = Regex::new(r"\[([A-Z][A-Za-z]+[0-9]{2,4}[a-z]?)\\?\]")?;
    let mut complaints = twice(&bib)?;
    let mut files = repo::files("crates", ".rs")?;
    files.extend(repo::files("docs", ".md")?);
    files.extend(repo::files("scenes", ".ron")?);
    for path in files {
        let text = repo::read(&path)?;
        for (number, line) in text.lines().enumerate() {
            // in Rust, keys stand in comments only; elsewhere brackets are types and indices
            let comment = if path.extension().is_some_and(|e| e == "rs") {
                line.find("//").map(|at| &line[at..])
            } else {
                Some(line)
            };
            for found in key
                .captures_iter(comment.unwrap_or_default())
                .filter_map(|c| c.get(1))
            {
                if !known.contains(found.as_str()) {
                    complaints.push(format!(
                        "{}:{}: [{}] is not in docs/references.bib",
                        repo::shown(&path),
                        number + 1,
                        found.as_str()
                    ));
                }
            }
        }
    }
    Ok(complaints)
}

/// Papers that stand in the bibliography under two keys.
fn twice(bib: &str) -> Result<Vec<String>> {
    let doi = Regex::new(r"doi\s*=\s*\{([^}]+)\}")?;
    let mut seen = BTreeSet::new();
    let all = doi.captures_iter(bib).filter_map(|c| c.get(1));
    Ok(all
        .filter(|m| !seen.insert(m.as_str()))
        .map(|m| format!("docs/references.bib: two entries of {}", m.as_str()))
        .collect())
}
