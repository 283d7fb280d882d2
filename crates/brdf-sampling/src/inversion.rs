//! Exact inversion per slice of the viewer direction: marginal, then conditional, from cumulated cell masses.
//!
//! A slice divides the half-vector chart of its viewer into n_a x n_b cells of constant density. The mass of a
//! cell is the root mean square of T = f cos J in it, which minimises the variance among all masses. Between
//! slices the masses blend linearly; as every slice lives on the same unit square, cumulated masses blend with
//! the same weights and stay normalised, so that inverting the blended list samples exactly the blended density.

use crate::chart::Chart;
use crate::known_grid::{Blend, KnownGrid, ViewFrame};
use crate::target::Target;
use brdf::{DirectionSample, DirectionSampler};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Lowest cell mass as a fraction of the mean: support wherever the target is positive.
const FLOOR: f64 = 1e-3;
/// Points along either side of a cell at which the target is looked at.
const POINTS: usize = 2;

/// Resolution of an [`Inversion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InversionOptions {
    /// Slices from theta_o = 0 to the horizon.
    pub n_theta: usize,
    /// Slices around, used for anisotropic targets.
    pub n_phi: usize,
    /// Cells along the radial coordinate of the half vector.
    pub n_a: usize,
    /// Cells along its azimuth.
    pub n_b: usize,
    /// Radial scale of the chart in theta_h, radians: cells are even below, logarithmic above.
    pub r0: f64,
}

impl Default for InversionOptions {
    fn default() -> Self {
        Self {
            n_theta: 91,
            n_phi: 24,
            n_a: 64,
            n_b: 32,
            r0: 0.005,
        }
    }
}

/// Tabulated f cos per slice, sampled by inversion.
#[derive(Clone, Debug)]
pub struct Inversion {
    grid: KnownGrid,
    n_a: usize,
    n_b: usize,
    r0: f64,
    /// Cumulated masses per slice, n_a n_b + 1 entries from 0 to 1.
    cdf: Vec<f64>,
}

impl Inversion {
    /// Evaluates the target at 4 points of every cell of every slice; rayon over slices.
    #[must_use]
    pub fn new(target: Target<'_>, options: InversionOptions) -> Self {
        let n_phi = if target.symmetry.isotropic {
            1
        } else {
            options.n_phi
        };
        let grid = KnownGrid::new(options.n_theta, n_phi);
        let mut sampler = Self {
            grid,
            n_a: options.n_a.max(1),
            n_b: options.n_b.max(1),
            r0: options.r0.clamp(1e-4, 1.0),
            cdf: Vec::new(),
        };
        let slices: Vec<_> = (0..grid.len())
            .into_par_iter()
            .map(|k| sampler.slice_cdf(&target, k))
            .collect();
        sampler.cdf = slices.concat();
        sampler
    }

    fn cells(&self) -> usize {
        self.n_a * self.n_b
    }

    fn slice_cdf(&self, target: &Target<'_>, k: usize) -> Vec<f64> {
        let (theta, phi) = self.grid.angles(k);
        let (frame, viewer) = (ViewFrame::from_angles(theta, phi), self.grid.viewer(k));
        let chart = Chart::new(frame.sin_o, frame.cos_o, self.r0);
        let value = |ab| {
            let p = chart.forward(ab);
            target.f_cos(frame.to_world(p.wi), viewer) * p.jacobian()
        };
        let mut masses: Vec<f64> = (0..self.cells())
            .map(|cell| self.root_mean_square(cell, &value))
            .collect();
        let mean = masses.iter().sum::<f64>() / masses.len() as f64;
        if !(mean > 0.0 && mean.is_finite()) {
            // nothing reflects here: the cosine, which the chart represents as well as anything
            let cosine = |ab| {
                let p = chart.forward(ab);
                p.wi.z * p.jacobian()
            };
            for (cell, m) in masses.iter_mut().enumerate() {
                *m = self.root_mean_square(cell, &cosine);
            }
        } else {
            for m in &mut masses {
                *m = m.max(FLOOR * mean);
            }
        }
        cumulate(&masses)
    }

