//! `gonio converge [SCENE.ron]`: error against run time.

mod report;

use super::Context;
use crate::args::{Reading, parse_size};
use crate::output::say;
use crate::process;
use anyhow::Result;
use clap::Args;
use report::Report;
use scene_io::converge::{self, Clock, Method, Options, Outcome};
use scene_io::image::write_exr;
use scene_io::scene::MaterialSpec;
use scene_io::{DEFAULT_SCENE, Error, ErrorKind, Overrides, SceneFile};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Measure error against run time for several ways to render a scene: the figure for the paper.
///
/// A method is SAMPLER+POINTS+LIGHT: a sampler (see `gonio render --help`), `sobol`, `halton` or `random` points, and how
/// light is found, `mis`, `light` or `bsdf`. What is left out is `sobol` and `mis`. Each gets independent runs of 1, 2,
/// 4, ... samples a pixel, which are compared with a reference of known error. DIR receives converge.csv, converge.json,
/// converge.svg, converge.png and, if one was rendered, reference.exr, anew after each method; Ctrl-C keeps what is
/// complete. A method named twice is measured twice, with seeds of its own: their ratio is 1 within its interval.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio converge scenes/benchmark/scene.ron --material brass.binary -o brass/
  gonio converge scenes/benchmark/scene.ron --methods hvt,cosine,hvt+random --seconds 30 --target 0.01 -o points/
  gonio converge --methods hvt+mis,hvt+light,hvt+bsdf --spp-max 256 --size 160x120 -o light/ --json")]
pub(crate) struct Converge {
    /// Scene in RON; without it the embedded default scene.
    pub(crate) scene: Option<PathBuf>,
    /// Replaces the scene's main material: a file, or a model such as ggx:alpha=0.1.
    #[arg(long, value_name = "FILE|MODEL")]
    pub(crate) material: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reading: Reading,
    /// What is compared, comma separated.
    #[arg(
        long,
        value_name = "METHODS",
        value_delimiter = ',',
        default_value = "hvt,hvt+random,cosine,cosine+random"
    )]
    pub(crate) methods: Vec<Method>,
    /// Seconds a method, all its runs together.
    #[arg(long, value_name = "S", default_value_t = 10.0, allow_negative_numbers = true, value_parser = parse_seconds)]
    pub(crate) seconds: f64,
    /// Most samples a pixel of a run.
    #[arg(long, value_name = "N", default_value_t = 1 << 20, value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub(crate) spp_max: u32,
    /// Independent runs a method: their spread gives all intervals.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(3..=256))]
    pub(crate) runs: u32,
    /// Size in pixels, such as 320x240.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Worker threads; all cores by default.
    #[arg(long, value_name = "T", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Seed of all random choices.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Relative RMSE at which times are compared; by default the least that all methods resolve.
    #[arg(long, value_name = "E", value_parser = parse_target)]
    pub(crate) target: Option<f64>,
    /// Compare with this picture, whose layer of variances states its error, instead of rendering one.
    #[arg(long, value_name = "FILE.exr", conflicts_with_all = ["reference_method", "reference_seconds", "reference_spp"])]
    pub(crate) reference: Option<PathBuf>,
    /// How the reference is rendered.
    #[arg(long, value_name = "METHOD", default_value = "hvt-fine")]
    pub(crate) reference_method: Method,
    /// For how long; by default twice the time of a method.
    #[arg(long, value_name = "S", value_parser = parse_seconds)]
    pub(crate) reference_seconds: Option<f64>,
    /// Samples a pixel of the reference, whatever their time.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(16..=1 << 20))]
    pub(crate) reference_spp: Option<u32>,
    /// Folder for the results; made if need be.
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
}

