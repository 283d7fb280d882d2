//! `cargo xtask codegen [--check]`: the generated tables, from the numbers in `xtask/data/`.
//!
//! The linear uplift is solved with the CIE tables the program was built with: after a change of theirs, run it
//! twice (`--check` tells).

mod cie;
mod linear_uplift;
mod quadratic;
mod substances;
mod table;

use crate::repo;
use anyhow::{Context, Result, bail};

/// A generated file below `crates/`, and what makes it.
type Generated = (&'static str, fn() -> Result<String>);

const FILES: &[Generated] = &[
    ("spectrum/src/generated/cie_1931_2deg.rs", || {
        cie::observer("cie_1931_2deg", "CIE 1931 standard observer (2 degree)")
    }),
    ("spectrum/src/generated/cie_1964_10deg.rs", || {
        cie::observer("cie_1964_10deg", "CIE 1964 standard observer (10 degree)")
    }),
    ("spectrum/src/generated/illuminants.rs", cie::illuminants),
    (
        "spectrum/src/generated/linear_uplift.rs",
        linear_uplift::generate,
    ),
    (
        "brdf-models/src/generated/substances.rs",
        substances::generate,
    ),
];

pub(crate) fn run(args: &[String]) -> Result<()> {
    let check = match args {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => bail!("usage: cargo xtask codegen [--check]"),
    };
    for (name, generate) in FILES {
        let path = repo::root().join("crates").join(name);
        let text = generate().with_context(|| (*name).to_owned())?;
        if check {
            if repo::read(&path)? != text {
                bail!(
                    "{}: differs from what `cargo xtask codegen` makes",
                    repo::shown(&path)
                );
            }
            println!("{}: as generated", repo::shown(&path));
        } else {
            std::fs::write(&path, text).with_context(|| repo::shown(&path))?;
            println!("wrote {}", repo::shown(&path));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn committed_tables_are_what_the_verb_makes() {
        super::run(&["--check".into()]).unwrap();
    }
}
