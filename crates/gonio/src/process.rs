//! What the program asks of the system: to be told of Ctrl-C, and its processor time.

use crate::output::say;
use anyhow::{Context as _, Result};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that the first Ctrl-C sets; the second ends the program at once.
pub(crate) fn watch_interrupts() -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || interrupt(&flag)).context("cannot watch for Ctrl-C")?;
    Ok(stop)
}

/// The first Ctrl-C asks the work to end, the second ends the program: with 130, as shells do for signal 2.
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
pub(crate) fn cpu_seconds() -> f64 {
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

/// The largest resident size of this process so far, bytes; where the system says.
pub(crate) fn peak_bytes() -> Option<u64> {
    let status = scene_io::load::text(Path::new("/proc/self/status"), 1 << 20).ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kib << 10)
}
