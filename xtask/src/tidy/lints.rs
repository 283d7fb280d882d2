//! Every member takes the workspace's lints.

use crate::repo;
use anyhow::Result;

pub(super) fn complaints() -> Result<Vec<String>> {
    let mut complaints = Vec::new();
    let manifests = [
        repo::files("crates", "Cargo.toml")?,
        repo::files("xtask", "Cargo.toml")?,
    ]
    .concat();
    for path in &manifests {
        let text = repo::read(path)?;
        // a workspace of its own (fuzz targets, the comparison with Embree) is no member
        let member = !text.contains("[workspace]");
        if member && !text.replace(' ', "").contains("[lints]\nworkspace=true") {
            complaints.push(format!(
                "{}: lacks `[lints] workspace = true`",
                repo::shown(path)
            ));
        }
    }
    Ok(complaints)
}
