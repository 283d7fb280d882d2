//! Files begin by saying what they are, and stay small.

use crate::repo;
use anyhow::Result;

/// Lines over which a file certainly holds two subjects; tables of test cases may be longer.
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
        let exempt = path
            .components()
            .any(|c| c.as_os_str() == "generated" || c.as_os_str() == "tests");
        if lines > LIMIT && !exempt {
            complaints.push(format!(
                "{}: {lines} lines, limit {LIMIT}",
                repo::shown(&path)
            ));
        }
    }
    Ok(complaints)
}
