//! The comparison as a table and as a chart.

use super::{Entry, Outcome};
use plot::{LogLog, Series};
use std::fmt::Write;

/// One line a point: method, samples, seconds, processor seconds, relative RMSE, its interval.
#[must_use]
pub fn csv(outcome: &Outcome) -> String {
    let mut out = String::from("method,spp,seconds,cpu_seconds,rel_rmse,ci_low,ci_high,resolved\n");
    for entry in &outcome.entries {
        for p in &entry.curve.points {
            // writing to a String cannot fail
            let _ = writeln!(
                out,
                "{},{},{:.6},{:.6},{:.6e},{:.6e},{:.6e},{}",
                entry.method,
                p.spp,
                p.seconds,
                p.cpu_seconds,
                p.rel_rmse,
                p.ci[0],
                p.ci[1],
                p.resolved
            );
        }
    }
    out
}

/// Error over time, both logarithmic: points with their intervals, fitted lines, slopes in the legend, the target.
#[must_use]
pub fn chart(outcome: &Outcome, title: &str) -> LogLog {
    LogLog {
        title: title.into(),
        x_label: "time of one render (s)".into(),
        y_label: "relative RMSE".into(),
        level: (outcome.target > 0.0).then(|| {
            (
                outcome.target,
                format!("target {:.3} %", 100.0 * outcome.target),
            )
        }),
        series: outcome.entries.iter().enumerate().map(series).collect(),
    }
}

fn series((k, entry): (usize, &Entry)) -> Series {
    let slope = entry.curve.slope.map_or(String::new(), |s| {
        let digits = if s.error < 0.01 { 3 } else { 2 };
        format!(", slope {:.digits$} ± {:.digits$}", s.value, s.error)
    });
    let resolved = || entry.curve.points.iter().filter(|p| p.resolved);
    let line = entry.curve.line.map(|line| {
        let ends = [resolved().next(), resolved().next_back()];
        (ends.into_iter().flatten())
            .map(|p| (p.seconds, line.at(p.seconds.ln()).exp()))
            .collect()
    });
    Series {
        label: format!("{}{slope}", entry.method),
        color: plot::palette(k),
        points: resolved()
            .map(|p| [p.seconds, p.rel_rmse, p.ci[0], p.ci[1]])
            .collect(),
        line: line.unwrap_or_default(),
    }
}
