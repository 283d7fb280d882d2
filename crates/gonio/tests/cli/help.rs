//! What `--help` says.

use crate::program::Bench;

#[test]
fn help_texts() {
    let bench = Bench::new();
    insta::assert_snapshot!("gonio", bench.text("--help"));
    for verb in [
        "render", "merge", "info", "eval", "plot", "mix", "convert", "measure", "compare",
        "converge", "fit", "samplers", "spectra", "stress",
    ] {
        let help = bench.text(&format!("{verb} --help"));
        assert!(
            help.contains("Example") && help.contains(&format!("gonio {verb} ")),
            "{verb}: {help}"
        );
        insta::assert_snapshot!(verb, help);
    }
}

#[test]
fn version_is_printed() {
    assert_eq!(
        Bench::new().text("--version"),
        format!("gonio {}\n", env!("CARGO_PKG_VERSION"))
    );
}
