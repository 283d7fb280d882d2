//! Rejection per slice of the viewer direction, the method of the thesis, with an honest bound and exact pdf.
//!
//! Slice k has the density p_k = min(f cos, M_k p_0) / a_k, with p_0 the proposal, M_k a bound found by search
//! and inflated, and a_k the integral. Should f cos rise above the bound after all, it is cut *in the
//! definition of p_k*: sample and pdf still agree, and the estimate stays unbiased.
//!
//! Tries are limited to K; with acceptance A_k = a_k / M_k the density of what comes back is
//! (1 - (1-A_k)^K) p_k + (1-A_k)^K cos/pi. A share of [`FLOOR`] cosine samples gives support everywhere.
//!
//! Between slices, a slice is chosen by its linear weight, sampled at its *own* viewer direction, and carried to
//! the viewer asked for along constant coordinates (a, b) of the half-vector chart, which keeps highlights in
//! place: p(wi | wo) = sum_k t_k p_k(wi_k) J_k(a, b) / J(a, b). So the pdf is exact for every wo.
//!
//! The number of random numbers used is itself random: stratification is lost.

use crate::chart::Chart;
use crate::cosine::{cosine_hemisphere, cosine_pdf};
use crate::known_grid::{KnownGrid, ViewFrame};
use crate::rejection_cache::{CacheError, Proposal, RejectionCache};
use crate::slice_measure::measure;
use crate::target::sanitised;
use crate::uniform::uniform_hemisphere;
use brdf::{DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use sampling::Rng;
use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

/// Share of cosine samples mixed in, so that nothing reflecting is missed between slices.
const FLOOR: f64 = 1e-3;
/// Safety factor over the maximum found by search.
const INFLATION: f64 = 1.05;
/// Radial scale of the chart samples are carried along; only the shape of the blend depends on it.
const R0: f64 = 0.01;

/// A reflectance a [`Rejection`] can keep, f(wi, wo) in 1/sr without the cosine.
pub type SharedTarget = Arc<dyn Fn(DVec3, DVec3) -> f64 + Send + Sync>;

/// How a [`Rejection`] is built and run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RejectionOptions {
    /// What is proposed.
    pub proposal: Proposal,
    /// Slices from theta_o = 0 to the horizon; 91 puts one at every degree.
    pub n_theta: usize,
    /// Slices around, used for anisotropic targets.
    pub n_phi: usize,
    /// Tries before the cosine fallback.
    pub max_tries: u32,
}

impl Default for RejectionOptions {
    fn default() -> Self {
        Self {
            proposal: Proposal::Uniform,
            n_theta: 91,
            n_phi: 36,
            max_tries: 1 << 20,
        }
    }
}

/// Draws by proposing and refusing.
#[derive(Clone)]
pub struct Rejection {
    f: SharedTarget,
    cache: RejectionCache,
    grid: KnownGrid,
    max_tries: u32,
}

/// How the bound held at random points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundAudit {
    /// Points looked at.
    pub tried: usize,
    /// Points at which f cos exceeds the bound.
    pub above: usize,
    /// Largest f cos / bound seen.
    pub worst: f64,
}

impl Rejection {
    /// Searches the maxima of every slice; rayon over slices.
    #[must_use]
    pub fn new(f: SharedTarget, symmetry: Symmetry, options: RejectionOptions) -> Self {
        let n_phi = if symmetry.isotropic { 1 } else { options.n_phi };
        let grid = KnownGrid::new(options.n_theta, n_phi);
        let proposal = options.proposal;
        let slices: Vec<_> = (0..grid.len())
            .into_par_iter()
            .map(|k| {
                let slice = Slice::new(grid, k);
                let g = |p: &crate::chart::ChartPoint| slice.f_cos(&*f, p.wi);
                let p0 = |p: &crate::chart::ChartPoint| proposal.pdf(p.wi);
                measure(slice.frame.sin_o, slice.frame.cos_o, &g, &p0)
            })
            .collect();
        let cache = RejectionCache {
            n_theta: grid.n_theta,
            n_phi: grid.n_phi,
            proposal,
            maxima: slices
                .iter()
                .map(|s| INFLATION * s.max_ratio.max(s.integral))
                .collect(),
            integrals: slices.iter().map(|s| s.integral).collect(),
        };
        Self {
            f,
            cache,
            grid,
            max_tries: options.max_tries.max(1),
        }
    }

    /// Uses maxima and integrals stored earlier for the same `f`.
    ///
    /// # Errors
    /// If the cache is not consistent in itself; whether it belongs to `f` the caller must know.
    pub fn from_cache(
        f: SharedTarget,
        cache: RejectionCache,
        max_tries: u32,
    ) -> Result<Self, CacheError> {
        cache.check()?;
        let grid = cache.grid();
        Ok(Self {
            f,
            cache,
            grid,
            max_tries: max_tries.max(1),
        })
    }

    /// What to store.
    #[must_use]
    pub fn cache(&self) -> &RejectionCache {
        &self.cache
    }

    /// Looks at `n` proposals of every slice for values above the bound: the honest report on a bound that was
    /// found by search. Deterministic.
    #[must_use]
    pub fn audit(&self, n: usize) -> BoundAudit {
        let one = |k: usize| {
            let (slice, mut rng) = (Slice::new(self.grid, k), Rng::new(k as u64));
            let mut found = (0, 0.0_f64);
            for _ in 0..n {
                let wi = self.cache.proposal.draw(rng.uniform2());
                let bound = self.cache.maxima[k] * self.cache.proposal.pdf(wi);
                let g = slice.f_cos(&*self.f, wi);
                if g > 0.0 {
                    found.0 += usize::from(g > bound);
                    found.1 = found.1.max(g / bound);
                }
            }
            found
        };
        let all: Vec<_> = (0..self.grid.len()).into_par_iter().map(one).collect();
        BoundAudit {
            tried: n * self.grid.len(),
            above: all.iter().map(|s| s.0).sum(),
            worst: all.iter().fold(0.0, |m, s| m.max(s.1)),
        }
    }

