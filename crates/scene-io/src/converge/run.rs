//! One method: independent runs of growing numbers of samples, timed.

use super::curve::Level;
use super::reference::{Reference, build};
use super::{Method, Options};
use crate::build::{BuiltScene, Places};
use crate::error::Error;
use crate::scene::SceneFile;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use tracer::{Film, Progress};

/// Who ends the work, and the processor time so far.
pub struct Clock<'a> {
    /// Set it to end the work at the next tile; what is complete is kept.
    pub stop: &'a AtomicBool,
    /// Seconds of processor time this process has used.
    pub cpu_seconds: &'a (dyn Fn() -> f64 + Sync),
}

impl std::fmt::Debug for Clock<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Clock").finish_non_exhaustive()
    }
}

impl Clock<'_> {
    pub(super) fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Ends a render when asked to or when its time is up.
pub(super) struct Watch<'a> {
    clock: &'a Clock<'a>,
    start: Instant,
    seconds: f64,
    /// Only whole passes: the time is looked at between them.
    whole: bool,
}

impl<'a> Watch<'a> {
    pub(super) fn new(clock: &'a Clock<'a>, seconds: f64, whole: bool) -> Self {
        Self {
            clock,
            start: Instant::now(),
            seconds,
            whole,
        }
    }

    fn late(&self) -> bool {
        self.start.elapsed().as_secs_f64() > self.seconds
    }
}

impl Progress<3> for Watch<'_> {
    fn cancelled(&self) -> bool {
        self.clock.stopped() || (!self.whole && self.late())
    }

    fn pass_done(&self, film: &Film<3>) -> ControlFlow<()> {
        // the next pass takes as long as all before it
        let used = self.start.elapsed().as_secs_f64();
        if self.whole && 2.0 * used > self.seconds && film.spp() >= 2 * film.replicates() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// What was measured of one method.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The method.
    pub method: Method,
    /// Seconds to read the material and build its sampler, which the curves do not contain.
    pub build_seconds: f64,
    /// By samples a pixel, fewest first.
    pub levels: Vec<Level>,
}

/// One independent run: its film, and the time it has taken.
struct Run {
    film: Film<3>,
    seed: u64,
    seconds: f64,
    cpu_seconds: f64,
}

/// Runs `method`, the `index`-th of the comparison, until its time or its samples are used up.
pub(super) fn measure(
    (scene, places): (&SceneFile, &Places),
    (index, method): (usize, Method),
    reference: &Reference,
    options: &Options,
    clock: &Clock<'_>,
) -> Result<Measured, Error> {
    let start = Instant::now();
    let built = build(scene, method, options, places)?;
    let build_seconds = start.elapsed().as_secs_f64();
    let mut runs: Vec<Run> = (0..options.runs)
        .map(|k| Run {
            film: Film::new(built.size.0, built.size.1, 1),
            // one block of seeds a method: no two runs share their points
            seed: (options.seed).wrapping_add(((index as u64 + 1) << 32) + u64::from(k) + 1),
            seconds: 0.0,
            cpu_seconds: 0.0,
        })
        .collect();
    let mut levels: Vec<Level> = Vec::new();
    let begun = Instant::now();
    let mut spp = 1_u32;
    while spp <= options.spp_max {
        let used = begun.elapsed().as_secs_f64();
        // the next level takes as long as all before it; the first one is always taken
        if !levels.is_empty() && 2.0 * used > options.seconds {
            break;
        }
        let limit = if levels.is_empty() {
            f64::INFINITY
        } else {
            2.0 * options.seconds - used
        };
        let deadline = Instant::now();
        for run in &mut runs {
            let left = limit - deadline.elapsed().as_secs_f64();
            advance(run, spp, &built, (clock, left))?;
        }
        if runs.iter().any(|run| run.film.spp() < spp) {
            break;
        }
        levels.push(level(spp, &runs, reference));
        spp = spp.saturating_mul(2);
    }
    Ok(Measured {
        method,
        build_seconds,
        levels,
    })
}

/// Takes a run to `spp` samples a pixel, unless it is ended.
fn advance(
    run: &mut Run,
    spp: u32,
    built: &BuiltScene,
    (clock, seconds): (&Clock<'_>, f64),
) -> Result<(), Error> {
    if clock.stopped() {
        return Ok(());
    }
    let mut settings = built.settings.clone();
    (settings.spp, settings.seed) = (spp, run.seed);
    let (start, cpu) = (Instant::now(), (clock.cpu_seconds)());
    let watch = Watch::new(clock, seconds, false);
    tracer::render(&built.scene, &settings, &mut run.film, &watch)
        .map_err(|e| Error::invalid(e.to_string()))?;
    run.seconds += start.elapsed().as_secs_f64();
    run.cpu_seconds += (clock.cpu_seconds)() - cpu;
    Ok(())
}

fn level(spp: u32, runs: &[Run], reference: &Reference) -> Level {
    Level {
        spp,
        seconds: runs.iter().map(|r| r.seconds).collect(),
        cpu_seconds: runs.iter().map(|r| r.cpu_seconds).collect(),
        distances: (runs.iter())
            .map(|r| reference.distance(&r.film.mean()))
            .collect(),
    }
}