    fn root_mean_square(&self, cell: usize, value: &impl Fn(DVec2) -> f64) -> f64 {
        let corner = DVec2::new((cell / self.n_b) as f64, (cell % self.n_b) as f64);
        let size = DVec2::new(self.n_a as f64, self.n_b as f64);
        let mut sum = 0.0;
        for i in 0..POINTS * POINTS {
            let at = DVec2::new((i / POINTS) as f64 + 0.5, (i % POINTS) as f64 + 0.5);
            sum += value((corner + at / POINTS as f64) / size).powi(2);
        }
        (sum / (POINTS * POINTS) as f64).sqrt()
    }

    /// Blended cumulated mass below cell `index`.
    #[inline]
    fn below(&self, blend: &Blend, index: usize) -> f64 {
        let stride = self.cells() + 1;
        blend
            .iter()
            .map(|&(k, t)| t * self.cdf[k * stride + index])
            .sum()
    }

    /// The last of `n` intervals, each `step` cells long from `start`, that begins at or below `x`; and where in
    /// it `x` lies, [0, 1).
    fn invert(&self, blend: &Blend, start: usize, step: usize, n: usize, x: f64) -> (usize, f64) {
        let (mut low, mut high) = (0, n);
        while high - low > 1 {
            let mid = (low + high) / 2;
            if self.below(blend, start + mid * step) <= x {
                low = mid;
            } else {
                high = mid;
            }
        }
        let (l, h) = (
            self.below(blend, start + low * step),
            self.below(blend, start + (low + 1) * step),
        );
        (low, ((x - l) / (h - l)).clamp(0.0, 1.0 - f64::EPSILON))
    }

    /// Density on the unit square in the cell.
    fn cell_density(&self, blend: &Blend, i: usize, j: usize) -> f64 {
        let cell = i * self.n_b + j;
        (self.below(blend, cell + 1) - self.below(blend, cell)) * self.cells() as f64
    }
}

impl DirectionSampler for Inversion {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let (frame, blend) = (ViewFrame::new(wo), self.grid.blend(wo));
        let (i, a) = self.invert(&blend, 0, self.n_b, self.n_a, u.x);
        let start = i * self.n_b;
        let (l, h) = (
            self.below(&blend, start),
            self.below(&blend, start + self.n_b),
        );
        let (j, b) = self.invert(&blend, start, 1, self.n_b, l + u.y * (h - l));
        let ab = DVec2::new(
            (i as f64 + a) / self.n_a as f64,
            (j as f64 + b) / self.n_b as f64,
        );
        let p = Chart::new(frame.sin_o, frame.cos_o, self.r0).forward(ab);
        Some(DirectionSample {
            wi: frame.to_world(p.wi),
            pdf: self.cell_density(&blend, i, j) * p.density,
        })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let frame = ViewFrame::new(wo);
        let p = Chart::new(frame.sin_o, frame.cos_o, self.r0).inverse(frame.to_local(wi));
        let i = ((p.ab.x * self.n_a as f64) as usize).min(self.n_a - 1);
        let j = ((p.ab.y * self.n_b as f64) as usize).min(self.n_b - 1);
        self.cell_density(&self.grid.blend(wo), i, j) * p.density
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.cdf[..])
    }
}

/// 0, m0, m0 + m1, ... over the total; ends at exactly 1.
fn cumulate(masses: &[f64]) -> Vec<f64> {
    let total: f64 = masses.iter().sum();
    let mut cdf = Vec::with_capacity(masses.len() + 1);
    let mut sum = 0.0;
    cdf.push(0.0);
    for m in masses {
        sum += m / total;
        cdf.push(sum);
    }
    if let Some(last) = cdf.last_mut() {
        *last = 1.0;
    }
    cdf
}
