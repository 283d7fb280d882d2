//! The data of a fit: pairs of directions with their solid angles and the reflectance measured there.

use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::{FitError, Metric};

/// Pairs of directions, weights and values, in the order given.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    channels: usize,
    pairs: Vec<Pair>,
    values: Vec<f64>,
}

/// Two directions and the solid angles they stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Toward the light.
    pub wi: DVec3,
    /// Toward the viewer.
    pub wo: DVec3,
    /// dwi dwo in sr^2 (any common factor is as good).
    pub weight: f64,
}

impl Samples {
    /// No data yet, of so many channels (at least one).
    #[must_use]
    pub fn new(channels: usize) -> Self {
        Self {
            channels: channels.max(1),
            pairs: Vec::new(),
            values: Vec::new(),
        }
    }

    /// Adds a pair with its value per channel, f_r in 1/sr. Pairs at or below the horizon, of no weight or with values
    /// that are not finite are left out.
    ///
    /// # Panics
    /// If `values` is not as long as there are channels.
    pub fn push(&mut self, pair: Pair, values: &[f64]) {
        assert_eq!(values.len(), self.channels, "one value a channel");
        let usable = pair.wi.z > 0.0
            && pair.wo.z > 0.0
            && pair.weight > 0.0
            && pair.weight.is_finite()
            && values.iter().all(|v| v.is_finite());
        if usable {
            self.pairs.push(pair);
            self.values.extend_from_slice(values);
        }
    }

    /// Evaluates at the centres of the cells of MERL's grid (theta_h quadratic, theta_d and phi_d in [0, pi) uniform,
    /// [Matusik2003]) of `dims` cells, with the exact solid angles of the cells.
    ///
    /// `f` writes the reflectance and says whether it was measured there; other cells are left out.
    pub fn on_grid(
        dims: [usize; 3],
        channels: usize,
        f: impl Fn(DVec3, DVec3, &mut [f64]) -> bool + Sync,
    ) -> Self {
        let [n_h, n_d, n_p] = dims;
        let slabs: Vec<Self> = (0..n_h)
            .into_par_iter()
            .map(|h| {
                let mut slab = Self::new(channels);
                let mut out = vec![0.0; slab.channels];
                for d in 0..n_d {
                    for p in 0..n_p {
                        let (angles, weight) = cell([h, d, p], dims);
                        let (wi, wo) = angles.directions();
                        if wi.z > 0.0 && wo.z > 0.0 && f(wi, wo, &mut out) {
                            slab.push(Pair { wi, wo, weight }, &out);
                        }
                    }
                }
                slab
            })
            .collect();
        let mut all = Self::new(channels);
        for slab in slabs {
            all.pairs.extend(slab.pairs);
            all.values.extend(slab.values);
        }
        all
    }

    /// Without the pairs of which either direction is further than `theta_deg` from the normal, as in [Ngan2005].
    #[must_use]
    pub fn within(&self, theta_deg: f64) -> Self {
        let lowest = theta_deg.to_radians().cos();
        let mut kept = Self::new(self.channels);
        for (pair, values) in self.iter() {
            if pair.wi.z >= lowest && pair.wo.z >= lowest {
                kept.push(*pair, values);
            }
        }
        kept
    }

    /// About `count` pairs, drawn by how much they can say under `metric` mixed half and half with their weight, and
    /// re-weighted so that sums keep their expectation. Systematic sampling in storage order: no random numbers, and
    /// cells that stay together are spread evenly.
    #[must_use]
    pub fn subset(&self, metric: Metric, count: usize) -> Self {
        if count >= self.len() {
            return self.clone();
        }
        let (mut plain, mut telling) = (Vec::new(), Vec::new());
        for (pair, values) in self.iter() {
            let w = pair.weight * metric.measure(pair.wi.z, pair.wo.z);
            let mean: f64 = values
                .iter()
                .map(|y| metric.importance(*y, pair.wi.z))
                .sum();
            plain.push(w);
            telling.push(w * mean);
        }
        let share = |v: &[f64]| 0.5 / v.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        let (a, b) = (share(&plain), share(&telling));
        let mut kept = Self::new(self.channels);
        let (mut position, mut next) = (0.0, 0.5);
        for (k, (pair, values)) in self.iter().enumerate() {
            let expected = count as f64 * (a * plain[k] + b * telling[k]);
            position += expected;
            let mut hits = 0;
            while position > next {
                hits += 1;
                next += 1.0;
            }
            if hits > 0 {
                let weight = pair.weight * f64::from(hits) / expected;
                kept.push(Pair { weight, ..*pair }, values);
            }
        }
        kept
    }

