//! `gonio fit FILE|MODEL|FOLDER`: models fitted to measurements.

mod folder;
mod one;
mod pictures;
mod report;

use super::Context;
use crate::args::Reading;
use crate::output::{Usage, say};
use anyhow::Result;
use brdf_fit::{Family, Metric, families, family};
use clap::Args;
use std::path::{Path, PathBuf};

/// Fit analytic models to a measurement, or to every one in a folder.
#[derive(Debug, Args)]
#[command(
    after_help = "Metrics: ngan (root mean square of f cos), log, cuberoot, relvar (best proposal); docs/fits.md has the formulas.
For one file DIR gets fit.json, polar.svg, spheres.png and the best fit as best.ron, best.xml (Mitsuba 3), best.pbrt
(pbrt-v4), best.glsl and best.abg.txt (A, B, g for optics). For a folder DIR gets one NAME.json a file; files done before are not fitted again, so that
an interrupted run goes on where it was.
Examples:
  gonio fit brass.binary -o brass-fit
  gonio fit brass.binary --models ggx,cook-torrance --lobes 2 --metric cuberoot --cutoff 80 --json -o out
  gonio fit ggx:alpha=0.2 --models ward -o out            how near another model comes
  gonio fit merl/ --cutoff 80 -o table                    every file of a folder"
)]
pub(crate) struct Fit {
    /// A measured file, a model such as ggx:alpha=0.1, or a folder of measured files.
    pub(crate) file: String,
    /// Folder for what is written; made if it is not there.
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// Models to fit, comma separated.
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "all"
    )]
    pub(crate) models: Vec<String>,
    /// What is minimised: ngan, log, cuberoot or relvar.
    #[arg(long, value_name = "M", default_value = "ngan")]
    pub(crate) metric: Metric,
    /// Specular lobes, 1 to 3; models that have none keep out of more than one.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=3))]
    pub(crate) lobes: u8,
    /// Leaves out directions further from the normal, degrees.
    #[arg(long, value_name = "DEG", default_value_t = 90.0, value_parser = parse_cutoff)]
    pub(crate) cutoff: f64,
    /// Skips the picture of spheres.
    #[arg(long)]
    pub(crate) no_spheres: bool,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

fn parse_cutoff(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(deg) if (1.0..=90.0).contains(&deg) => Ok(deg),
        _ => Err("expected degrees from the normal, 1 to 90".into()),
    }
}

pub(crate) fn run(context: &Context, args: &Fit) -> Result<()> {
    let families = chosen(args)?;
    if Path::new(&args.file).is_dir() {
        return folder::run(context, args, &families);
    }
    let source = one::Source::of(context, &args.file, args.reading)?;
    scene_io::write::folder(&args.output)?;
    scene_io::write::check(&args.output.join("fit.json"))?;
    let mut fitted = one::fit_source(context, &source, args, &families)?;
    one::write(context, &source, args, &mut fitted)?;
    let mut report = fitted.report;
    report.written.push(args.output.join("fit.json"));
    one::write_json(&args.output.join("fit.json"), &report)?;
    context.report(&report, |out| report.print(out))
}

/// The families asked for; `all` means those that have as many lobes.
fn chosen(args: &Fit) -> Result<Vec<Box<dyn Family>>> {
    let lobes = usize::from(args.lobes);
    if args.models.iter().any(|m| m == "all") {
        return Ok((families().into_iter())
            .filter_map(|name| family(name, lobes).ok())
            .collect());
    }
    (args.models.iter())
        .map(|name| family(name.trim(), lobes).map_err(|e| Usage(e.to_string()).into()))
        .collect()
}

/// One line on stderr for every model that ends.
fn progress(context: &Context) -> impl Fn(&str, &Result<brdf_fit::Fit, brdf_fit::FitError>) + Sync {
    let quiet = context.json;
    move |name, result| match result {
        Ok(fit) if !quiet => say(format_args!(
            "{name}: {} {:.5e}, {:.1} s",
            fit.metric, fit.error, fit.seconds
        )),
        Ok(_) => {}
        Err(e) => say(format_args!("{name}: {e}")),
    }
}
