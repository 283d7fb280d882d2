//! What a person sees while a picture is made, and how they stop it.

use crate::output::say;
use crate::process;
use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};
use scene_io::rows::{CONFIDENCE, Recorder, Row};
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tracer::{Estimate, Film, Progress};

/// Watches a render: a bar with the time left on a terminal, a line every tenth elsewhere; Ctrl-C ends it after the
/// tiles at hand.
pub(super) struct Watch {
    bar: ProgressBar,
    total: AtomicU64,
    done: AtomicU64,
    /// Plain lines instead of a bar.
    plain: bool,
    stop: Arc<AtomicBool>,
    start: Instant,
    cpu: f64,
    /// The rows, and what went wrong writing them.
    rows: Mutex<(Recorder, Option<scene_io::Error>)>,
    /// Nanoseconds their estimates took.
    estimating: AtomicU64,
    /// The last of them, and the samples of the film it is of.
    last: Mutex<Option<(u64, Estimate)>>,
    /// How long to render before a pause, and since when.
    every: Duration,
    since: Mutex<Instant>,
}

/// Shows nothing of a render and ends it when the other is interrupted.
pub(super) struct Silent<'a>(pub(super) &'a Watch);

impl<const N: usize> Progress<N> for Silent<'_> {
    fn cancelled(&self) -> bool {
        self.0.interrupted()
    }
}

impl Watch {
    /// `quiet` shows nothing unless stderr is a terminal.
    pub(super) fn new(quiet: bool, recorder: Recorder) -> Result<Self> {
        let stop = process::watch_interrupts()?;
        let terminal = std::io::stderr().is_terminal();
        let bar = if terminal {
            ProgressBar::new(0)
        } else {
            ProgressBar::hidden()
        };
        bar.set_style(ProgressStyle::with_template(
            "rendering {wide_bar} {percent} %, {eta} left",
        )?);
        Ok(Self {
            bar,
            total: AtomicU64::new(1),
            done: AtomicU64::new(0),
            plain: !terminal && !quiet,
            stop,
            start: Instant::now(),
            cpu: process::cpu_seconds(),
            rows: Mutex::new((recorder, None)),
            estimating: AtomicU64::new(0),
            last: Mutex::new(None),
            every: Duration::MAX,
            since: Mutex::new(Instant::now()),
        })
    }

    /// `paths` more are to come.
    pub(super) fn expect(&self, paths: u64) {
        self.bar.inc_length(paths);
        let total = self.done.load(Ordering::Relaxed) + paths;
        self.total.store(total.max(1), Ordering::Relaxed);
    }

    /// Time counts from now on.
    pub(super) fn restart(&mut self) {
        (self.start, self.cpu) = (Instant::now(), process::cpu_seconds());
        self.resume();
    }

    /// The render is to pause this often.
    pub(super) fn pause_every(&mut self, every: Duration) {
        self.every = every;
    }

    /// Ends a pause.
    pub(super) fn resume(&self) {
        *self.since.lock().unwrap_or_else(PoisonError::into_inner) = Instant::now();
    }

    fn pauses(&self) -> bool {
        self.every < Duration::MAX
            && self
                .since
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .elapsed()
                >= self.every
    }

    /// Whether rendering must not go on: interrupted, or the rows can't be written.
    pub(super) fn ended(&self) -> bool {
        let rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        self.interrupted() || rows.1.is_some()
    }

    /// The rows, once the render has ended.
    pub(super) fn finish(self) -> Result<Vec<Row>> {
        self.bar.finish_and_clear();
        let (recorder, error) = self
            .rows
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        match error {
            Some(error) => Err(error.into()),
            None => Ok(recorder.rows().to_vec()),
        }
    }

    /// Wall-clock and processor seconds since the start.
    pub(super) fn seconds(&self) -> [f64; 2] {
        [
            self.start.elapsed().as_secs_f64(),
            process::cpu_seconds() - self.cpu,
        ]
    }

    /// The estimate of a film of so many samples in all, if it was made.
    pub(super) fn estimate(&self, samples: u64) -> Option<Estimate> {
        let last = *self.last.lock().unwrap_or_else(PoisonError::into_inner);
        last.filter(|(of, _)| *of == samples).map(|last| last.1)
    }

    /// Seconds that estimates for rows have taken.
    pub(super) fn estimating(&self) -> f64 {
        self.estimating.load(Ordering::Relaxed) as f64 * 1e-9
    }

    pub(super) fn interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl<const N: usize> Progress<N> for Watch {
    fn cancelled(&self) -> bool {
        self.interrupted() || self.pauses()
    }

    fn tile_done(&self, paths: u64) {
        let before = self.done.fetch_add(paths, Ordering::Relaxed);
        self.bar.inc(paths);
        let total = self.total.load(Ordering::Relaxed);
        let tenth = |done: u64| done * 10 / total;
        if self.plain && tenth(before + paths) > tenth(before) {
            say(format_args!("rendered {} %", tenth(before + paths) * 10));
        }
    }

    fn pass_done(&self, film: &Film<N>) -> ControlFlow<()> {
        let seconds = self.seconds();
        // a shard knows nothing of the whole
        if film.spp() == 0 {
            return ControlFlow::Continue(());
        }
        let start = Instant::now();
        let estimate = film.estimate(CONFIDENCE);
        let took = start.elapsed().as_nanos() as u64;
        self.estimating.fetch_add(took, Ordering::Relaxed);
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) =
            Some((film.samples(), estimate));
        let mut rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        match rows.0.push(seconds, film.spp(), &estimate) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                rows.1 = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}
