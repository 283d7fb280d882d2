//! How reflection rises toward grazing beyond the last rows: Schlick's curve, fitted to the rise before them.

use crate::scattered::cloud::Geometry;
use crate::scattered::domain::{Domain, Place};
use brdf::HalfDiff;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Angles theta_h between which the rise is interpolated, every 5 degrees.
const BANDS: usize = 19;
/// Azimuths phi_d at which it is measured.
const AZIMUTHS: u32 = 8;
/// How far apart, in radians, the surface is measured along theta_d.
const STEP: f64 = 0.05;
/// How far back from the edge it is measured, in radians: beyond, little of the rise is left.
const REACH: f64 = 0.4;
/// Largest s: reflectance at normal incidence below which no coating lies is F0 = 0.04.
const MOST: f64 = 0.96 / 0.04;
/// Weight of the belief in no rise, as the square of a difference of logs.
const PRIOR: f64 = 0.01;

/// F / F_edge = (1 + s q) / (1 + s q_edge) with q = (1 - cos theta_d)^5 and s = (1 - F0) / F0 after [Schlick1994],
/// s a continuous function of theta_h.
#[derive(Clone, Debug)]
pub(crate) struct Rise {
    /// s at theta_h of 0, 5, ... 90 degrees, in [0, [`MOST`]].
    strength: [f64; BANDS],
}

impl Rise {
    /// Fitted to the log of the luminance, `log_size`, on paths of constant theta_h and phi_d that end at the edge.
    ///
    /// One s a band, for all azimuths, with a preference for no rise: where the paths end far from grazing they say
    /// nothing about it, and noise must not. Neighbouring bands are averaged.
    pub(crate) fn fit(domain: &Domain, log_size: impl Fn(HalfDiff) -> f64 + Sync) -> Self {
        let raw: Vec<f64> = (0..BANDS)
            .into_par_iter()
            .map(|band| strength(&band_samples(band, domain, &log_size)))
            .collect();
        let at = |band: usize| raw[band.min(BANDS - 1)];
        Self {
            strength: std::array::from_fn(|b| {
                0.25 * (at(b.saturating_sub(1)) + 2.0 * at(b) + at(b + 1))
            }),
        }
    }

    /// F at `to` over F at `from`, both theta_d, at least 1; `growth` scales s.
    pub(crate) fn factor(&self, theta_h: f64, from: f64, to: f64, growth: f64) -> f64 {
        let x = (theta_h / FRAC_PI_2).clamp(0.0, 1.0) * (BANDS - 1) as f64;
        let band = (x as usize).min(BANDS - 2);
        let t = x - band as f64;
        let s = growth * (self.strength[band] * (1.0 - t) + self.strength[band + 1] * t);
        ((1.0 + s * schlick(to)) / (1.0 + s * schlick(from))).max(1.0)
    }
}

/// What Schlick's approximation adds to F0, as a part of 1 - F0.
fn schlick(theta_d: f64) -> f64 {
    (1.0 - theta_d.cos()).powi(5)
}

/// A point before the edge.
struct Sample {
    /// ln f less its value at the edge.
    log: f64,
    q: f64,
    q_edge: f64,
}

/// The last [`REACH`] of every path of a band.
fn band_samples(band: usize, domain: &Domain, log_size: &impl Fn(HalfDiff) -> f64) -> Vec<Sample> {
    let mut samples = Vec::new();
    for azimuth in 0..AZIMUTHS {
        let at = |theta_d: f64| HalfDiff {
            theta_h: FRAC_PI_2 * band as f64 / (BANDS - 1) as f64,
            theta_d,
            phi_d: PI * (f64::from(azimuth) + 0.5) / f64::from(AZIMUTHS),
        };
        let inside = |&theta_d: &f64| {
            let (wi, wo) = at(theta_d).directions();
            domain.place(Geometry::new(wi, wo), at(theta_d)) == Place::Inside
        };
        let mut path = (0..)
            .map(|k| FRAC_PI_2 - STEP * f64::from(k))
            .take_while(|&theta_d| theta_d >= 0.0)
            .skip_while(|theta_d| !inside(theta_d));
        let Some(edge) = path.next() else { continue };
        let (log_edge, q_edge) = (log_size(at(edge)), schlick(edge));
        let before = path
            .take_while(|&theta_d| theta_d > edge - REACH)
            .filter(inside);
        samples.extend(before.map(|theta_d| Sample {
            log: log_size(at(theta_d)) - log_edge,
            q: schlick(theta_d),
            q_edge,
        }));
    }
    samples
}

/// The s that fits best, by golden section over ln(1 + s).
fn strength(samples: &[Sample]) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let most = MOST.ln_1p();
    let cost = |x: f64| {
        let s = x.exp_m1();
        let error = |p: &Sample| (p.log - ((1.0 + s * p.q) / (1.0 + s * p.q_edge)).ln()).powi(2);
        let count = samples.len().max(1) as f64;
        samples.iter().map(error).sum::<f64>() / count + PRIOR * (x / most).powi(2)
    };
    let (mut low, mut high) = (0.0, most);
    for _ in 0..30 {
        let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if cost(a) <= cost(b) {
            high = b;
        } else {
            low = a;
        }
    }
    (0.5 * (low + high)).exp_m1()
}
