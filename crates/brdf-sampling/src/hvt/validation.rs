//! Points that no table was optimised for: they choose the chart.
//!
//! A table only sees the target at its own cells, and too coarse a chart does not see what it misses. So
//! candidates are compared on one common set of points, fine in theta_h at every scale.

use crate::chart::Chart;
use crate::known_grid::ViewFrame;
use crate::target::Target;
use brdf::{DirectionSampler, direction};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Radial scale of the points' own chart.
const R0: f64 = 5e-4;
/// Points along a and b.
const POINTS: [usize; 2] = [160, 12];
/// Viewers, degrees.
const THETA_DEG: [f64; 6] = [4.0, 26.0, 47.0, 66.0, 79.0, 86.0];

/// The golden section: its multiples fill an interval evenly.
const GOLDEN: f64 = 0.618_033_988_75;

/// A point: direction, f cos, and the solid angle it stands for.
struct Point {
    wi: DVec3,
    f_cos: f64,
    area: f64,
}

/// The points of all viewers that see anything.
pub(crate) struct Validation {
    views: Vec<(DVec3, Vec<Point>)>,
}

impl Validation {
    /// Evaluates the target at some 10^4 points.
    pub(crate) fn new(target: &Target<'_>) -> Self {
        let view = |(n, deg): (usize, &f64)| {
            // azimuths by the golden section, where they matter
            let turns = if target.symmetry.isotropic {
                0.0
            } else {
                n as f64 * GOLDEN
            };
            let wo = direction(deg.to_radians(), TAU * turns);
            let frame = ViewFrame::new(wo);
            let chart = Chart::new(frame.sin_o, frame.cos_o, R0);
            let [n, m] = POINTS;
            let points = (0..n * m).map(|k| {
                let (i, j) = (k / m, k % m);
                // rows are shifted against each other by the golden section
                let shift = (i as f64 * GOLDEN).fract();
                let ab = DVec2::new((i as f64 + 0.5) / n as f64, (j as f64 + shift) / m as f64);
                let p = chart.forward(ab);
                let wi = frame.to_world(p.wi);
                Point {
                    wi,
                    f_cos: target.f_cos(wi, wo),
                    area: p.jacobian() / (n * m) as f64,
                }
            });
            (wo, points.collect::<Vec<_>>())
        };
        Self {
            views: THETA_DEG.par_iter().enumerate().map(view).collect(),
        }
    }

    /// Calls `f(wi, wo, g^2 area / (int g)^2)` for every point with g > 0.
    pub(crate) fn for_each(&self, mut f: impl FnMut(DVec3, DVec3, f64)) {
        for (wo, points) in &self.views {
            let first: f64 = points.iter().map(|p| p.f_cos * p.area).sum();
            for p in points.iter().filter(|p| p.f_cos > 0.0) {
                f(p.wi, *wo, p.f_cos * p.f_cos * p.area / (first * first));
            }
        }
    }

    /// Mean relative variance of a sampler: int g^2/p / (int g)^2 - 1 by quadrature.
    pub(crate) fn variance(&self, sampler: &impl DirectionSampler) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (wo, points) in &self.views {
            let (mut first, mut second) = (0.0, 0.0);
            for p in points.iter().filter(|p| p.f_cos > 0.0) {
                first += p.f_cos * p.area;
                second += p.f_cos * p.f_cos * p.area / sampler.pdf(p.wi, *wo);
            }
            if first > 0.0 {
                sum += second / (first * first) - 1.0;
                count += 1.0;
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }
}
