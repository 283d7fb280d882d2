//! No model without its entry in the registry, and so none that escapes these tests.

use brdf_models::MODELS;
use std::collections::HashSet;
use std::fs;
use std::path::Path;

#[test]
#[expect(
    clippy::disallowed_methods,
    reason = "reads the crate's own source, not data"
)]
fn every_model_is_listed() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut entries, mut models) = (0, 0);
    for file in fs::read_dir(source).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_none_or(|e| e != "rs") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let here = text.matches(": ModelInfo = ModelInfo {").count();
        entries += here;
        // the listed models in other channels, compared with them by its own tests
        let elsewhere = path.ends_with("src/spectral.rs");
        if text.contains("Brdf<N> for") && !elsewhere {
            models += 1;
            assert!(
                here > 0,
                "{} implements Brdf without a registry entry",
                path.display()
            );
        }
    }
    assert_eq!(
        entries,
        MODELS.len(),
        "an entry is missing from the `models!` list"
    );
    assert!(
        models >= 10,
        "the search no longer finds the implementations ({models})"
    );
}

#[test]
fn names_are_unique_and_examples_many() {
    let names: HashSet<_> = MODELS.iter().map(|m| m.name).collect();
    assert_eq!(names.len(), MODELS.len(), "two models of one name");
    for m in MODELS {
        assert!(m.examples.len() >= 2, "{} needs examples", m.name);
        let parameters: HashSet<_> = m.parameters.iter().map(|p| p.name).collect();
        assert_eq!(
            parameters.len(),
            m.parameters.len(),
            "{}: two parameters of one name",
            m.name
        );
    }
}
