//! Pieces samplers share: the cosine lobe, cosine-power lobes about an axis, and mixtures of a specular
//! lobe with a diffuse one that spend a single pair of numbers.

use brdf::DirectionSample;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, TAU};

use crate::half::{MIN_COS, above};

/// Cosine-distributed direction, polar map: the same map as [`crate::lanes::cosine`], so that scalar and
/// packet samples coincide.
#[inline]
pub(crate) fn cosine(u: DVec2) -> DVec3 {
    let (sin_phi, cos_phi) = (TAU * u.y).sin_cos();
    let r = u.x.sqrt();
    DVec3::new(r * cos_phi, r * sin_phi, (1.0 - u.x).sqrt())
}

/// Density of [`cosine`].
#[inline]
pub(crate) fn cosine_pdf(wi: DVec3) -> f64 {
    wi.z.max(0.0) * FRAC_1_PI
}

/// c^n for c = the cosine between two unit vectors. Where they are close it comes from their difference, so that
/// n = 1e6 keeps its digits: c = 1 - |a - b|^2 / 2 and c^n = exp(n ln(1 - ...)); where they are nearly at right angles
/// that would cancel, and the product keeps them.
#[inline]
pub(crate) fn cos_power(a: DVec3, b: DVec3, n: f64) -> f64 {
    let c = a.dot(b);
    if c <= 0.0 {
        return 0.0;
    }
    let ln = if c > 0.5 {
        (-0.5 * (a - b).length_squared()).ln_1p()
    } else {
        c.ln()
    };
    (n * ln).exp()
}

/// Direction about the unit vector `axis`, with density (n+1)/(2 pi) cos^n on the sphere around it.
#[inline]
pub(crate) fn power_lobe(axis: DVec3, n: f64, u: DVec2) -> DVec3 {
    // cos = (1-u)^(1/(n+1)); 1 - cos through expm1 keeps narrow lobes exact
    let one_minus_cos = -((-u.x).ln_1p() / (n + 1.0)).exp_m1();
    let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
    let (sin_phi, cos_phi) = (TAU * u.y).sin_cos();
    let (x, y) = axis.any_orthonormal_pair();
    sin * cos_phi * x + sin * sin_phi * y + (1.0 - one_minus_cos) * axis
}

/// Density of [`power_lobe`].
#[inline]
pub(crate) fn power_lobe_pdf(axis: DVec3, n: f64, w: DVec3) -> f64 {
    (n + 1.0) / TAU * cos_power(axis, w, n)
}

/// A specular lobe that is sampled together with a cosine lobe.
pub(crate) trait SpecularLobe {
    /// Probability of the specular lobe for this viewer.
    fn probability(&self, wo: DVec3) -> f64;
    /// A direction of the specular lobe; it may lie below the horizon.
    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3;
    /// Density of [`Self::sample_lobe`]; both directions are above the horizon.
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64;

    /// Samples the mixture. The choice is folded into `u.x`, whose two parts stay stratified.
    #[inline]
    fn sample_mixture(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= MIN_COS {
            return None;
        }
        let p = self.probability(wo);
        let wi = if u.x < p {
            self.sample_lobe(wo, DVec2::new((u.x / p).min(ONE_MINUS), u.y))
        } else {
            cosine(DVec2::new(((u.x - p) / (1.0 - p)).min(ONE_MINUS), u.y))
        };
        let pdf = self.mixture_pdf(wi, wo);
        (pdf > 0.0).then_some(DirectionSample { wi, pdf })
    }

    /// Density of [`Self::sample_mixture`].
    #[inline]
    fn mixture_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if !above(wi, wo) {
            return 0.0;
        }
        let p = self.probability(wo);
        // a lobe of no weight is not evaluated: its density may be costly
        let specular = if p > 0.0 {
            p * self.lobe_pdf(wi, wo)
        } else {
            0.0
        };
        specular + (1.0 - p) * cosine_pdf(wi)
    }
}

/// Largest number below 1.
pub(crate) const ONE_MINUS: f64 = 1.0 - f64::EPSILON / 2.0;

/// Share of the specular lobe when the lobes carry `specular` and `diffuse` energy per channel.
#[inline]
pub(crate) fn share<const N: usize>(specular: &[f64; N], diffuse: &[f64; N]) -> f64 {
    let s: f64 = specular.iter().sum();
    let d: f64 = diffuse.iter().sum();
    if s + d > 0.0 { s / (s + d) } else { 0.0 }
}

/// `diffuse / pi + specular * lobe`, channel by channel.
#[inline]
pub(crate) fn combine<const N: usize>(
    diffuse: &[f64; N],
    specular: &[f64; N],
    lobe: f64,
) -> [f64; N] {
    std::array::from_fn(|c| diffuse[c] * FRAC_1_PI + specular[c] * lobe)
}
