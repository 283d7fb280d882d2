//! Passes over the picture, tile by tile.

use crate::batch::{Batch, Samples};
use crate::film::{Film, TILE, TileMut};
use crate::kernel::Kernel;
use crate::mode::Develop;
use crate::scene::Scene;
use crate::settings::Settings;
use crate::stats::Stats;
use crate::workspace::Workspace;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// Samples of each pixel of a tile that travel together: 2048 paths fill the lanes even when few go on, and their
/// state fits the second-level cache.
const SAMPLES: u32 = 8;

/// What watches a render.
pub trait Progress<const N: usize>: Sync {
    /// Asked between batches; true ends the render, leaving a valid film.
    fn cancelled(&self) -> bool {
        false
    }

    /// Told after each tile how many paths it took.
    fn tile_done(&self, paths: u64) {
        let _ = paths;
    }

    /// Whether [`Self::pass_done`] asks the film for its estimate: tiles are then looked at while they are in the cache.
    fn estimates(&self) -> bool {
        true
    }

    /// Told after each pass over the picture; may end the render.
    fn pass_done(&self, film: &Film<N>) -> ControlFlow<()> {
        let _ = film;
        ControlFlow::Continue(())
    }
}

/// Nobody watches.
impl<const N: usize> Progress<N> for () {}

/// Set it to end the render.
impl<const N: usize> Progress<N> for AtomicBool {
    fn cancelled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}

/// Why a render did not start.
#[derive(Debug, thiserror::Error)]
#[error("threads could not be started: {0}")]
pub struct RenderError(#[from] rayon::ThreadPoolBuildError);

/// Adds samples to `film` until every pixel has `settings.spp`, in passes that double the count.
///
/// The result depends on the scene, the settings and the size of the film, not on threads or interruptions: a film
/// that was cancelled, stored and restored goes on to the same bits.
///
/// # Errors
/// If the threads that were asked for can't be started.
pub fn render<const N: usize, const M: usize, S: Develop<N, M>>(
    scene: &Scene<N, S>,
    settings: &Settings,
    film: &mut Film<M>,
    progress: &dyn Progress<M>,
) -> Result<Stats, RenderError> {
    in_pool(settings, |settings| {
        Ok(passes(scene, settings, film, progress))
    })
}

/// Runs `f` on the threads that `settings` ask for; those it is given ask for the same.
pub(crate) fn in_pool<T: Send>(
    settings: &Settings,
    f: impl FnOnce(&Settings) -> Result<T, RenderError> + Send,
) -> Result<T, RenderError> {
    let Some(threads) = settings.threads else {
        return f(settings);
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.get())
        .build()?;
    let inside = Settings {
        threads: None,
        ..settings.clone()
    };
    pool.install(|| f(&inside))
}

fn passes<const N: usize, const M: usize, S: Develop<N, M>>(
    scene: &Scene<N, S>,
    settings: &Settings,
    film: &mut Film<M>,
    progress: &dyn Progress<M>,
) -> Stats {
    let kernel = Kernel::new(
        scene,
        settings,
        [film.width(), film.height()],
        film.replicates(),
    );
    let pool = Mutex::new(Vec::new());
    let mut target = film.replicates().next_power_of_two().max(SAMPLES);
    loop {
        let aim = target.min(settings.spp);
        if film.spp() < aim {
            (film.tiles_mut().into_par_iter())
                .enumerate()
                .filter(|(i, _)| settings.shard.is_none_or(|s| s.has(*i)))
                .for_each(|(_, tile)| run_tile(&kernel, &pool, tile, (aim, progress)));
            if progress.cancelled() || progress.pass_done(film).is_break() {
                break;
            }
        }
        if aim == settings.spp {
            break;
        }
        target = target.saturating_mul(2);
    }
    let mut stats = Stats::default();
    let workspaces: Vec<Workspace<N, S>> = pool.into_inner().unwrap_or_default();
    for workspace in &workspaces {
        stats += workspace.stats;
        stats.buffers += workspace.bytes() as u64;
    }
    stats
}

/// Takes one tile to `aim` samples a pixel.
fn run_tile<const N: usize, const M: usize, S: Develop<N, M>>(
    kernel: &Kernel<'_, N, S>,
    pool: &Mutex<Vec<Workspace<N, S>>>,
    mut tile: TileMut<'_, M>,
    (aim, progress): (u32, &dyn Progress<M>),
) {
    let take = || pool.lock().ok()?.pop();
    let mut workspace = take().unwrap_or_else(|| {
        Workspace::new(
            (TILE * TILE * SAMPLES) as usize,
            kernel.scene.materials.len(),
            kernel.candidates,
        )
    });
    let before = workspace.stats.paths;
    while tile.done() < aim && !progress.cancelled() {
        let samples = Samples {
            first: tile.done(),
            count: SAMPLES.min(aim - tile.done()),
        };
        kernel.arch.dispatch(Batch {
            workspace: &mut workspace,
            kernel,
            tile: &mut tile,
            samples,
        });
    }
    if progress.estimates() {
        tile.see();
    }
    progress.tile_done(workspace.stats.paths - before);
    if let Ok(mut pool) = pool.lock() {
        pool.push(workspace);
    }
}
