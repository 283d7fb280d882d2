//! Every file below data-fixtures/ has its line in the manifest: what it is, who made it, terms.

use crate::repo;
use anyhow::Result;

pub(super) fn complaints() -> Result<Vec<String>> {
    let manifest = repo::read(&repo::root().join("data-fixtures/MANIFEST.md"))?;
    let files = repo::files("data-fixtures", "")?;
    Ok(files
        .iter()
        .map(|path| repo::shown(path))
        .filter(|name| name != "data-fixtures/MANIFEST.md")
        .filter(|name| {
            !manifest.contains(&format!("`{}`", name.trim_start_matches("data-fixtures/")))
        })
        .map(|name| format!("{name}: not in data-fixtures/MANIFEST.md"))
        .collect())
}
