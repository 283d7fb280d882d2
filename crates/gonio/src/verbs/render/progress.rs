//! What a person sees while a picture is made, and how they stop it.

use crate::output::say;
use anyhow::{Context as _, Result};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use tracer::Progress;

/// Watches a render: a bar with the time left on a terminal, a line every tenth elsewhere; Ctrl-C ends it after the
/// tiles at hand.
pub(super) struct Watch {
    bar: ProgressBar,
    total: u64,
    done: AtomicU64,
    /// Plain lines instead of a bar.
    plain: bool,
    stop: Arc<AtomicBool>,
}

impl Watch {
    /// `total` paths; `quiet` shows nothing unless stderr is a terminal.
    pub(super) fn new(total: u64, quiet: bool) -> Result<Self> {
        let stop = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&stop);
        ctrlc::set_handler(move || interrupt(&flag)).context("cannot watch for Ctrl-C")?;
        let terminal = std::io::stderr().is_terminal();
        let bar = if terminal {
            ProgressBar::new(total)
        } else {
            ProgressBar::hidden()
        };
        bar.set_style(ProgressStyle::with_template(
            "rendering {wide_bar} {percent} %, {eta} left",
        )?);
        Ok(Self {
            bar,
            total: total.max(1),
            done: AtomicU64::new(0),
            plain: !terminal && !quiet,
            stop,
        })
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }

    pub(super) fn interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl<const N: usize> Progress<N> for Watch {
    fn cancelled(&self) -> bool {
        self.interrupted()
    }

    fn tile_done(&self, paths: u64) {
        let before = self.done.fetch_add(paths, Ordering::Relaxed);
        self.bar.inc(paths);
        let tenth = |done: u64| done * 10 / self.total;
        if self.plain && tenth(before + paths) > tenth(before) {
            say(format_args!("rendered {} %", tenth(before + paths) * 10));
        }
    }
}

/// The first Ctrl-C asks the render to end, the second ends the program: with 130, as shells do for signal 2.
#[expect(
    clippy::exit,
    reason = "whoever interrupts twice does not want to wait"
)]
fn interrupt(stop: &AtomicBool) {
    if stop.swap(true, Ordering::Relaxed) {
        std::process::exit(130);
    }
    say("interrupted: finishing the tiles at hand; once more ends the program at once");
}

/// Seconds of processor time this process has used, all threads; 0 where the system does not say.
pub(super) fn cpu_seconds() -> f64 {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
    }
    #[cfg(not(unix))]
    {
        0.0
    }
}