pub(crate) fn run(context: &Context, args: &Converge) -> Result<()> {
    let options = options(args);
    scene_io::write::folder(&args.output)?;
    for name in [
        "converge.csv",
        "converge.json",
        "converge.svg",
        "converge.png",
    ] {
        scene_io::write::check(&args.output.join(name))?;
    }
    let scene = match &args.scene {
        Some(path) => SceneFile::load(path)?,
        None => SceneFile::from_text(
            DEFAULT_SCENE,
            Path::new("the embedded default scene"),
            Path::new(""),
        )?,
    };
    let stop = process::watch_interrupts()?;
    let clock = Clock {
        stop: &stop,
        cpu_seconds: &process::cpu_seconds,
    };
    let title = title(args, &scene);
    let mut told = 0;
    let outcome = converge::run(&scene, &context.places, &options, &clock, &mut |outcome| {
        if !context.json {
            outcome.entries[told..].iter().for_each(tell);
        }
        told = outcome.entries.len();
        write(outcome, args, &title)
    })?;
    let report = Report::new(&outcome, args);
    write(&outcome, args, &title)?;
    context.report(&report, |out| report.print(out))
}

fn options(args: &Converge) -> Options {
    Options {
        methods: args.methods.clone(),
        overrides: Overrides {
            material: (args.material.as_ref())
                .map(|m| MaterialSpec::from_argument(&m.to_string_lossy())),
            size: args.size,
            interpolation: args.reading.interpolation,
            colour: args.reading.colour.choice(),
            ..Overrides::default()
        },
        seconds: args.seconds,
        spp_max: args.spp_max,
        runs: args.runs,
        seed: args.seed,
        threads: args.threads.and_then(|t| NonZeroUsize::new(t.into())),
        reference: args.reference.clone(),
        reference_method: args.reference_method,
        reference_seconds: args.reference_seconds.unwrap_or(2.0 * args.seconds),
        reference_spp: args.reference_spp,
        target: args.target,
    }
}

fn title(args: &Converge, scene: &SceneFile) -> String {
    let stem = |path: &Path| {
        path.file_stem()
            .map_or_else(String::new, |s| s.to_string_lossy().into_owned())
    };
    let about = if scene.about.is_empty() {
        stem(&scene.path)
    } else {
        scene.about.clone()
    };
    match &args.material {
        Some(material) => format!("{}, {about}", stem(material)),
        None => about,
    }
}

fn tell(entry: &converge::Entry) {
    if let Some(last) = entry.curve.points.last() {
        say(format_args!(
            "{}: {} samples a pixel in {:.3} s, relative RMSE {:.4} %",
            entry.method,
            last.spp,
            last.seconds,
            100.0 * last.rel_rmse
        ));
    }
}

/// All files, from what there is so far.
fn write(outcome: &Outcome, args: &Converge, title: &str) -> Result<(), Error> {
    let at = |name: &str| args.output.join(name);
    let report = Report::new(outcome, args);
    let bytes = |name: &str, content: &[u8]| scene_io::write::bytes(&at(name), content);
    bytes("converge.csv", converge::csv(outcome).as_bytes())?;
    bytes("converge.json", report.to_json().as_bytes())?;
    if args.reference.is_none() {
        write_exr(&at("reference.exr"), &outcome.reference.picture)?;
    }
    // without a resolved point there is nothing to draw, and the table says so
    if let Ok(svg) = converge::chart(outcome, title).svg((960, 680)) {
        bytes("converge.svg", svg.as_bytes())?;
        let png = plot::png(&svg, 1.5);
        bytes(
            "converge.png",
            &png.map_err(|e| Error::new(ErrorKind::Write, e.to_string()))?,
        )?;
    }
    Ok(())
}

pub(super) fn parse_seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(s) if s > 0.0 && s <= 1e7 => Ok(s),
        _ => Err("expected seconds above 0, at most 1e7".into()),
    }
}

/// `0.01` or `1%`.
fn parse_target(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.parse::<f64>().map(|v| v * unit) {
        Ok(target) if target > 0.0 && target < 10.0 => Ok(target),
        _ => Err("expected a relative error above 0, such as 0.01 or 1%".into()),
    }
}