    /// How many pairs.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Channels of every value.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// The pairs.
    #[must_use]
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// The values, channels together.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Pairs with their values.
    pub fn iter(&self) -> impl Iterator<Item = (&Pair, &[f64])> {
        self.pairs
            .iter()
            .zip(self.values.chunks_exact(self.channels))
    }

    /// # Errors
    /// If there are too few pairs for `unknowns`, or nothing but zeros.
    pub(crate) fn check(&self, unknowns: usize) -> Result<(), FitError> {
        if self.len() < unknowns {
            return Err(FitError::TooFew {
                found: self.len(),
                expected: unknowns,
            });
        }
        if self.values.iter().all(|v| *v <= 0.0) {
            return Err(FitError::AllZero);
        }
        Ok(())
    }
}

/// Centre and solid angles dwi dwo = 4 cos theta_d dwh dwd of a cell; phi_h is integrated out, and [0, pi) stands for
/// both halves of phi_d.
fn cell([h, d, p]: [usize; 3], [n_h, n_d, n_p]: [usize; 3]) -> (brdf::HalfDiff, f64) {
    let theta_h = |t: f64| t * t * FRAC_PI_2;
    let at = |k: usize, shift: f64, n: usize| (k as f64 + shift) / n as f64;
    let (h0, h1) = (theta_h(at(h, 0.0, n_h)), theta_h(at(h, 1.0, n_h)));
    let (d0, d1) = (at(d, 0.0, n_d) * FRAC_PI_2, at(d, 1.0, n_d) * FRAC_PI_2);
    // integrals of sin theta_h and of 4 sin theta_d cos theta_d; cos a - cos b without cancellation
    let half = 2.0 * (0.5 * (h0 + h1)).sin() * (0.5 * (h1 - h0)).sin();
    let difference = 2.0 * (d0 + d1).sin() * (d1 - d0).sin();
    let angles = brdf::HalfDiff {
        theta_h: theta_h(at(h, 0.5, n_h)),
        theta_d: at(d, 0.5, n_d) * FRAC_PI_2,
        phi_d: at(p, 0.5, n_p) * PI,
    };
    (angles, TAU * half * difference * TAU / n_p as f64)
}

#[cfg(test)]
mod tests {
    use super::{Pair, Samples};
    use crate::Metric;
    use brdf::direction;
    use std::f64::consts::TAU;

    fn ones(dims: [usize; 3]) -> Samples {
        Samples::on_grid(dims, 1, |_, _, out| {
            out[0] = 1.0;
            true
        })
    }

    #[test]
    fn cells_cover_all_pairs_of_directions() {
        let samples = ones([90, 90, 90]);
        let total: f64 = samples.pairs().iter().map(|p| p.weight).sum();
        let cosines: f64 = samples
            .pairs()
            .iter()
            .map(|p| p.weight * p.wi.z * p.wo.z)
            .sum();
        // cells cut by the horizon count whole or not at all: a fraction of 1/90 of the volume
        assert!((total / (TAU * TAU) - 1.0).abs() < 5e-3, "{total}");
        // (integral of cos over the hemisphere)^2
        let pi2 = TAU * TAU / 4.0;
        assert!((cosines / pi2 - 1.0).abs() < 1e-3, "{cosines}");
    }

    #[test]
    fn subsets_keep_sums() {
        let samples = Samples::on_grid([90, 90, 90], 1, |wi, wo, out| {
            let h = (wi + wo).normalize();
            out[0] = 0.1 + 40.0 * h.z.powi(2000);
            true
        });
        for metric in Metric::ALL {
            let few = samples.subset(metric, 1 << 12);
            assert!(few.len() <= 1 << 12, "{}", few.len());
            let sum = |s: &Samples| -> f64 {
                s.iter()
                    .map(|(p, y)| {
                        p.weight * metric.measure(p.wi.z, p.wo.z) * metric.importance(y[0], p.wi.z)
                    })
                    .sum()
            };
            // every draw counts for at most twice the mean: 4096 systematic draws leave far under 2/sqrt(4096)
            let ratio = sum(&few) / sum(&samples);
            assert!((ratio - 1.0).abs() < 0.01, "{metric}: {ratio}");
        }
    }

    #[test]
    fn what_cannot_be_used_is_left_out() {
        let mut samples = Samples::new(1);
        let up = direction(0.3, 0.0);
        let pair = |wi, weight| Pair { wi, wo: up, weight };
        samples.push(pair(-up, 1.0), &[1.0]);
        samples.push(pair(up, 0.0), &[1.0]);
        samples.push(pair(up, 1.0), &[f64::NAN]);
        assert!(samples.is_empty(), "{samples:?}");
        samples.push(pair(up, 1.0), &[1.0]);
        assert_eq!(samples.within(20.0).len(), 1, "17 degrees is within 20");
        assert_eq!(samples.within(10.0).len(), 0, "17 degrees is not within 10");
    }
}