    fn acceptance(&self, k: usize) -> f64 {
        let bound = self.cache.maxima[k];
        if bound > 0.0 {
            self.cache.integrals[k] / bound
        } else {
            0.0
        }
    }

    /// Density of [`Self::draw`] in slice `k`, wi in the slice's own frame.
    fn slice_pdf(&self, k: usize, wi: DVec3) -> f64 {
        let accept = self.acceptance(k);
        if accept <= 0.0 {
            return cosine_pdf(wi);
        }
        let g = Slice::new(self.grid, k).f_cos(&*self.f, wi);
        let cut = g.min(self.cache.maxima[k] * self.cache.proposal.pdf(wi));
        let fail = (f64::from(self.max_tries) * (-accept).ln_1p()).exp();
        (1.0 - fail) * cut / self.cache.integrals[k] + fail * cosine_pdf(wi)
    }

    /// A direction from slice `k`, in the slice's own frame.
    fn draw(&self, k: usize, rng: &mut Rng) -> DVec3 {
        if self.acceptance(k) > 0.0 {
            let slice = Slice::new(self.grid, k);
            let proposal = self.cache.proposal;
            for _ in 0..self.max_tries {
                let wi = proposal.draw(rng.uniform2());
                let bound = self.cache.maxima[k] * proposal.pdf(wi);
                if rng.uniform() * bound < slice.f_cos(&*self.f, wi) {
                    return wi;
                }
            }
        }
        cosine_hemisphere(rng.uniform2())
    }
}

impl DirectionSampler for Rejection {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let mut rng = Rng::new(seed(u));
        let wi = if rng.uniform() < FLOOR {
            cosine_hemisphere(rng.uniform2())
        } else {
            let (frame, k) = (
                ViewFrame::new(wo),
                pick(&self.grid.blend(wo), rng.uniform()),
            );
            let there = Slice::new(self.grid, k)
                .chart()
                .inverse(self.draw(k, &mut rng));
            let chart = Chart::new(frame.sin_o, frame.cos_o, R0);
            frame.to_world(chart.forward(there.ab).wi)
        };
        let pdf = self.pdf(wi, wo);
        (pdf > 0.0).then_some(DirectionSample { wi, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let frame = ViewFrame::new(wo);
        let here = Chart::new(frame.sin_o, frame.cos_o, R0).inverse(frame.to_local(wi));
        let mut sum = 0.0;
        for (k, t) in self.grid.blend(wo) {
            if t > 0.0 {
                let there = Slice::new(self.grid, k).chart().forward(here.ab);
                sum += t * self.slice_pdf(k, there.wi) * there.jacobian();
            }
        }
        FLOOR * cosine_pdf(wi) + (1.0 - FLOOR) * sum * here.density
    }

    fn keeps_stratification(&self) -> bool {
        false
    }

    /// Blend of maximum / integral over the slices, at most the limit.
    fn tries_per_sample(&self, wo: DVec3) -> f64 {
        let tries = |k: usize| {
            let accept = self.acceptance(k);
            if accept > 0.0 {
                (1.0 - (1.0 - accept).powf(f64::from(self.max_tries))) / accept
            } else {
                0.0
            }
        };
        self.grid.blend(wo).iter().map(|&(k, t)| t * tries(k)).sum()
    }

    fn bytes(&self) -> usize {
        size_of::<f64>() * (self.cache.maxima.len() + self.cache.integrals.len())
    }
}

impl fmt::Debug for Rejection {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Rejection")
            .field("grid", &self.grid)
            .field("max_tries", &self.max_tries)
            .finish_non_exhaustive()
    }
}

impl Proposal {
    fn draw(self, u: DVec2) -> DVec3 {
        match self {
            Self::Uniform => uniform_hemisphere(u),
            Self::Cosine => cosine_hemisphere(u),
        }
    }

    fn pdf(self, wi: DVec3) -> f64 {
        match self {
            Self::Uniform => 1.0 / TAU,
            Self::Cosine => cosine_pdf(wi),
        }
    }
}

/// One slice: its viewer, and the frame in which that viewer has azimuth 0.
struct Slice {
    viewer: DVec3,
    frame: ViewFrame,
}

impl Slice {
    fn new(grid: KnownGrid, k: usize) -> Self {
        let (theta, phi) = grid.angles(k);
        Self {
            viewer: grid.viewer(k),
            frame: ViewFrame::from_angles(theta, phi),
        }
    }

    fn chart(&self) -> Chart {
        Chart::new(self.frame.sin_o, self.frame.cos_o, R0)
    }

    /// f cos at this slice's viewer, wi in the slice's frame.
    fn f_cos(&self, f: &(dyn Fn(DVec3, DVec3) -> f64 + Send + Sync), wi: DVec3) -> f64 {
        sanitised(f, self.frame.to_world(wi), self.viewer)
    }
}

/// The slice at `u` of the cumulated weights.
fn pick(blend: &[(usize, f64)], mut u: f64) -> usize {
    let mut last = blend[0].0;
    for &(k, t) in blend {
        if t > 0.0 {
            last = k;
            if u < t {
                break;
            }
            u -= t;
        }
    }
    last
}

/// A generator seed from the bits of `u` (the finaliser of SplitMix64 on either half [Steele2014]).
fn seed(u: DVec2) -> u64 {
    let mix = |mut z: u64| {
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    mix(mix(u.x.to_bits()).wrapping_add(0x9e37_79b9_7f4a_7c15) ^ u.y.to_bits())
}
