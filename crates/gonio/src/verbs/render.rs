//! `gonio render [SCENE.ron]`.

mod account;
mod args;
mod error_map;
pub(crate) mod keeper;
mod progress;
mod report;
mod strategy;
mod trace;

use super::Context;
use crate::output::say;
use crate::pictures::{Gamut, write_pictures};
use account::Clock;
use anyhow::{Context as _, Result};
pub(crate) use args::Render;
use report::Report;
use scene_io::image::{Metadata, Picture};
use scene_io::rows::{Recorder, Row};
use scene_io::scene::MaterialSpec;
use scene_io::spectral::{AnyFilm, AnyScene};
use scene_io::{BuiltScene, DEFAULT_SCENE, Overrides, SceneFile, build_any_scene};
use std::num::NonZeroUsize;
use std::path::Path;
use trace::{Aimed, trace};

pub(crate) fn run(context: &Context, args: &Render) -> Result<()> {
    let mut clock = Clock::new();
    // hours of rendering must not end at a folder that does not exist
    scene_io::write::check(&args.output)?;
    if let Some(map) = &args.error_map {
        scene_io::write::check(map)?;
    }
    let recorder = match &args.rows {
        Some(path) => Recorder::to_file(path)?,
        None => Recorder::new(),
    };
    let file = match &args.scene {
        Some(path) => SceneFile::load(path)?,
        None => SceneFile::from_text(
            DEFAULT_SCENE,
            Path::new("the embedded default scene"),
            Path::new(""),
        )?,
    };
    clock.scene_read();
    let mut built = build_any_scene(file, &overrides(args), &context.places)?;
    built.settings.threads = args.threads.and_then(|t| NonZeroUsize::new(t.into()));
    clock.built(&built);
    for note in &built.notes {
        say(format_args!("note: {note}"));
    }
    built.settings.shard = args.shard;
    let trials = strategy::settle(&mut built, args.light_strategy)?;
    clock.strategy_chosen();
    let explain = args.explain && !context.json;
    if explain {
        report::explain(&built, clock.seconds.before());
        strategy::explain(&built, trials);
    }
    let traced = trace(&mut built, context, args, recorder)?;
    clock.traced(&traced);
    let report = write(&built, &traced, args, &mut clock)?;
    if let Some(error) = traced.unsaved {
        return Err(match args.shard {
            Some(_) => error,
            None => error.context("the picture was written, but not its samples"),
        });
    }
    if explain {
        report.explain();
    }
    context.report(&report, |out| report.print(args, out))
}

fn overrides(args: &Render) -> Overrides {
    Overrides {
        material: args
            .material
            .as_ref()
            .map(|m| MaterialSpec::from_argument(&m.to_string_lossy())),
        interpolation: args.reading.interpolation,
        colour: args.reading.colour.choice(),
        gamut: args.gamut,
        range_nm: args.range.map(|r| r.0),
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
    /// Why the checkpoint does not hold them.
    unsaved: Option<anyhow::Error>,
    seconds: f64,
    cpu_seconds: f64,
    interrupted: bool,
    rows: Vec<Row>,
    /// What their estimates took.
    rows_seconds: f64,
    /// Of the whole, if the last pass ended.
    estimate: Option<tracer::Estimate>,
    aimed: Option<Aimed>,
}

fn write(
    built: &BuiltScene<AnyScene>,
    traced: &Traced,
    args: &Render,
    clock: &mut Clock,
) -> Result<Report> {
    let mut report = Report::new(built, traced, args, clock.seconds.before());
    clock.estimated();
    if built.settings.shard.is_none() {
        write_all(built, traced, args, &mut report)?;
        clock.written();
    }
    report.account(built, traced, clock.seconds);
    Ok(report)
}

fn write_all(
    built: &BuiltScene<AnyScene>,
    traced: &Traced,
    args: &Render,
    report: &mut Report,
) -> Result<()> {
    let mut picture = Picture::of_film(&traced.film.rgb())?;
    picture.metadata = Metadata {
        scene: Some(report.scene.clone()),
        seed: Some(built.settings.seed),
        spp: Some(report.spp),
        seconds: Some(traced.seconds),
        version: Some(env!("CARGO_PKG_VERSION").into()),
        sampler: Some(report.sampler.clone()),
    };
    let tone = built.tone_map(&picture);
    let gamut = write_pictures(&args.output, &traced.film, &picture, tone)?.1;
    report.gamut = Some(Gamut::new(tone, gamut));
    if let Some(map) = &args.error_map {
        error_map::write(map, &traced.film.rgb()).context("the picture was written")?;
    }
    Ok(())
}
