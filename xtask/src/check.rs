//! `cargo xtask`: what must pass before a push.

use crate::{codegen, process, test, tidy};
use anyhow::Result;

pub(crate) fn run() -> Result<()> {
    process::run("cargo", &["fmt", "--all", "--check"])?;
    process::run(
        "cargo",
        &[
            "clippy",
            "--workspace",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ],
    )?;
    tidy::run()?;
    codegen::run(&["--check".into()])?;
    if process::has_cargo_tool("deny") {
        process::run("cargo", &["deny", "check", "bans", "licenses", "sources"])?;
    } else {
        println!("skipped: cargo-deny is not installed");
    }
    test::run(&[])
}
