//! What pbrt and Mitsuba can both express: a mixture of a diffuse and a rough metal.

use super::error;
use crate::Fit;
use crate::metric::Metric;
use crate::samples::Samples;
use brdf::Brdf;
use brdf_models::{Fresnel, Ggx};
use glam::DVec3;

/// How masking of light and viewer are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shadowing {
    /// 1/(1 + L(wi) + L(wo)), height-correlated [Heitz2014]: pbrt.
    Correlated,
    /// G1(wi) G1(wo) [Walter2007]: Mitsuba.
    Separable,
}

/// (1 - amount) diffuse/pi + amount times a GGX metal of index 1 + ik with this reflectance at normal incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetalMix {
    /// Share of the metal, (0, 1).
    pub amount: f64,
    /// Albedo of the diffuse part.
    pub diffuse: [f64; 3],
    /// Reflectance of the metal at normal incidence.
    pub reflectance: [f64; 3],
    /// Roughness.
    pub alpha: f64,
    /// The renderer's masking.
    pub shadowing: Shadowing,
}

/// Shares of the metal tried: the smaller, the steeper its reflectance rises toward grazing angles.
const AMOUNTS: usize = 48;
/// Largest reflectance of a metal of index 1 + ik with finite k worth the name.
const BRIGHTEST: f64 = 0.999;

impl MetalMix {
    /// The mixture nearest to a GGX fit, and its error: the roughness and what it reflects at normal incidence are kept,
    /// the share of the metal decides how that rises.
    #[must_use]
    pub fn nearest(
        ggx: &Fit,
        samples: &Samples,
        metric: Metric,
        shadowing: Shadowing,
    ) -> (Self, f64) {
        let (alpha, f0) = (ggx.shape[0], ggx.shape[1]);
        let channel = |c: usize| ggx.weights.get(c).map_or((0.0, 0.0), |w| (w[0], w[1]));
        let diffuse: [f64; 3] = std::array::from_fn(|c| channel(c).0);
        let specular: [f64; 3] = std::array::from_fn(|c| channel(c).1 * f0);
        let mix = |amount: f64| Self {
            amount,
            diffuse: diffuse.map(|d| (d / (1.0 - amount)).min(1.0)),
            reflectance: specular.map(|s| (s / amount).min(BRIGHTEST)),
            alpha,
            shadowing,
        };
        // from 1e-4 to 1 - 1e-4, close together at both ends
        let tried = (0..AMOUNTS).map(|k| {
            let u = 9.2 * (2.0 * (k as f64 + 0.5) / AMOUNTS as f64 - 1.0);
            let mix = mix(1.0 / (1.0 + (-u).exp()));
            (mix, error(&mix, samples, metric))
        });
        let best = tried.min_by(|a, b| a.1.total_cmp(&b.1));
        best.unwrap_or_else(|| (mix(0.5), f64::INFINITY))
    }

    /// k of the metal of index 1 + ik: reflectance k^2/(4 + k^2) at normal incidence.
    #[must_use]
    pub fn extinction(&self) -> [f64; 3] {
        self.reflectance.map(|r| 2.0 * (r / (1.0 - r)).sqrt())
    }
}

impl Brdf<3> for MetalMix {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return [0.0; 3];
        }
        let ggx = Ggx {
            alpha_x: self.alpha,
            alpha_y: self.alpha,
            fresnel: Fresnel::from_index([1.0; 3], self.extinction()),
            specular: [self.amount; 3],
            diffuse: [0.0; 3],
        };
        let mut f = ggx.eval(wi, wo);
        if self.shadowing == Shadowing::Separable {
            // L = (s/cos - 1)/2 with s = |(a x, a y, z)|
            let lambda = |w: DVec3| {
                let s = (self.alpha * w.x).hypot(self.alpha * w.y).hypot(w.z);
                0.5 * (s / w.z - 1.0)
            };
            let (i, o) = (lambda(wi), lambda(wo));
            let ratio = (1.0 + i + o) / ((1.0 + i) * (1.0 + o));
            f = f.map(|f| f * ratio);
        }
        let base = (1.0 - self.amount) * std::f64::consts::FRAC_1_PI;
        std::array::from_fn(|c| f[c] + base * self.diffuse[c])
    }
}
