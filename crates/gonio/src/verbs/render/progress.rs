//! What a person sees while a picture is made, and how they stop it.

use crate::output::say;
use crate::process;
use anyhow::Result;
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
        let stop = process::watch_interrupts()?;
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
