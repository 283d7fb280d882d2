//! Files begin by saying what they are, and stay small.

use crate::repo;
use anyhow::Result;

/// Lines, tests included, over which a file certainly holds two subjects.
const LIMIT: usize = 800;

pub(super) fn complaints() -> Result<Vec<String>> {
    let mut complaints = Vec::new();
    let files = [repo::files("crates", ".rs")?, repo::files("xtask", ".rs")?].concat();
    for path in files {
        let text = repo::read(&path)?;
        if !text.starts_with("//!") && !text.starts_with("#![no_main]") {
            complaints.push(format!("{}: does not start with //!", repo::shown(&path)));
        }
        let lines = text.lines().count();
        let generated = path.components().any(|c| c.as_os_str() == "generated");
        if lines > LIMIT && !generated {
            complaints.push(format!(
                "{}: {lines} lines, limit {LIMIT}",
                repo::shown(&path)
            ));
        }
    }
    Ok(complaints)
}
