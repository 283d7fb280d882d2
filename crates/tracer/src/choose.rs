//! Which way of finding light suits a scene, by trying.

use crate::film::Film;
use crate::kernel::CANDIDATES;
use crate::mode::Develop;
use crate::render::{RenderError, render};
use crate::scene::Scene;
use crate::settings::{Settings, Shard, Strategy};

/// Longest side of the pilot picture, its samples a pixel, and its replicates.
const SIDE: u32 = 48;
const SPP: u32 = 32;
const REPLICATES: u32 = 8;
/// Seed of the pilot: any other than the picture's.
const SALT: u64 = 0x7069_6c6f_7421_0001;
/// What a point on a light and its evaluation cost, in rays: 1.2 with brass, 1.7 with blue rubber on the benchmark scene
/// (`docs/error.md`); fixed, since the choice must not depend on the machine.
const CANDIDATE_COST: f64 = 1.4;

/// What a strategy did in the pilot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Which.
    pub strategy: Strategy,
    /// Relative RMSE of the pilot picture.
    pub rel_rmse: f64,
    /// Work of the pilot: rays, and points on lights in rays.
    pub work: f64,
}

impl Trial {
    /// Squared error times work: time to a given error, up to a factor that all strategies share.
    #[must_use]
    pub fn cost(&self) -> f64 {
        self.rel_rmse * self.rel_rmse * self.work
    }
}

/// The better of plain MIS and resampling for this scene, and what both did in a pilot of at most 48 x 48 pixels.
///
/// Work is counted, not timed, and the seed follows from that of `settings`: the choice is the same on every machine
/// and for any number of threads.
///
/// # Errors
/// If the threads that were asked for can't be started.
pub fn choose_strategy<const N: usize, const M: usize, S: Develop<N, M>>(
    scene: &Scene<N, S>,
    settings: &Settings,
    size: (u32, u32),
) -> Result<(Strategy, [Trial; 2]), RenderError> {
    let longest = size.0.max(size.1).max(SIDE);
    let side = |n: u32| (u64::from(n) * u64::from(SIDE) / u64::from(longest)).max(1) as u32;
    let trial = |strategy, candidates: usize| -> Result<Trial, RenderError> {
        let mut film = Film::<M>::new(side(size.0), side(size.1), REPLICATES);
        let settings = Settings {
            strategy,
            spp: SPP,
            seed: settings.seed ^ SALT,
            shard: None::<Shard>,
            ..settings.clone()
        };
        let stats = render(scene, &settings, &mut film, &())?;
        let points = stats.vertices as f64 * candidates as f64;
        Ok(Trial {
            strategy,
            rel_rmse: film.estimate(0.95).rel_rmse,
            work: stats.closest_rays as f64 + stats.shadow_rays as f64 + CANDIDATE_COST * points,
        })
    };
    let trials = [trial(Strategy::Mis, 1)?, trial(Strategy::Ris, CANDIDATES)?];
    let better = if trials[1].cost() < trials[0].cost() {
        trials[1].strategy
    } else {
        trials[0].strategy
    };
    Ok((better, trials))
}
