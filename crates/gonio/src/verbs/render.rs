//! `gonio render [SCENE.ron]`.

mod progress;
mod report;

use super::Context;
use crate::args::Render;
use crate::output::say;
use crate::process;
use anyhow::{Context as _, Result};
use progress::Watch;
use report::Report;
use scene_io::image::{Metadata, Picture, write_exr, write_png, write_spectral_exr};
use scene_io::scene::MaterialSpec;
use scene_io::spectral::{AnyFilm, AnyScene};
use scene_io::{BuiltScene, DEFAULT_SCENE, Overrides, SceneFile, build_any_scene};
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Instant;

/// Independent scrambles of the points, from whose differences the error is estimated.
const REPLICATES: u32 = 8;

pub(crate) fn run(context: &Context, args: &Render) -> Result<()> {
    // hours of rendering must not end at a folder that does not exist
    scene_io::write::check(&args.output)?;
    let file = match &args.scene {
        Some(path) => SceneFile::load(path)?,
        None => SceneFile::from_text(
            DEFAULT_SCENE,
            Path::new("the embedded default scene"),
            Path::new(""),
        )?,
    };
    let start = Instant::now();
    let mut built = build_any_scene(file, &overrides(args), &context.places)?;
    built.settings.threads = args.threads.and_then(|t| NonZeroUsize::new(t.into()));
    let build_seconds = start.elapsed().as_secs_f64();
    for note in &built.notes {
        say(format_args!("note: {note}"));
    }
    if args.explain && !context.json {
        report::explain(&built, build_seconds);
    }
    let film = trace(&built, context)?;
    let report = write(&built, &film, args, build_seconds)?;
    context.report(&report, |out| report.print(args, out))
}

fn overrides(args: &Render) -> Overrides {
    Overrides {
        material: args
            .material
            .as_ref()
            .map(|m| MaterialSpec::from_argument(&m.to_string_lossy())),
        interpolation: args.interpolation,
        sampler: args.sampler,
        spectrum: args.spectrum,
        spp: args.spp,
        seed: args.seed,
        size: args.size,
        ..Overrides::default()
    }
}

/// What a render left behind.
struct Traced {
    film: AnyFilm,
    stats: tracer::Stats,
    seconds: f64,
    cpu_seconds: f64,
    interrupted: bool,
}

fn trace(built: &BuiltScene<AnyScene>, context: &Context) -> Result<Traced> {
    let (width, height) = built.size;
    let replicates = REPLICATES.min(built.settings.spp.max(1));
    let mut film = built.scene.film([width, height], replicates);
    let watch = Watch::new(
        u64::from(width) * u64::from(height) * u64::from(built.settings.spp),
        context.json,
    )?;
    let (start, cpu) = (Instant::now(), process::cpu_seconds());
    let stats = (built.scene).render(&built.settings, &mut film, &watch)?;
    watch.finish();
    Ok(Traced {
        film,
        stats,
        seconds: start.elapsed().as_secs_f64(),
        cpu_seconds: process::cpu_seconds() - cpu,
        interrupted: watch.interrupted(),
    })
}

fn write(
    built: &BuiltScene<AnyScene>,
    traced: &Traced,
    args: &Render,
    build_seconds: f64,
) -> Result<Report> {
    let mut picture = Picture::of_film(&traced.film.rgb())?;
    let report = Report::new(built, traced, args, build_seconds);
    picture.metadata = Metadata {
        scene: Some(report.scene.clone()),
        seed: Some(built.settings.seed),
        spp: Some(report.spp),
        seconds: Some(traced.seconds),
        version: Some(env!("CARGO_PKG_VERSION").into()),
        sampler: Some(report.sampler.clone()),
    };
    match traced.film.spectral() {
        Some(spectral) => write_spectral_exr(&args.output, &picture, &spectral)?,
        None => write_exr(&args.output, &picture)?,
    }
    let png = args.output.with_extension("png");
    write_png(&png, &picture, built.tone_map(&picture)).context("the EXR was written")?;
    Ok(report)
}
