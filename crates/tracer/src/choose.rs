//! Which way of finding light suits a scene, by trying.

use crate::film::Film;
use crate::kernel::CANDIDATES;
use crate::mode::{Develop, Mode};
use crate::render::{RenderError, in_pool, render};
use crate::scene::Scene;
use crate::settings::{Settings, Shard, Strategy};
use crate::stats::Stats;

/// Longest side of the pilot picture, and its replicates.
const SIDE: u32 = 48;
const REPLICATES: u32 = 8;
/// Samples a pixel of its first look, and the most it takes where that leaves the choice open.
const FIRST: u32 = 8;
const MOST: u32 = 32;
/// A choice before that may cost at most this factor more than the other would, at this confidence of either error.
const REGRET: f64 = 1.25;
const CONFIDENCE: f64 = 0.95;
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
    /// Its 95 % interval.
    pub rel_rmse_ci: [f64; 2],
    /// Work of the pilot: rays, and points on lights in rays.
    pub work: f64,
}

impl Trial {
    /// Squared error times work: time to a given error, up to a factor that all strategies share.
    #[must_use]
    pub fn cost(&self) -> f64 {
        self.rel_rmse * self.rel_rmse * self.work
    }

    fn cost_ci(&self) -> [f64; 2] {
        self.rel_rmse_ci.map(|error| error * error * self.work)
    }
}

/// The better of plain MIS and resampling for this scene, and what both did in a pilot of at most 48 x 48 pixels.
///
/// The pilot ends as soon as the choice can no longer be far wrong, after 8 to 32 samples a pixel. Work is counted, not timed, and the seed follows from that of `settings`: the choice is the same on every machine
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
    in_pool(settings, |settings| {
        let pilot = |strategy, candidates| Pilot {
            scene,
            settings: Settings {
                strategy,
                seed: settings.seed ^ SALT,
                shard: None::<Shard>,
                ..settings.clone()
            },
            film: Film::<M>::new(side(size.0), side(size.1), REPLICATES),
            candidates,
            stats: Stats::default(),
        };
        let (mut mis, mut ris) = (pilot(Strategy::Mis, 1), pilot(Strategy::Ris, CANDIDATES));
        let mut spp = FIRST;
        loop {
            let (a, b) = rayon::join(|| mis.until(spp), || ris.until(spp));
            let trials = [a?, b?];
            let better = usize::from(trials[1].cost() < trials[0].cost());
            let regret = trials[better].cost_ci()[1] / trials[1 - better].cost_ci()[0];
            if spp >= MOST || regret < REGRET {
                return Ok((trials[better].strategy, trials));
            }
            spp *= 2;
        }
    })
}

/// One strategy being tried.
struct Pilot<'a, const N: usize, const M: usize, S: Mode<N>> {
    scene: &'a Scene<N, S>,
    settings: Settings,
    film: Film<M>,
    candidates: usize,
    stats: Stats,
}

impl<const N: usize, const M: usize, S: Develop<N, M>> Pilot<'_, N, M, S> {
    /// Goes on to `spp` samples a pixel.
    fn until(&mut self, spp: u32) -> Result<Trial, RenderError> {
        self.settings.spp = spp;
        self.stats += render(self.scene, &self.settings, &mut self.film, &())?;
        let stats = &self.stats;
        let points = stats.vertices as f64 * self.candidates as f64;
        let estimate = self.film.estimate(CONFIDENCE);
        Ok(Trial {
            strategy: self.settings.strategy,
            rel_rmse: estimate.rel_rmse,
            rel_rmse_ci: estimate.rel_rmse_ci,
            work: stats.closest_rays as f64 + stats.shadow_rays as f64 + CANDIDATE_COST * points,
        })
    }
}
