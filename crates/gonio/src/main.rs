//! gonio's command line: parse, dispatch to a verb, return an exit code.

mod args;
mod curves;
mod load;
mod output;
mod pictures;
mod process;
mod verbs;

use args::{Cli, Verb};
use clap::Parser;
use output::{Usage, say};
use std::process::ExitCode;

/// Bad input or failed work.
const FAILED: u8 = 1;
/// Bad usage.
const BAD_USAGE: u8 = 2;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        // help and version
        Err(asked) if !asked.use_stderr() => {
            return finish(output::print(&asked.render().to_string()));
        }
        Err(usage) => return finish(Err(Usage(one_line(&usage.render().to_string())).into())),
    };
    finish(run(&cli))
}

fn finish(result: anyhow::Result<()>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say(format_args!("gonio: {error:#}"));
            ExitCode::from(if error.is::<Usage>() {
                BAD_USAGE
            } else {
                FAILED
            })
        }
    }
}

/// What the parser has to say, without its repetition of the usage.
fn one_line(rendered: &str) -> String {
    let words = rendered
        .trim_start_matches("error: ")
        .lines()
        .map(str::trim);
    let said =
        words.take_while(|l| !l.starts_with("Usage:") && !l.starts_with("For more information"));
    let joined: Vec<&str> = said.filter(|l| !l.is_empty()).collect();
    format!(
        "{} (see --help)",
        joined.join(" ").replace("tip:", "- tip:")
    )
}

fn run(cli: &Cli) -> anyhow::Result<()> {
    let context = verbs::Context::new(cli);
    match &cli.verb {
        None => verbs::render::run(&context, &verbs::render::Render::embedded_default()),
        Some(Verb::Render(args)) => verbs::render::run(&context, args),
        Some(Verb::Merge(args)) => verbs::merge::run(&context, args),
        Some(Verb::Info(args)) => verbs::info::run(&context, args),
        Some(Verb::Eval(args)) => verbs::eval::run(&context, args),
        Some(Verb::Plot(args)) => verbs::plot::run(&context, args),
        Some(Verb::Mix(args)) => verbs::mix::run(&context, args),
        Some(Verb::Convert(args)) => verbs::convert::run(&context, args),
        Some(Verb::Measure(args)) => verbs::measure::run(&context, args),
        Some(Verb::Fit(args)) => verbs::fit::run(&context, args),
        Some(Verb::Samplers(args)) => verbs::samplers::run(&context, args),
        Some(Verb::Converge(args)) => verbs::converge::run(&context, args),
        Some(Verb::Compare(args)) => verbs::compare::run(&context, args),
        Some(Verb::Stress(args)) => verbs::stress::run(&context, args),
        Some(Verb::Spectra(args)) => verbs::spectra::run(&context, args),
    }
}

#[cfg(test)]
mod tests {
    use super::one_line;

    #[test]
    fn usage_errors_are_one_line() {
        let rendered = "error: unexpected argument '--thet' found\n\n  tip: a similar argument exists: '--theta-i'\n\nUsage: gonio eval\n\nFor more information, try '--help'.\n";
        assert_eq!(
            one_line(rendered),
            "unexpected argument '--thet' found - tip: a similar argument exists: '--theta-i' (see --help)"
        );
    }
}
