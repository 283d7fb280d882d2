//! The project's chores: one verb, one file. Without a verb: the pre-push check.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for people at a terminal"
)]
#![expect(
    clippy::disallowed_methods,
    reason = "chores read and write the repository's files"
)]

mod check;
mod codegen;
mod compare;
mod curet;
mod fixtures;
mod gonio;
mod inner_loop;
mod interpolation;
mod memory;
mod model_plots;
mod ngan;
mod process;
mod render_all;
mod repo;
mod savings;
mod test;
mod tidy;

use anyhow::{Result, bail};
use std::process::ExitCode;

const HELP: &str = "\
cargo xtask               the pre-push check: fmt, clippy, tests, doc tests, tidy
cargo xtask test          the tests; --slow: the slow statistics and golden renders instead
cargo xtask tidy          the repository's own rules
cargo xtask fixtures      make data-fixtures/ again; --check: compare only
cargo xtask codegen       make the generated tables again; --check: compare only
cargo xtask interpolation cross-validate the interpolants on Cornell files
cargo xtask inner-loop    whether RGB scenes pay for the spectral code, in machine code
cargo xtask model-plots   polar plots of all models, into docs/images/models
cargo xtask curet         rough diffuse models fitted to CUReT
cargo xtask ngan DIR      our fits against the published ones, on a folder of MERL files
cargo xtask compare       time to 1 % error beside another renderer
cargo xtask memory        bytes by arithmetic beside those seen, scene by scene
cargo xtask savings       what each thing that is left out would cost
cargo xtask render-all    all scenes their data allow, with a contact sheet; see --help
";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match run(&args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &[String]) -> Result<()> {
    let rest = args.get(1..).unwrap_or_default();
    match args.first().map(String::as_str) {
        None => check::run(),
        Some("test") => test::run(rest),
        Some("tidy") => tidy::run(),
        Some("fixtures") => fixtures::run(rest),
        Some("codegen") => codegen::run(rest),
        Some("interpolation") => interpolation::run(rest),
        Some("model-plots") => model_plots::run(),
        Some("curet") => curet::run(),
        Some("inner-loop") => inner_loop::run(),
        Some("compare") => compare::run(rest),
        Some("ngan") => ngan::run(rest),
        Some("memory") => memory::run(rest),
        Some("savings") => savings::run(),
        Some("render-all") => render_all::run(rest),
        Some("help" | "--help" | "-h") => {
            print!("{HELP}");
            Ok(())
        }
        Some(other) => bail!("unknown verb {other:?}\n{HELP}"),
    }
}
