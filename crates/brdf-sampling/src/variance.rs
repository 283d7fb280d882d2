//! How noisy a sampler is: its relative variance for a viewer, by the sampler's own samples.

use crate::target::Target;
use brdf::{DirectionSampler, direction};
use glam::DVec3;
use sampling::Rng;

/// What [`relative_variance`] measures; w = f cos / pdf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeVariance {
    /// Var(w) / mean(w)^2 of one sample; 0 for a black target.
    pub value: f64,
    /// Standard error of `value`.
    pub std_error: f64,
    /// Estimate of the directional albedo, mean of w.
    pub albedo: f64,
    /// Largest w over its mean: the firefly factor of one bounce.
    pub max_weight: f64,
    /// Fraction of samples that carry nothing though they were drawn.
    pub wasted: f64,
}

/// Draws `n` independent samples for a viewer at `theta_deg` (azimuth 0).
#[must_use]
pub fn relative_variance(
    target: Target<'_>,
    sampler: &dyn DirectionSampler,
    theta_deg: f64,
    n: usize,
) -> RelativeVariance {
    let wo = direction(theta_deg.to_radians(), 0.0);
    relative_variance_for(target, sampler, wo, n)
}

/// Draws `n` independent samples for the viewer `wo`; the seed is a function of `wo`.
#[must_use]
pub fn relative_variance_for(
    target: Target<'_>,
    sampler: &dyn DirectionSampler,
    wo: DVec3,
    n: usize,
) -> RelativeVariance {
    let mut rng = Rng::new(wo.x.to_bits() ^ wo.y.to_bits().rotate_left(1));
    let (mut weights, mut wasted) = (Vec::with_capacity(n), 0);
    for _ in 0..n {
        let weight = match sampler.sample(wo, rng.uniform2()) {
            Some(s) if s.pdf > 0.0 => target.f_cos(s.wi, wo) / s.pdf,
            _ => {
                wasted += 1;
                0.0
            }
        };
        weights.push(weight);
    }
    let count = n.max(1) as f64;
    let albedo = weights.iter().sum::<f64>() / count;
    if albedo <= 0.0 {
        return RelativeVariance {
            value: 0.0,
            std_error: 0.0,
            albedo: 0.0,
            max_weight: 0.0,
            wasted: f64::from(wasted) / count,
        };
    }
    let squares = || weights.iter().map(|w| (w / albedo - 1.0).powi(2));
    let value = squares().sum::<f64>() / count;
    let fourth = squares().map(|q| (q - value).powi(2)).sum::<f64>() / count;
    RelativeVariance {
        value,
        std_error: (fourth / count).sqrt(),
        albedo,
        max_weight: weights.iter().fold(0.0, |m, w| w.max(m)) / albedo,
        wasted: f64::from(wasted) / count,
    }
}
