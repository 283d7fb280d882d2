//! Scatter that depends on direction cosines alone, f(|beta - beta0|), as optics describes polished surfaces
//! [Harvey1976], [Stover2012].
//!
//! beta = (wi.x, wi.y) and beta0 = (-wo.x, -wo.y), so that beta - beta0 is the horizontal part of wi + wo. A solid
//! angle times its cosine is an area of direction cosines: drawing beta with density f makes f cos/pdf constant.

use brdf::Brdf;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, PI, TAU};

use crate::lobe::{ONE_MINUS, SpecularLobe};
use crate::power_law::{ln_power, power_mass};

/// |beta - beta0|^2.
#[inline]
pub(crate) fn distance2(wi: DVec3, wo: DVec3) -> f64 {
    let (x, y) = (wi.x + wo.x, wi.y + wo.y);
    x * x + y * y
}

/// A density of the distance r from the mirror direction, per area of direction cosines, on the disc of radius 2, which
/// no pair of directions leaves.
pub(crate) trait Radial {
    /// The density at r^2.
    fn density(&self, r2: f64) -> f64;
    /// The distance below which a share `u` of it lies.
    fn radius(&self, u: f64) -> f64;
}

/// A lobe about the mirror direction in direction cosines: distributions that are equally likely, one for all channels or
/// one a channel.
pub(crate) struct ShiftedLobe<D, const K: usize>(pub(crate) [D; K]);

impl<D: Radial, const K: usize> ShiftedLobe<D, K> {
    /// A direction; it may lie below the horizon. Which distribution it is of is folded into `u.x`.
    #[inline]
    pub(crate) fn sample(&self, wo: DVec3, u: DVec2) -> DVec3 {
        let scaled = u.x * K as f64;
        let k = (scaled as usize).min(K - 1);
        let radius = self.0[k].radius((scaled - k as f64).min(ONE_MINUS));
        direction_at(wo, radius, u.y)
    }

    /// Density of [`Self::sample`], 1/sr.
    #[inline]
    pub(crate) fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        let r2 = distance2(wi, wo);
        let sum: f64 = self.0.iter().map(|d| d.density(r2)).sum();
        sum / K as f64 * wi.z
    }
}

/// The direction at distance `r` from the mirror direction, at the azimuth 2 pi `u`; below the horizon (pointing
/// straight down) where the direction cosines leave the unit disc.
#[inline]
fn direction_at(wo: DVec3, r: f64, u: f64) -> DVec3 {
    let (sin, cos) = (TAU * u).sin_cos();
    let (x, y) = (r * cos - wo.x, r * sin - wo.y);
    let z2 = 1.0 - x * x - y * y;
    if z2 > 0.0 {
        DVec3::new(x, y, z2.sqrt())
    } else {
        DVec3::NEG_Z
    }
}

/// The density of shape (1 + (r/l)^2)^(s/2).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PowerDisc {
    /// Shoulder l.
    pub(crate) shoulder: f64,
    /// Slope s.
    pub(crate) slope: f64,
}

impl PowerDisc {
    /// The integral of (1 + (r/l)^2)^(s/2) over the disc of `radius`.
    #[inline]
    pub(crate) fn mass(&self, radius: f64) -> f64 {
        let l = self.shoulder;
        let span = (radius / l).powi(2).ln_1p();
        PI * l * l * power_mass(0.5 * self.slope + 1.0, span)
    }

    /// (1 + (r/l)^2)^(s/2) from r^2.
    #[inline]
    pub(crate) fn shape(&self, r2: f64) -> f64 {
        (0.5 * self.slope * (r2 / (self.shoulder * self.shoulder)).ln_1p()).exp()
    }
}

impl Radial for PowerDisc {
    #[inline]
    fn density(&self, r2: f64) -> f64 {
        self.shape(r2) / self.mass(2.0)
    }

    #[inline]
    fn radius(&self, u: f64) -> f64 {
        let span = (2.0 / self.shoulder).powi(2).ln_1p();
        let ln = ln_power(u, 0.5 * self.slope + 1.0, span);
        self.shoulder * ln.exp_m1().max(0.0).sqrt()
    }
}

/// Points of a Fibonacci lattice and its generator, neighbours in Fibonacci's sequence: no edge, straight in the
/// sampler's numbers or not, meets many of them at once [Niederreiter1992].
const LATTICE: (u32, u64) = (46_368, 28_657);

/// The share of light from `wo` that the lobe of `model` over Lambert's `diffuse` scatters into the hemisphere, per
/// channel, by the model's own sampler, whose weights are nearly constant. About 1e-4 of the value.
pub(crate) fn total_integrated_scatter<const N: usize>(
    model: &(impl Brdf<N> + SpecularLobe),
    diffuse: &[f64; N],
    wo: DVec3,
) -> [f64; N] {
    let (points, generator) = LATTICE;
    let mut sum = [0.0; N];
    for k in 0..points {
        let turns = u64::from(k) * generator % u64::from(points);
        let u = DVec2::new(f64::from(k) + 0.5, turns as f64) / f64::from(points);
        let wi = model.sample_lobe(wo, u);
        if wi.z > 0.0 {
            let scale = wi.z / model.lobe_pdf(wi, wo);
            let f = model.eval(wi, wo);
            for c in 0..N {
                sum[c] += (f[c] - diffuse[c] * FRAC_1_PI) * scale;
            }
        }
    }
    sum.map(|s| s / f64::from(points))
}
