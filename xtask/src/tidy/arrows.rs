//! Which workspace crate may depend on which: the list in ARCHITECTURE.md, enforced.

use anyhow::{Context, Result};
use serde_json::Value;
use std::process::Command;

/// Crate and the workspace crates it may name in `[dependencies]`.
pub(super) const ARROWS: &[(&str, &[&str])] = &[
    ("spectrum", &[]),
    ("sampling", &[]),
    ("brdf-formats", &[]),
    ("plot", &[]),
    ("testkit", &["sampling"]),
    ("brdf", &["spectrum", "sampling"]),
    ("brdf-models", &["brdf", "spectrum", "sampling"]),
    (
        "brdf-table",
        &["brdf", "spectrum", "sampling", "brdf-formats"],
    ),
    (
        "brdf-measure",
        &["brdf", "spectrum", "sampling", "brdf-formats"],
    ),
    ("brdf-sampling", &["brdf", "sampling"]),
    ("brdf-fit", &["brdf", "brdf-models", "sampling", "spectrum"]),
    ("tracer", &["brdf", "spectrum", "sampling"]),
    (
        "scene-io",
        &[
            "spectrum",
            "sampling",
            "brdf-formats",
            "plot",
            "brdf",
            "brdf-models",
            "brdf-table",
            "brdf-measure",
            "brdf-sampling",
            "tracer",
        ],
    ),
    (
        "stress",
        &[
            "spectrum",
            "sampling",
            "brdf-formats",
            "brdf",
            "brdf-models",
            "brdf-table",
            "brdf-sampling",
            "tracer",
        ],
    ),
    (
        "gonio",
        &[
            "stress",
            "spectrum",
            "sampling",
            "brdf-formats",
            "plot",
            "brdf",
            "brdf-models",
            "brdf-table",
            "brdf-measure",
            "brdf-sampling",
            "brdf-fit",
            "tracer",
            "scene-io",
        ],
    ),
    (
        "xtask",
        &[
            "brdf-formats",
            "brdf-table",
            "brdf-measure",
            "brdf-models",
            "brdf-fit",
            "brdf",
            "scene-io",
            "plot",
            "spectrum",
        ],
    ),
];

pub(super) fn complaints() -> Result<Vec<String>> {
    let metadata = metadata()?;
    let packages = metadata["packages"]
        .as_array()
        .context("cargo metadata has no packages")?;
    let ours: Vec<&str> = packages.iter().filter_map(|p| p["name"].as_str()).collect();
    let mut complaints = Vec::new();
    for package in packages {
        let name = package["name"].as_str().unwrap_or_default();
        let Some((_, allowed)) = ARROWS.iter().find(|(from, _)| *from == name) else {
            complaints.push(format!(
                "{name}: not in the arrow list (xtask/src/tidy/arrows.rs, ARCHITECTURE.md)"
            ));
            continue;
        };
        for dependency in package["dependencies"].as_array().into_iter().flatten() {
            let to = dependency["name"].as_str().unwrap_or_default();
            let normal = dependency["kind"].is_null();
            if normal && ours.contains(&to) && !allowed.contains(&to) {
                complaints.push(format!("{name} -> {to}: not in the arrow list"));
            }
        }
    }
    Ok(complaints)
}

fn metadata() -> Result<Value> {
    let output = Command::new("cargo")
        .args([
            "metadata",
            "--format-version",
            "1",
            "--no-deps",
            "--offline",
        ])
        .current_dir(crate::repo::root())
        .output()
        .context("cannot start cargo metadata")?;
    serde_json::from_slice(&output.stdout).context("cargo metadata printed no JSON")
}
