//! `gonio stress`: every model, table, sampler, light and shape at its extremes.

use super::Context;
use anyhow::{Result, bail};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::{self, Write};
use stress::{Effort, Row, Timing, cases, run as run_cases, timings};

/// Evaluate everything at its extremes against a higher precision, and print the worst errors.
///
/// Exit code 0 if every row keeps its bound and nothing infinite, negative or not a number came out; 1 otherwise.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio stress                          the whole table, some minutes
  gonio stress --quick                  a part of every grid, some seconds
  gonio stress --only light             the rows whose name contains \"light\"
  gonio stress --json | jq '.rows[] | select(.ok | not)'
  gonio stress --markdown               the table of docs/numerics.md
  gonio stress --timing                 what denormal numbers cost on this machine")]
pub(crate) struct Stress {
    /// Only rows whose name contains this.
    #[arg(long, value_name = "PATTERN", default_value = "")]
    pub(crate) only: String,
    /// A part of every grid, ends included: what the tests run.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Print the table in Markdown, with the reason of every bound.
    #[arg(long, conflicts_with = "json")]
    pub(crate) markdown: bool,
    /// Measure instead how much slower denormal numbers are than others.
    #[arg(long, conflicts_with_all = ["only", "quick", "markdown"])]
    pub(crate) timing: bool,
}

pub(crate) fn run(context: &Context, args: &Stress) -> Result<()> {
    if args.timing {
        return timing(context);
    }
    let effort = if args.quick {
        Effort::Quick
    } else {
        Effort::Full
    };
    let rows = run_cases(&cases(), &args.only, effort);
    if rows.is_empty() {
        bail!("--only {}: no row has that in its name", args.only);
    }
    let report = json!({ "rows": rows.iter().map(described).collect::<Vec<_>>() });
    context.report(&report, |out| {
        if args.markdown {
            markdown(&rows, out)
        } else {
            text(&rows, out)
        }
    })?;
    let red: Vec<_> = rows.iter().filter(|r| !r.ok()).collect();
    if let Some(first) = red.first() {
        bail!(
            "{} of {} rows are red, first {}",
            red.len(),
            rows.len(),
            first.case
        );
    }
    Ok(())
}

/// The times of [`timings`]; no time is right or wrong.
fn timing(context: &Context) -> Result<()> {
    let all = timings();
    let described = |t: &Timing| {
        json!({
            "what": t.what,
            "normal_s": t.normal,
            "denormal_s": t.denormal,
            "ratio": t.ratio(),
        })
    };
    let report = json!({ "timings": all.iter().map(described).collect::<Vec<_>>() });
    context.report(&report, |out| {
        writeln!(
            out,
            "{:<42} {:>10} {:>10} {:>6}",
            "what", "normal ms", "denorm. ms", "ratio"
        )?;
        for t in &all {
            let (normal, denormal) = (1e3 * t.normal, 1e3 * t.denormal);
            writeln!(
                out,
                "{:<42} {normal:>10.3} {denormal:>10.3} {:>6.2}",
                t.what,
                t.ratio()
            )?;
        }
        let worst = all.iter().map(Timing::ratio).fold(0.0, f64::max);
        writeln!(out, "largest ratio {worst:.2}")
    })
}

/// A row for programs. JSON has no infinity: an error that is not finite is null.
fn described(row: &Row) -> Value {
    let t = &row.tally;
    json!({
        "case": row.case,
        "worst_relative_error": t.worst,
        "bound": row.bound,
        "ok": row.ok(),
        "reason": row.reason,
        "count": t.count,
        "nan": t.nan,
        "inf": t.inf,
        "negative": t.negative,
        "denormal": t.denormal,
        "seconds": row.seconds,
        "where": t.place,
        "broken": t.broken,
    })
}

fn text(rows: &[Row], out: &mut String) -> fmt::Result {
    writeln!(
        out,
        "{:<52} {:>9} {:>7} {:>9}  nan/inf/neg/denormal",
        "case", "worst", "bound", "checks"
    )?;
    for row in rows {
        let t = &row.tally;
        let mark = if row.ok() { "" } else { "  RED" };
        writeln!(
            out,
            "{:<52} {:>9.1e} {:>7.0e} {:>9}  {}/{}/{}/{}{mark}",
            row.case, t.worst, row.bound, t.count, t.nan, t.inf, t.negative, t.denormal
        )?;
        if !row.ok() {
            writeln!(out, "    worst at {}", t.place)?;
            if !t.broken.is_empty() {
                writeln!(out, "    broken at {}", t.broken)?;
            }
        }
    }
    let red = rows.iter().filter(|r| !r.ok()).count();
    writeln!(out, "{} rows, {red} red", rows.len())
}

fn markdown(rows: &[Row], out: &mut String) -> fmt::Result {
    writeln!(
        out,
        "| case | worst relative error | bound | checks | why this bound |\n|---|---|---|---|---|"
    )?;
    for row in rows {
        let t = &row.tally;
        let mark = if row.ok() { "" } else { " **red**" };
        writeln!(
            out,
            "| {} | {:.1e}{mark} | {:.0e} | {} | {} |",
            row.case, t.worst, row.bound, t.count, row.reason
        )?;
    }
    Ok(())
}
