//! `cargo xtask tidy`: the repository's own rules, each a list of complaints.

mod arrows;
mod conformance;
mod extremes;
mod files;
mod fixtures;
mod lints;
mod references;

use anyhow::{Result, bail};

/// A rule: its name, and what finds its violations.
type Rule = (&'static str, fn() -> Result<Vec<String>>);

const RULES: &[Rule] = &[
    ("dependency arrows", arrows::complaints),
    ("lint opt-in", lints::complaints),
    ("reference keys", references::complaints),
    ("fixture manifest", fixtures::complaints),
    ("conformance lists", conformance::complaints),
    ("stress cases", extremes::complaints),
    ("file heads and sizes", files::complaints),
];

pub(crate) fn run() -> Result<()> {
    let mut failed = 0;
    for (name, rule) in RULES {
        let complaints = rule()?;
        println!(
            "tidy: {name}: {}",
            if complaints.is_empty() {
                "ok".into()
            } else {
                format!("{} complaints", complaints.len())
            }
        );
        for complaint in &complaints {
            println!("  {complaint}");
        }
        failed += complaints.len();
    }
    if failed > 0 {
        bail!("tidy found {failed} violations");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::RULES;

    #[test]
    fn repository_is_tidy() {
        for (name, rule) in RULES {
            let complaints = rule().unwrap();
            assert!(complaints.is_empty(), "{name}: {complaints:#?}");
        }
    }
}
