//! The program, built for release, and what it reports.

use crate::{process, repo};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;

/// Builds the program.
pub(crate) fn build() -> Result<()> {
    process::run("cargo", &["build", "--release", "--package", "gonio"])
}

/// The program that [`build`] made.
pub(crate) fn command() -> Command {
    let target = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| repo::root().join("target"), PathBuf::from);
    Command::new(target.join("release").join("gonio"))
}

/// What `gonio --json` with these arguments reports.
pub(crate) fn report(arguments: &[&str]) -> Result<Value> {
    run(command().args(arguments))
}

/// The same of a command that has its arguments.
pub(crate) fn run(command: &mut Command) -> Result<Value> {
    let output = command.arg("--json").output();
    let output = output.context("cannot start gonio")?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        bail!("{command:?}: {}", said.trim());
    }
    serde_json::from_slice(&output.stdout).context("gonio printed no JSON")
}

/// A number of a report, by its path.
pub(crate) fn number(report: &Value, path: &str) -> Result<f64> {
    let found = report.pointer(path).and_then(Value::as_f64);
    found.with_context(|| format!("gonio reported no {path}"))
}
