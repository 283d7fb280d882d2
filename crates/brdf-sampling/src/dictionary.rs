//! Mixtures of GGX lobes and a cosine: a few hundred bytes, and the yardstick for tables.
//!
//! Lobes are sampled by their visible normals (spherical caps [DupuyBenyoub2023]), which reflects some samples below
//! the horizon: those are lost (`None`). Weights are given at slices of the viewer's elevation and blend
//! linearly; they minimise the variance, by the multiplicative updates of the half-vector table.

use crate::cosine::{cosine_hemisphere, cosine_pdf};
use crate::hvt::Validation;
use crate::hvt::slice_blend;
use crate::known_grid::ViewFrame;
use crate::target::Target;
use brdf::{DirectionSample, DirectionSampler};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Roughnesses of the full dictionary.
const ALPHAS: [f32; 10] = [0.003, 0.008, 0.02, 0.04, 0.07, 0.12, 0.2, 0.33, 0.55, 0.9];
/// Slices of the viewer's elevation.
const SLICES: usize = 8;
/// Multiplicative updates of the weights.
const UPDATES: usize = 60;
/// Lowest weight of the cosine: support everywhere.
const COSINE_FLOOR: f32 = 1e-3;

/// A mixture of GGX lobes and a cosine with weights by viewer elevation.
#[derive(Clone, Debug)]
pub struct Dictionary {
    alphas: Vec<f32>,
    /// Per slice: the cosine, then the lobes; sums to 1.
    weights: Vec<f32>,
}

impl Dictionary {
    /// Ten lobes, 392 bytes.
    #[must_use]
    pub fn new(target: Target<'_>) -> Self {
        Self::fitted(&Validation::new(&target), &ALPHAS)
    }

    /// The best single lobe and the cosine.
    #[must_use]
    pub fn single(target: Target<'_>) -> Self {
        let points = Validation::new(&target);
        let candidates = ALPHAS.iter().map(|a| Self::fitted(&points, &[*a]));
        let cost = |d: Self| (points.variance(&d), d);
        let best = candidates.map(cost).min_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or_else(|| Self::fitted(&points, &[0.3]), |b| b.1)
    }

    fn fitted(points: &Validation, alphas: &[f32]) -> Self {
        let lobes = alphas.len() + 1;
        let mut mixture = Self {
            alphas: alphas.to_vec(),
            weights: vec![1.0 / lobes as f32; SLICES * lobes],
        };
        for _ in 0..UPDATES {
            let mut gain = vec![0.0; mixture.weights.len()];
            points.for_each(|wi, wo, cost| {
                let (k, t) = slice_blend(wo, SLICES);
                let p = mixture.pdf(wi, wo);
                for c in 0..lobes {
                    let g = cost * mixture.lobe_pdf(c, wi, wo) / (p * p);
                    gain[k * lobes + c] += (1.0 - t) * g;
                    gain[(k + 1) * lobes + c] += t * g;
                }
            });
            mixture.update(&gain);
        }
        mixture
    }

    /// w <- w sqrt(gain), floors, sum 1; slices that see nothing become the cosine.
    fn update(&mut self, gain: &[f64]) {
        let lobes = self.alphas.len() + 1;
        for (weights, gain) in self
            .weights
            .chunks_exact_mut(lobes)
            .zip(gain.chunks_exact(lobes))
        {
            let new: Vec<f64> = weights
                .iter()
                .zip(gain)
                .map(|(w, g)| f64::from(*w) * g.sqrt())
                .collect();
            let sum: f64 = new.iter().sum();
            if !(sum > 0.0 && sum.is_finite()) {
                weights.fill(0.0);
                weights[0] = 1.0;
                continue;
            }
            for (w, n) in weights.iter_mut().zip(&new) {
                *w = (n / sum) as f32;
            }
            weights[0] = weights[0].max(COSINE_FLOOR);
            let sum: f32 = weights.iter().sum();
            weights.iter_mut().for_each(|w| *w /= sum);
        }
    }

    /// Weight of component `c` for the viewer.
    fn weight(&self, c: usize, (k, t): (usize, f64)) -> f64 {
        let lobes = self.alphas.len() + 1;
        let at = |k: usize| f64::from(self.weights[k * lobes + c]);
        (1.0 - t) * at(k) + t * at(k + 1)
    }

    fn lobe_pdf(&self, c: usize, wi: DVec3, wo: DVec3) -> f64 {
        match c.checked_sub(1) {
            None => cosine_pdf(wi),
            Some(k) => ggx_pdf(f64::from(self.alphas[k]), wi, wo),
        }
    }
}

impl DirectionSampler for Dictionary {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let place = slice_blend(wo, SLICES);
        let (mut x, mut c, mut w) = (u.x, 0, self.weight(0, place));
        while x >= w && c < self.alphas.len() {
            x -= w;
            c += 1;
            w = self.weight(c, place);
        }
        let u = DVec2::new((x / w).clamp(0.0, 1.0 - f64::EPSILON), u.y);
        let wi = match c.checked_sub(1) {
            None => cosine_hemisphere(u),
            Some(k) => ggx_sample(f64::from(self.alphas[k]), wo, u),
        };
        let pdf = self.pdf(wi, wo);
        (wi.z > 0.0 && pdf > 0.0).then_some(DirectionSample { wi, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let place = slice_blend(wo, SLICES);
        (0..=self.alphas.len())
            .map(|c| self.weight(c, place) * self.lobe_pdf(c, wi, wo))
            .sum()
    }

    fn bytes(&self) -> usize {
        size_of::<f32>() * (self.alphas.len() + self.weights.len())
    }
}

/// Density of reflecting about a visible GGX normal [Heitz2018]: D G1(wo) / (4 cos theta_o).
fn ggx_pdf(alpha: f64, wi: DVec3, wo: DVec3) -> f64 {
    let h = wi + wo;
    let a2 = alpha * alpha;
    // scale-free in h: D = |h|^4 / (pi a^2 (h_xy^2 / a^2 + h_z^2)^2)
    let q = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
    let d = h.length_squared().powi(2) / (PI * a2 * q * q);
    // G1 / cos theta_o = 2 / (cos + sqrt(cos^2 + a^2 sin^2))
    let stretched = (wo.z * wo.z + a2 * (wo.x * wo.x + wo.y * wo.y)).sqrt();
    d * 0.5 / (wo.z + stretched)
}

/// Reflects `wo` about a visible normal of the GGX distribution, by a spherical cap of the stretched sphere.
fn ggx_sample(alpha: f64, wo: DVec3, u: DVec2) -> DVec3 {
    let view = ViewFrame::new(wo);
    let local = DVec3::new(view.sin_o, 0.0, view.cos_o);
    let stretched = DVec3::new(alpha * local.x, 0.0, local.z).normalize();
    let z = (1.0 - u.x) * (1.0 + stretched.z) - stretched.z;
    let s = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = (TAU * u.y).sin_cos();
    let cap = DVec3::new(s * cos, s * sin, z) + stretched;
    let h = DVec3::new(alpha * cap.x, alpha * cap.y, cap.z.max(1e-12)).normalize();
    view.to_world(2.0 * local.dot(h) * h - local)
}
