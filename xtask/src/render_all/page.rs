//! The contact sheet.

use serde_json::Value;
use std::fmt::Write;

/// One scene and what became of it.
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) outcome: Outcome,
}

pub(super) enum Outcome {
    Rendered {
        about: String,
        report: Value,
        /// From the start of the program to its end.
        seconds: f64,
        plots: Vec<String>,
    },
    /// Its data are not there.
    Skipped(String),
    Failed(String),
}

impl Outcome {
    /// What a picture took in all.
    pub(super) fn seconds(&self) -> Option<f64> {
        match self {
            Self::Rendered { seconds, .. } => Some(*seconds),
            Self::Skipped(_) | Self::Failed(_) => None,
        }
    }
}

impl Entry {
    /// One line for the terminal.
    pub(super) fn line(&self) -> String {
        match &self.outcome {
            Outcome::Rendered {
                report, seconds, ..
            } => format!("{}: {}", self.name, facts(report, *seconds)),
            Outcome::Skipped(why) => format!("{}: skipped, {why}", self.name),
            Outcome::Failed(why) => format!("{}: FAILED, {why}", self.name),
        }
    }
}

/// Seconds, samples and error of a render.
fn facts(report: &Value, seconds: f64) -> String {
    let number = |key: &str| report[key].as_f64().unwrap_or(f64::NAN);
    let ci = |k: usize| report["rel_rmse_ci"][k].as_f64().unwrap_or(f64::NAN);
    format!(
        "{seconds:.1} s in all, {:.1} s tracing, {} spp, {:.2} M paths/s, sampler {}, relative RMSE {:.2} % (95 %: {:.2} to {:.2} %)",
        number("seconds"),
        number("spp"),
        number("paths_per_second") / 1e6,
        report["sampler"].as_str().unwrap_or("?"),
        100.0 * number("rel_rmse"),
        100.0 * ci(0),
        100.0 * ci(1)
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

pub(super) fn html(entries: &[Entry]) -> String {
    let mut page = String::from(
        "<!doctype html><meta charset=\"utf-8\"><title>gonio: all scenes</title><style>\
         body{font:15px sans-serif;margin:2em;max-width:1200px}section{margin:2em 0;border-top:1px solid #ccc;padding-top:1em}\
         img{max-width:48%;vertical-align:top;margin-right:1%}p{color:#444}</style><h1>gonio: all scenes</h1>\n",
    );
    for entry in entries {
        // writing to a String cannot fail
        let _infallible = write!(page, "<section><h2>{}</h2>", escaped(&entry.name));
        let body = match &entry.outcome {
            Outcome::Rendered {
                about,
                report,
                seconds,
                plots,
            } => {
                let plots: String = plots
                    .iter()
                    .map(|p| format!("<img src=\"{0}\" alt=\"{0}\">", escaped(p)))
                    .collect();
                format!(
                    "<p>{}</p><p>{}</p><img src=\"{name}.png\" alt=\"{name}\">{plots}",
                    escaped(about),
                    escaped(&facts(report, *seconds)),
                    name = escaped(&entry.name)
                )
            }
            Outcome::Skipped(why) => format!("<p>Skipped: {}.</p>", escaped(why)),
            Outcome::Failed(why) => format!("<p><b>Failed:</b> {}</p>", escaped(why)),
        };
        page += &body;
        page += "</section>\n";
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn page_names_every_scene_and_escapes() {
        let entries = [
            Entry {
                name: "a<b".into(),
                outcome: Outcome::Skipped("brass.binary is not there".into()),
            },
            Entry {
                name: "c".into(),
                outcome: Outcome::Failed("x & y".into()),
            },
        ];
        let page = html(&entries);
        assert!(
            page.contains("a&lt;b")
                && page.contains("Skipped: brass.binary")
                && page.contains("x &amp; y"),
            "{page}"
        );
    }
}
