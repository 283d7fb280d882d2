//! Running other programs, echoing the command so that a failure can be repeated by hand.

use anyhow::{Context, Result, bail};
use std::process::Command;

/// Runs `program` in the repository's root; an error if it does not exit with 0.
pub(crate) fn run(program: &str, args: &[&str]) -> Result<()> {
    println!("$ {program} {}", args.join(" "));
    let status = Command::new(program)
        .args(args)
        .current_dir(crate::repo::root())
        .status()
        .with_context(|| format!("cannot start {program}"))?;
    if !status.success() {
        bail!("{program} {} failed ({status})", args.join(" "));
    }
    Ok(())
}

/// True when `cargo NAME --version` works.
pub(crate) fn has_cargo_tool(name: &str) -> bool {
    Command::new("cargo")
        .args([name, "--version"])
        .output()
        .is_ok_and(|o| o.status.success())
}
