//! Every file of a folder, one JSON a file: a run that is interrupted goes on where it was.

use super::one::{Source, fit_source, write_json};
use super::report::Report;
use super::{Family, Fit as Arguments};
use crate::output::say;
use crate::verbs::Context;
use anyhow::{Context as _, Result, bail};
use serde_json::json;
use std::fmt::{self, Write};
use std::path::{Path, PathBuf};

/// Largest report that is read back.
const MAX_REPORT_BYTES: u64 = 16 << 20;

pub(super) fn run(context: &Context, args: &Arguments, families: &[Box<dyn Family>]) -> Result<()> {
    let files = measured_files(Path::new(&args.file))?;
    if files.is_empty() {
        bail!("{}: expected measured files, found none", args.file);
    }
    scene_io::write::folder(&args.output)?;
    let (mut reports, mut failed, mut kept) = (Vec::new(), Vec::new(), 0_usize);
    for file in files {
        let name = file
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let path = args.output.join(format!("{name}.json"));
        scene_io::write::check(&path)?;
        let source = Source::File(file.clone(), args.reading);
        if let Some(report) = done_before(&path, &source.key(args, families)?) {
            kept += 1;
            reports.push(report);
            continue;
        }
        match fit_source(context, &source, args, families) {
            Ok(fitted) => {
                write_json(&path, &fitted.report)?;
                say(format_args!("wrote {}", path.display()));
                reports.push(fitted.report);
            }
            Err(e) => {
                say(format_args!("left out: {e:#}"));
                failed.push(json!({ "file": file, "why": format!("{e:#}") }));
            }
        }
    }
    if reports.is_empty() {
        bail!(
            "{}: none of its {} measured files could be fitted",
            args.file,
            failed.len()
        );
    }
    let summary = json!({
        "metric": args.metric.to_string(),
        "files": reports,
        "kept": kept,
        "failed": failed,
    });
    context.report(&summary, |out| table(&reports, out))
}

/// The report of an earlier run, if it answers the same question about the same file.
fn done_before(path: &Path, key: &str) -> Option<Report> {
    let text = scene_io::load::text(path, MAX_REPORT_BYTES).ok()?;
    let report: Report = serde_json::from_str(&text).ok()?;
    (report.key == key).then_some(report)
}

/// Files of the folder that are measurements by their content, by name.
fn measured_files(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries =
        std::fs::read_dir(folder).with_context(|| format!("{}: cannot read", folder.display()))?;
    let mut files = Vec::new();
    for entry in entries {
        let path = entry
            .with_context(|| format!("{}: cannot read", folder.display()))?
            .path();
        if path.is_file() && scene_io::material::is_measured(&path) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// One line a material: the error of every model, the best one marked.
fn table(reports: &[Report], out: &mut String) -> fmt::Result {
    for report in reports {
        let name = Path::new(&report.file).file_stem().unwrap_or_default();
        write!(out, "{:<28}", name.to_string_lossy())?;
        for model in &report.models {
            write!(out, "  {} {:.3e}", model.name, model.error)?;
        }
        writeln!(out)?;
    }
    Ok(())
}
