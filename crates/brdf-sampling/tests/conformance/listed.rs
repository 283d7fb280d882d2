//! Nothing is forgotten: the lists against the sources.

use crate::samplers::ALL;
use crate::table_kinds::TABLES;
use std::path::Path;

/// The first word of every list entry is a type's name.
fn is_listed(names: impl Iterator<Item = &'static str>, wanted: &str) -> bool {
    names
        .filter_map(|name| name.split(' ').next())
        .any(|first| first == wanted)
}

#[test]
fn every_sampler_is_listed() {
    let samplers = implementors("src", "DirectionSampler for ");
    assert!(samplers.len() >= 4, "the search is broken: {samplers:?}");
    for name in samplers {
        let names = ALL.iter().map(|e| e.name);
        assert!(is_listed(names, &name), "{name} is not in `ALL`");
    }
}

#[test]
fn every_table_kind_and_its_own_sampler_are_listed() {
    let tables = implementors("../brdf-table/src", "Measured for ");
    assert!(tables.len() >= 4, "the search is broken: {tables:?}");
    for name in tables {
        let names = TABLES.iter().map(|t| t.name);
        assert!(is_listed(names, &name), "{name} is not in `TABLES`");
    }
    for name in implementors("../brdf-table/src", "DirectionSampler for ") {
        let names = ALL.iter().map(|e| e.name);
        assert!(is_listed(names, &name), "{name} is not in `ALL`");
    }
}

/// Names of the types in a folder of sources that implement a trait.
fn implementors(folder: &str, phrase: &str) -> Vec<String> {
    let mut found = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    collect(&root, phrase, &mut found);
    found
}

#[expect(
    clippy::disallowed_methods,
    reason = "reads the workspace's own source"
)]
fn collect(folder: &Path, phrase: &str, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).expect("the source folder") {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            collect(&path, phrase, found);
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a source file");
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for line in code.lines().filter(|l| l.starts_with("impl")) {
            if let Some((_, name)) = line.split_once(phrase) {
                let word = |c: char| !c.is_alphanumeric();
                found.push(name.split(word).next().unwrap_or_default().to_string());
            }
        }
    }
}
