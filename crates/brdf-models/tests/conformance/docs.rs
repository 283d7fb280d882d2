//! docs/models.md says what the registry says.

use brdf_models::{DefaultValue, Laws, MODELS, ModelInfo, Parameter, Role};
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
    let linear = match p.role {
        Role::Weight => ", linear",
        Role::Shape => "",
    };
    let further = if p.repeats {
        format!("; further lobes: `{0}2`, `{0}3` ...", p.name)
    } else {
        String::new()
    };
    let range = match p.choices {
        [] => format!("{} ... {}{unit}", p.range.0, p.range.1),
        choices => format!("one of {}", choices.join(", ")),
    };
    format!(
        "`{}` {} ({default}; {range}{channels}{linear}{further})",
        p.name, p.title
    )
}

fn laws(laws: Laws) -> String {
    let broken = [
        (laws.reciprocal, "reciprocity"),
        (laws.conserves_energy, "energy"),
        (laws.non_negative, "positivity"),
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
        "### `{0}`: {1}\n\n    f = {2}\n\n![{0} at 0, 30 and 60 degrees](images/models/{0}.svg)\n\n\
         Laws: {3}. Source: [{4}].\n\n{5}",
        m.name,
        m.title,
        m.formula,
        laws(m.laws),
        m.citation,
        parameters.concat()
    )
}

/// Everything from this heading on is written by the test, with `GONIO_BLESS=1`.
const HEADING: &str = "## The models\n\n";

#[test]
#[expect(
    clippy::disallowed_methods,
    reason = "reads and writes the project's own documentation"
)]
fn documentation_matches_the_registry() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/models.md");
    let text = std::fs::read_to_string(&path).expect("docs/models.md");
    let start = text.find(HEADING).expect("the heading of the list") + HEADING.len();
    let sections: Vec<_> = MODELS.iter().map(section).collect();
    let expected = format!("{}{}", &text[..start], sections.join("\n"));
    if std::env::var_os("GONIO_BLESS").is_some() {
        std::fs::write(&path, expected).expect("docs/models.md can be written");
    } else {
        assert_eq!(
            text, expected,
            "docs/models.md differs from the registry; GONIO_BLESS=1 writes it anew"
        );
    }
}
