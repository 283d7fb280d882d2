//! `cargo xtask test [--slow]`: nextest where it is installed, plain cargo test elsewhere.

use crate::process;
use anyhow::{Result, bail};

pub(crate) fn run(args: &[String]) -> Result<()> {
    let slow = match args {
        [] => false,
        [flag] if flag == "--slow" => true,
        _ => bail!("usage: cargo xtask test [--slow]"),
    };
    let nextest = process::has_cargo_tool("nextest");
    match (nextest, slow) {
        (true, false) => process::run("cargo", &["nextest", "run", "--workspace"])?,
        (true, true) => process::run(
            "cargo",
            &["nextest", "run", "--workspace", "--profile", "slow"],
        )?,
        (false, false) => process::run(
            "cargo",
            &["test", "--workspace", "--tests", "--", "--skip", "slow_"],
        )?,
        (false, true) => process::run("cargo", &["test", "--workspace", "--tests", "--", "slow_"])?,
    }
    if !slow {
        process::run("cargo", &["test", "--workspace", "--doc"])?;
    }
    Ok(())
}
