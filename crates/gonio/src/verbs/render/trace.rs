//! Rendering until the samples, the error or the time that was asked for.

use super::keeper::{Keeper, least};
use super::progress::{Silent, Watch};
use super::{Render, Traced};
use crate::output::say;
use crate::verbs::Context;
use anyhow::{Result, bail};
use scene_io::BuiltScene;
use scene_io::rows::Recorder;
use scene_io::spectral::{AnyFilm, AnyScene};
use std::time::Instant;
use tracer::{Choice, Film, Settings, Stats, Target};

/// Independent scrambles of the points, from whose differences the error is estimated.
const REPLICATES: u32 = 8;
/// Samples a pixel of the first look at the error: fewer say nothing of light that is seldom met.
const FIRST_LOOK: u32 = 32;
/// Most samples a pixel that a target may take, unless `--spp` says otherwise.
const MOST: u32 = 1 << 20;
/// Seed of pilots: any other than the picture's.
const PILOT: u64 = 0x7069_6c6f_7421_0002;

/// What a pilot chose, and what it took.
pub(super) struct Aimed {
    pub(super) target: Target,
    pub(super) choice: Choice,
    pub(super) seconds: f64,
}

pub(super) fn trace(
    built: &mut BuiltScene<AnyScene>,
    context: &Context,
    args: &Render,
    recorder: Recorder,
) -> Result<Traced> {
    let mut watch = Watch::new(context.json, recorder)?;
    let aimed = match args.target_error {
        Some(error) => Some(aim(built, args, error, &watch)?),
        None => None,
    };
    if let Some(aimed) = &aimed {
        built.settings.spp = aimed.choice.spp;
    }
    let (width, height) = built.size;
    let replicates = if args.time.is_some() {
        REPLICATES
    } else {
        REPLICATES.min(built.settings.spp.max(1))
    };
    let mut film = built.scene.film([width, height], replicates);
    let keeper =
        (args.checkpoint.as_ref()).map(|path| Keeper::new(path, args, built, &context.places));
    if let Some(keeper) = &keeper {
        keeper.restore(&mut film)?;
        watch.pause_every(keeper.every);
    }
    watch.restart();
    let (stats, unsaved) = match args.time {
        Some(seconds) => (until(built, &mut film, &watch, seconds)?, None),
        None => samples(built, &mut film, &watch, keeper.as_ref())?,
    };
    let [seconds, cpu_seconds] = watch.seconds();
    let interrupted = watch.interrupted();
    let rows_seconds = watch.estimating();
    let estimate = watch.estimate(film.samples());
    Ok(Traced {
        film,
        stats,
        unsaved,
        seconds,
        cpu_seconds,
        interrupted,
        aimed,
        rows_seconds,
        estimate,
        rows: watch.finish()?,
    })
}

/// All samples that were asked for, with pauses to keep what there is; and why the last of them could not be kept, if
/// so: a full disk ends no render.
fn samples(
    built: &BuiltScene<AnyScene>,
    film: &mut AnyFilm,
    watch: &Watch,
    keeper: Option<&Keeper>,
) -> Result<(Stats, Option<anyhow::Error>)> {
    let settings = &built.settings;
    watch.expect(left(&film.rgb(), settings));
    let mut stats = Stats::default();
    let (mut unsaved, mut told) = (None, false);
    loop {
        stats += built.scene.render(settings, film, watch)?;
        let done = least(&film.rgb(), settings.shard) >= settings.spp || watch.ended();
        if let Some(keeper) = keeper {
            unsaved = keeper.save(film).err();
            if let Some(error) = unsaved.as_ref().filter(|_| !done && !told) {
                told = true;
                say(format_args!("note: {error:#}; rendering goes on"));
            }
            watch.resume();
        }
        if done {
            return Ok((stats, unsaved));
        }
    }
}

/// Paths that are still to come.
fn left(film: &Film<3>, settings: &Settings) -> u64 {
    let tiles = film.tiles().enumerate();
    let mine = tiles.filter(|(i, _)| settings.shard.is_none_or(|s| s.has(*i)));
    mine.map(|(_, t)| {
        let samples = u64::from(settings.spp.saturating_sub(t.done()));
        samples * (t.sums().len() / film.replicates() as usize) as u64
    })
    .sum()
}

/// As many samples as the time allows; how many is settled before the last half of them is drawn.
fn until(
    built: &mut BuiltScene<AnyScene>,
    film: &mut AnyFilm,
    watch: &Watch,
    budget: f64,
) -> Result<Stats> {
    let pixels = u64::from(built.size.0) * u64::from(built.size.1);
    let mut done = 0;
    let mut stats = Stats::default();
    let mut next = Some(REPLICATES);
    while let Some(spp) = next.filter(|_| !watch.ended()) {
        built.settings.spp = spp;
        watch.expect(pixels * u64::from(spp - done));
        stats += built.scene.render(&built.settings, film, watch)?;
        done = spp;
        next = tracer::next_spp(spp, watch.seconds()[0], budget, REPLICATES);
    }
    Ok(stats)
}

/// How many samples keep the picture below `error`, by a pilot of another seed.
fn aim(built: &BuiltScene<AnyScene>, args: &Render, error: f64, watch: &Watch) -> Result<Aimed> {
    let start = Instant::now();
    let target = Target {
        rel_rmse: error,
        confidence: args.confidence,
        most: args.spp.unwrap_or(MOST).max(REPLICATES),
    };
    let size = [built.size.0, built.size.1];
    let mut film = built.scene.film(size, REPLICATES);
    let choice = target.choose(FIRST_LOOK, |spp, confidence| -> Result<_> {
        let settings = Settings {
            spp,
            seed: built.settings.seed ^ PILOT,
            ..built.settings.clone()
        };
        built.scene.render(&settings, &mut film, &Silent(watch))?;
        if watch.interrupted() {
            bail!(
                "interrupted before the picture was begun: a pilot looked for the samples it takes"
            );
        }
        let estimate = film.rgb().estimate(confidence);
        say(format_args!(
            "pilot: {spp} samples a pixel, relative RMSE {:.3} %",
            100.0 * estimate.rel_rmse
        ));
        Ok(estimate)
    })?;
    Ok(Aimed {
        target,
        choice,
        seconds: start.elapsed().as_secs_f64(),
    })
}
