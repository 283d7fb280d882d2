//! Points that no table was optimised for: they choose the chart.
//!
//! A table only sees the target at its own cells, and too coarse a chart does not see what it misses. So
//! candidates are compared on one common set of points, fine in theta_h at every scale.

use super::lane_chart::{Points, Views, forward};
use crate::lane_math::{F, ZERO};
use crate::target::Target;
use brdf::{DirectionSampler, LANES, Lanes3, direction};
use glam::DVec3;
use pulp::{Simd, WithSimd};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Radial scale of the points' own chart.
const R0: f32 = 5e-4;
/// Points along a and b: together a multiple of [`LANES`].
const POINTS: [usize; 2] = [160, 12];
/// Viewers, degrees.
const THETA_DEG: [f64; 6] = [4.0, 26.0, 47.0, 66.0, 79.0, 86.0];

/// The golden section: its multiples fill an interval evenly.
const GOLDEN: f64 = 0.618_033_988_75;

/// Points: directions, f cos, and the solid angle each stands for.
struct Packet {
    wi: Lanes3,
    f_cos: [f64; LANES],
    area: F,
}

/// The points of one viewer.
struct View {
    wo: Lanes3,
    packets: Vec<Packet>,
}

/// The points of all viewers.
pub(crate) struct Validation {
    views: Vec<View>,
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
            brdf::arch().dispatch(Sampled(target, direction(deg.to_radians(), TAU * turns)))
        };
        Self {
            views: THETA_DEG.par_iter().enumerate().map(view).collect(),
        }
    }

    /// Calls `f(wi, wo, g^2 area / (int g)^2)` for every point with g > 0.
    pub(crate) fn for_each(&self, mut f: impl FnMut(DVec3, DVec3, f64)) {
        for View { wo, packets } in &self.views {
            let first: f64 = packets.iter().map(Packet::integral).sum();
            for p in packets {
                for k in (0..LANES).filter(|k| p.f_cos[*k] > 0.0) {
                    let (wi, wo) = (p.wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                    let second = p.f_cos[k] * p.f_cos[k] * f64::from(p.area[k]);
                    f(wi, wo, second / (first * first));
                }
            }
        }
    }

    /// Mean relative variance of a sampler: int g^2/p / (int g)^2 - 1 by quadrature.
    pub(crate) fn variance(&self, sampler: &impl DirectionSampler) -> f64 {
        let parts = self.views.iter().map(|v| {
            let first: f64 = v.packets.iter().map(Packet::integral).sum();
            let second = brdf::arch().dispatch(Second(v, sampler));
            (first > 0.0).then(|| second / (first * first) - 1.0)
        });
        let (sum, count) = (parts.flatten()).fold((0.0, 0.0), |(s, n), part| (s + part, n + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    }
}

impl Packet {
    /// int g over its points.
    fn integral(&self) -> f64 {
        let points = self.f_cos.iter().zip(&self.area);
        points.map(|(f, area)| f * f64::from(*area)).sum()
    }
}

/// The points of a viewer.
struct Sampled<'a>(&'a Target<'a>, DVec3);

impl WithSimd for Sampled<'_> {
    type Output = View;

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) -> View {
        let Self(target, direction) = self;
        let (mut wo, [n, m]) = (Lanes3::ZERO, POINTS);
        for k in 0..LANES {
            wo.set(k, direction.as_vec3());
        }
        let scale2 = [R0 * R0, 1.0 / (R0 * R0)];
        let views = Views::new(&wo, scale2);
        let packets = (0..n * m).step_by(LANES).map(|first| {
            let mut points = Points {
                a: ZERO,
                b: ZERO,
                jacobian: ZERO,
            };
            for k in 0..LANES {
                let (i, j) = ((first + k) / m, (first + k) % m);
                // rows are shifted against each other by the golden section
                let shift = (i as f64 * GOLDEN).fract();
                points.a[k] = (i as f32 + 0.5) / n as f32;
                points.b[k] = ((j as f64 + shift) / m as f64) as f32;
            }
            let wi = forward(&views, scale2, &mut points);
            let mut area = ZERO;
            for k in 0..LANES {
                area[k] = points.jacobian[k] / (n * m) as f32;
            }
            let f_cos = target.f_cos_lanes(&wi, &wo);
            Packet { wi, f_cos, area }
        });
        let packets = packets.collect();
        View { wo, packets }
    }
}

/// int g^2/p for a viewer.
struct Second<'a, S>(&'a View, &'a S);

impl<S: DirectionSampler> WithSimd for Second<'_, S> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) -> f64 {
        let Self(View { wo, packets }, sampler) = self;
        let mut sum = 0.0;
        for p in packets {
            let pdf = sampler.pdf_lanes(&p.wi, wo);
            for k in 0..LANES {
                let square = p.f_cos[k] * p.f_cos[k] * f64::from(p.area[k]);
                let part = square / f64::from(pdf[k]);
                sum += if square > 0.0 { part } else { 0.0 };
            }
        }
        sum
    }
}
