//! gonio's command line: parse, dispatch to a verb, return an exit code.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for people at a terminal"
)]

mod args;
mod curves;
mod load;
mod verbs;

use args::{Cli, Verb};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(usage) => {
            // help and version are not errors; everything else is bad usage, which is 2
            let code = u8::try_from(usage.exit_code()).unwrap_or(2);
            let _closed_pipe = usage.print();
            return ExitCode::from(code);
        }
    };
    match run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("gonio: {error:#}");
            ExitCode::from(1)
        }
    }
}

fn run(cli: &Cli) -> anyhow::Result<()> {
    let context = verbs::Context::new(cli);
    match &cli.verb {
        None => verbs::render::run(&context, &args::Render::embedded_default()),
        Some(Verb::Render(args)) => verbs::render::run(&context, args),
        Some(Verb::Info(args)) => verbs::info::run(&context, args),
        Some(Verb::Eval(args)) => verbs::eval::run(&context, args),
        Some(Verb::Plot(args)) => verbs::plot::run(&context, args),
        Some(Verb::Mix(args)) => verbs::mix::run(&context, args),
        Some(Verb::Convert(args)) => verbs::convert::run(&context, args),
        Some(Verb::Measure(args)) => verbs::measure::run(&context, args),
        Some(Verb::Compare(args)) => verbs::compare::run(&context, args),
    }
}
