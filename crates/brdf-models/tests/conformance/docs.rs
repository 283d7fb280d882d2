//! docs/models.md says what the registry says.

use brdf_models::{DefaultValue, Laws, MODELS, ModelInfo, Parameter};
use std::path::Path;

fn parameter(p: &Parameter) -> String {
    let default = match p.default {
        DefaultValue::Value(v) => format!("= {v}"),
        DefaultValue::SameAs(other) => format!("= {other}"),
        DefaultValue::Absent => "absent".into(),
    };
    let unit = if p.unit.is_empty() {
        String::new()
    } else {
        format!(" {}", p.unit)
    };
    let channels = if p.per_channel { ", per channel" } else { "" };
    let range = format!("{} ... {}{unit}", p.range.0, p.range.1);
    format!("`{}` {} ({default}; {range}{channels})", p.name, p.title)
}

fn laws(laws: Laws) -> String {
    let broken = [
        (laws.reciprocal, "reciprocity"),
        (laws.conserves_energy, "energy"),
    ];
    let broken: Vec<_> = broken
        .iter()
        .filter(|(kept, _)| !kept)
        .map(|(_, name)| *name)
        .collect();
    if broken.is_empty() {
        "kept".into()
    } else {
        format!("breaks {}", broken.join(" and "))
    }
}

/// The section of one model, as docs/models.md must have it.
fn section(m: &ModelInfo) -> String {
    let parameters: Vec<_> = m
        .parameters
        .iter()
        .map(|p| format!("- {}\n", parameter(p)))
        .collect();
    format!(
        "### `{}`: {}\n\n    f = {}\n\nLaws: {}. Source: [{}].\n\n{}",
        m.name,
        m.title,
        m.formula,
        laws(m.laws),
        m.citation,
        parameters.concat()
    )
}

#[test]
#[expect(
    clippy::disallowed_methods,
    reason = "reads the project's own documentation"
)]
fn documentation_matches_the_registry() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/models.md");
    let text = std::fs::read_to_string(path).expect("docs/models.md");
    let missing: Vec<_> = MODELS
        .iter()
        .map(section)
        .filter(|s| !text.contains(s))
        .collect();
    assert!(
        missing.is_empty(),
        "docs/models.md needs:\n\n{}",
        missing.join("\n")
    );
}
