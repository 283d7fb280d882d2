//! What a comparison says of itself.

use super::Converge;
use scene_io::converge::{Known, Outcome};
use serde::Serialize;
use std::fmt::{self, Write};
use std::path::PathBuf;

#[derive(Serialize)]
pub(super) struct Report {
    written: Vec<PathBuf>,
    scene: String,
    size: [usize; 2],
    reference: String,
    reference_rel_rmse: f64,
    target: f64,
    runs: u32,
    curves: Vec<Curve>,
    ratios: Vec<Ratio>,
    interrupted: bool,
}

#[derive(Serialize)]
struct Curve {
    method: String,
    build_seconds: f64,
    slope: Option<f64>,
    slope_error: Option<f64>,
    slope_spp: Option<f64>,
    slope_spp_error: Option<f64>,
    seconds_to_target: Option<f64>,
    seconds_to_target_error: Option<f64>,
    extrapolated: Option<bool>,
    points: Vec<Point>,
}

#[derive(Serialize)]
struct Point {
    seconds: f64,
    cpu_seconds: f64,
    spp: u32,
    rel_rmse: Option<f64>,
    ci: [f64; 2],
    resolved: bool,
}

#[derive(Serialize)]
struct Ratio {
    slower: String,
    faster: String,
    ratio: f64,
    ci: [f64; 2],
    extrapolated: bool,
}

impl Report {
    pub(super) fn new(outcome: &Outcome, args: &Converge) -> Self {
        let name = |k: usize| outcome.entries[k].method.to_string();
        let reference = &outcome.reference;
        let mut written: Vec<PathBuf> = [
            "converge.csv",
            "converge.json",
            "converge.svg",
            "converge.png",
        ]
        .map(|f| args.output.join(f))
        .into();
        if args.reference.is_none() {
            written.push(args.output.join("reference.exr"));
        }
        Self {
            written,
            scene: outcome.scene.clone(),
            size: [reference.picture.width, reference.picture.height],
            reference: reference.origin.clone(),
            reference_rel_rmse: reference.rel_rmse(),
            target: outcome.target,
            runs: args.runs,
            curves: outcome.entries.iter().map(curve).collect(),
            ratios: (outcome.ratios.iter())
                .map(|r| Ratio {
                    slower: name(r.slower),
                    faster: name(r.faster),
                    ratio: r.value,
                    ci: r.ci,
                    extrapolated: r.extrapolated,
                })
                .collect(),
            interrupted: outcome.interrupted,
        }
    }

    pub(super) fn to_json(&self) -> String {
        // plain structs of numbers and texts always have a JSON form
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    pub(super) fn print(&self, out: &mut String) -> fmt::Result {
        if self.interrupted {
            writeln!(
                out,
                "interrupted: methods and levels that were complete are kept"
            )?;
        }
        writeln!(
            out,
            "reference: {}, relative RMSE {:.4} % (taken off below)\n",
            self.reference,
            100.0 * self.reference_rel_rmse
        )?;
        writeln!(
            out,
            "{:28} {:>8} {:>10} {:>21}   {:>15} {:>18}",
            "method", "spp", "seconds", "relative RMSE, 95 %", "slope (time)", "seconds to target"
        )?;
        for c in &self.curves {
            c.print(out)?;
        }
        let percent = 100.0 * self.target;
        writeln!(
            out,
            "\ntime to a relative RMSE of {percent:.4} %, with 95 % intervals:"
        )?;
        for r in &self.ratios {
            writeln!(
                out,
                "  {} over {}: {} ({} to {}){}",
                r.slower,
                r.faster,
                short(r.ratio),
                short(r.ci[0]),
                short(r.ci[1]),
                if r.extrapolated {
                    ", on lines continued beyond their points"
                } else {
                    ""
                }
            )?;
        }
        if self.ratios.is_empty() {
            writeln!(out, "  no two methods reach it")?;
        }
        for path in &self.written {
            writeln!(out, "wrote {}", path.display())?;
        }
        Ok(())
    }
}

impl Curve {
    fn print(&self, out: &mut String) -> fmt::Result {
        let with_error = |value: Option<f64>, error: Option<f64>| match (value, error) {
            (Some(v), Some(e)) => format!("{} ± {}", short(v), short(e)),
            _ => "-".into(),
        };
        let slope = with_error(self.slope, self.slope_error);
        let mut to_target = with_error(self.seconds_to_target, self.seconds_to_target_error);
        if self.extrapolated == Some(true) {
            to_target.push('*');
        }
        for (k, p) in self.points.iter().enumerate() {
            let last = k + 1 == self.points.len();
            let error = match p.rel_rmse.filter(|_| p.resolved) {
                Some(e) => format!(
                    "{:.3} % ({:.3}-{:.3})",
                    100.0 * e,
                    100.0 * p.ci[0],
                    100.0 * p.ci[1]
                ),
                None => format!("below {:.3} %", 100.0 * p.ci[1]),
            };
            writeln!(
                out,
                "{:28} {:>8} {:>10.4} {:>21}   {:>15} {:>18}",
                if k == 0 { self.method.as_str() } else { "" },
                p.spp,
                p.seconds,
                error,
                if last { slope.as_str() } else { "" },
                if last { to_target.as_str() } else { "" }
            )?;
        }
        Ok(())
    }
}

fn curve(entry: &scene_io::converge::Entry) -> Curve {
    let seconds = entry.reached.map(|r| r.ln_seconds.value.exp());
    let value = |k: Option<Known>| k.map(|k| k.value);
    let error = |k: Option<Known>| k.map(|k| k.error);
    Curve {
        method: entry.method.to_string(),
        build_seconds: entry.build_seconds,
        slope: value(entry.curve.slope),
        slope_error: error(entry.curve.slope),
        slope_spp: value(entry.curve.slope_spp),
        slope_spp_error: error(entry.curve.slope_spp),
        seconds_to_target: seconds,
        seconds_to_target_error: entry
            .reached
            .zip(seconds)
            .map(|(r, s)| s * r.ln_seconds.error),
        extrapolated: entry.reached.map(|r| r.extrapolated),
        points: (entry.curve.points.iter())
            .map(|p| Point {
                seconds: p.seconds,
                cpu_seconds: p.cpu_seconds,
                spp: p.spp,
                rel_rmse: Some(p.rel_rmse).filter(|e| e.is_finite()),
                ci: p.ci,
                resolved: p.resolved,
            })
            .collect(),
    }
}

/// Three significant digits.
fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        return format!("{value:.2e}");
    }
    let digits = 2 - size.max(1e-9).log10().floor() as i32;
    let digits = usize::try_from(digits).unwrap_or(0);
    format!("{value:.digits$}")
}
