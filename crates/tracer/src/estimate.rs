//! What the replicates say about the error of the picture.

use crate::film::{Counts, Film, Tile};
use crate::interval::{Pairs, ratio_interval};

/// The error a picture knows of itself.
///
/// All errors are those of the mean of everything the film holds: what the same render with another seed would err by,
/// in the root mean square. They are exact in expectation for independent replicates.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// sqrt(mean over pixels and channels of the squared error).
    pub rmse: f64,
    /// Interval that holds the expected `rmse` with the confidence asked for.
    pub rmse_ci: [f64; 2],
    /// sqrt(sum of squared errors / sum of squared values).
    pub rel_rmse: f64,
    /// Interval that holds the expected `rel_rmse` with the confidence asked for.
    pub rel_rmse_ci: [f64; 2],
    /// 2 V^2 / Var(V) of the summed variance V: the degrees of freedom of the chi-square the intervals rest on.
    pub effective_degrees: f64,
}

/// A picture with the variance of each of its values.
#[derive(Clone, Debug)]
pub struct Moments<const N: usize, T = f64> {
    /// The picture, row after row from the top.
    pub mean: Vec<[T; N]>,
    /// Variance of each mean; infinite where fewer than two replicates have samples.
    pub variance: Vec<[T; N]>,
    /// Replicates less one: the degrees of freedom of each variance.
    pub degrees: u32,
}

impl<const N: usize> Film<N> {
    /// The error of the picture; `confidence` in (0, 1) is that of the intervals.
    #[must_use]
    pub fn estimate(&self, confidence: f64) -> Estimate {
        // each tile by itself, then tile after tile: the same bits whatever the threads
        let tiles = self.seen();
        let Sums {
            square,
            error,
            pairs,
        } = tiles.into_iter().fold(Sums::default(), Sums::and);
        let replicates = self.replicates().min(self.spp());
        let values = self.width() as usize * self.height() as usize * N;
        // E(mean^2) = truth^2 + variance
        let truth = square - error;
        let spread = Spread::new([error, truth], pairs, replicates, values);
        let rel = if error.abs() == 0.0 {
            0.0
        } else if truth > 0.0 && error.is_finite() {
            (error / truth).sqrt()
        } else {
            f64::INFINITY
        };
        let rmse = (error / values.max(1) as f64).sqrt();
        let interval = |of: f64, ratio: [f64; 2]| {
            if replicates < 2 || of.is_infinite() {
                return [0.0, f64::INFINITY];
            }
            // no error at all stays none
            ratio.map(|factor| if of > 0.0 { of * factor.sqrt() } else { of })
        };
        let t = sampling::student_quantile(confidence, spread.certainty);
        Estimate {
            rmse,
            rmse_ci: interval(rmse, ratio_interval([spread.alone, 0.0], t)),
            rel_rmse: rel,
            rel_rmse_ci: interval(rel, ratio_interval(spread.relative, t)),
            effective_degrees: 2.0 / spread.alone,
        }
    }

    /// The picture and the variance of each of its values.
    #[must_use]
    pub fn moments(&self) -> Moments<N> {
        self.moments_as(|value| value)
    }

    /// [`Self::moments`] in another type: `narrow` is asked for every value.
    #[must_use]
    pub fn moments_as<T: Copy + Default + Send>(
        &self,
        narrow: impl Fn(f64) -> T + Sync,
    ) -> Moments<N, T> {
        let replicates = self.replicates().min(self.spp());
        let empty = [T::default(); N];
        let (mean, variance) = self.map2((empty, empty), |counts, sums| {
            let (mean, variance) = mean_and_variance(counts, sums);
            (mean.map(&narrow), variance.map(&narrow))
        });
        Moments {
            mean,
            variance,
            degrees: replicates.saturating_sub(1),
        }
    }
}

impl<const N: usize> Moments<N> {
    /// Half the width of the interval about a channel of a pixel that holds the truth with `confidence`: Student's t.
    #[must_use]
    pub fn half_width(&self, pixel: usize, channel: usize, confidence: f64) -> f64 {
        let variance = self.variance.get(pixel).and_then(|v| v.get(channel));
        sampling::student_quantile(confidence, self.degrees)
            * variance.map_or(f64::INFINITY, |v| v.sqrt())
    }
}

/// What is summed over pixels: squares of means, their variances, and what these vary by unless some pixel has too few
/// replicates to tell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sums {
    square: f64,
    error: f64,
    pairs: Option<Pairs>,
}

impl Default for Sums {
    fn default() -> Self {
        Self {
            square: 0.0,
            error: 0.0,
            pairs: Some(Pairs::default()),
        }
    }
}

/// Pixels at a time.
const WIDE: usize = 8;

/// The sums of a tile, to be compiled for each instruction set.
struct OfTile<'a, const N: usize>(Tile<'a, N>);

impl<const N: usize> pulp::WithSimd for OfTile<'_, N> {
    type Output = Sums;

    #[inline(always)]
    fn with_simd<I: pulp::Simd>(self, _: I) -> Sums {
        Sums::of_tile(self.0)
    }
}

impl Sums {
    pub(crate) fn of<const N: usize>(tile: Tile<'_, N>) -> Self {
        brdf::arch().dispatch(OfTile(tile))
    }

    #[inline(always)]
    fn of_tile<const N: usize>(tile: Tile<'_, N>) -> Self {
        let counts = tile.counts();
        let degrees = counts.used.len() as f64 - 1.0;
        let (inverse, scale) = (
            1.0 / counts.samples.max(1.0),
            1.0 / (degrees * counts.samples),
        );
        let zero = [0.0; WIDE];
        let mut sums = Self::default();
        let mut means = vec![[zero; N]; counts.used.len()];
        let (mut square, mut error) = (zero, zero);
        let (all, stride) = (tile.sums(), tile.replicates() as usize);
        for first in (0..all.len()).step_by(stride * WIDE) {
            let pixels = WIDE.min((all.len() - first) / stride);
            let mut mean = [zero; N];
            for (own, &(r, _, over)) in means.iter_mut().zip(&counts.used) {
                for k in 0..pixels {
                    let sum = &all[first + k * stride + r];
                    for c in 0..N {
                        mean[c][k] += sum[c] * inverse;
                        own[c][k] = sum[c] * over;
                    }
                }
                // lanes to spare hold zeros, which add nothing
                for k in pixels..WIDE {
                    for c in 0..N {
                        own[c][k] = 0.0;
                    }
                }
            }
            for c in 0..N {
                for k in 0..WIDE {
                    square[k] += mean[c][k] * mean[c][k];
                }
                for (own, &(_, n, _)) in means.iter().zip(&counts.used) {
                    for k in 0..WIDE {
                        let off = own[c][k] - mean[c][k];
                        error[k] += n * off * off * scale;
                    }
                }
            }
            sums.pairs = (sums.pairs.zip(Pairs::of(&means))).map(|(a, b)| a.and(b));
        }
        sums.square = square.iter().sum();
        sums.error = if counts.used.len() < 2 {
            f64::INFINITY
        } else {
            error.iter().sum()
        };
        sums
    }

    fn and(self, other: Self) -> Self {
        Self {
            square: self.square + other.square,
            error: self.error + other.error,
            pairs: self.pairs.zip(other.pairs).map(|(a, b)| a.and(b)),
        }
    }
}

/// Mean of all samples and its variance, from samples and sums by replicate. Replicates count by their samples, so that it
/// holds for any number of samples.
fn mean_and_variance<const N: usize>(counts: &Counts, sums: &[[f64; N]]) -> ([f64; N], [f64; N]) {
    if counts.used.is_empty() {
        return ([0.0; N], [f64::INFINITY; N]);
    }
    let mut total = [0.0; N];
    for sum in sums {
        for c in 0..N {
            total[c] += sum[c];
        }
    }
    let mean = total.map(|t| t / counts.samples);
    if counts.used.len() < 2 {
        return (mean, [f64::INFINITY; N]);
    }
    let mut variance = [0.0; N];
    for &(r, n, inverse) in &counts.used {
        for c in 0..N {
            let off = sums[r][c] * inverse - mean[c];
            variance[c] += n * off * off;
        }
    }
    let degrees = (counts.used.len() - 1) as f64;
    let scale = 1.0 / (degrees * counts.samples);
    (mean, variance.map(|v| v * scale))
}

/// What the intervals rest on: twice the inverse degrees of freedom of the chi-squares that stand for V and T
/// [Satterthwaite1946].
struct Spread {
    /// Of V.
    alone: f64,
    /// Of V and T in V / T. What both have in common is taken off either in proportion: 2 / nu_V + 2 / nu_T is then the
    /// relative variance of the ratio.
    relative: [f64; 2],
    /// Degrees of freedom of Student's t: how well Var(V) is known itself.
    certainty: u32,
}

impl Spread {
    fn new([v, t]: [f64; 2], pairs: Option<Pairs>, replicates: u32, values: usize) -> Self {
        let one = f64::from(replicates.saturating_sub(1)).max(1.0);
        let least = 2.0 / (one * values as f64).max(1.0);
        let Some(pairs) = pairs else {
            // fewer than four replicates: normal values of all pixels that err together
            return Self {
                alone: 2.0 / one,
                relative: [2.0 / one, 0.0],
                certainty: 1_000_000,
            };
        };
        // between one degree and as many as there are values; NaN where V is 0
        let bounded = |x: f64| x.max(least).min(2.0);
        let of_v = pairs.spread() / (v * v);
        let (common, of_t) = (pairs.cov / (v * t), (pairs.var_t / (t * t)).max(0.0));
        let apart = 1.0 - 2.0 * common / (of_v + of_t);
        Self {
            alone: bounded(of_v),
            relative: [bounded(apart * of_v), (apart * of_t).max(0.0)],
            certainty: pairs.degrees(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(samples: &[u32]) -> Counts {
        Counts::new(samples.iter().copied())
    }

    #[test]
    fn mean_and_variance_of_even_replicates_are_the_textbook_ones() {
        let (mean, variance) = mean_and_variance(&counts(&[2; 4]), &[[2.0], [4.0], [6.0], [8.0]]);
        assert!((mean[0] - 2.5).abs() < 1e-12, "mean of 1, 2, 3, 4");
        assert!((variance[0] - 5.0 / 3.0 / 4.0).abs() < 1e-12, "s^2 / R");
    }

    #[test]
    fn uneven_replicates_keep_the_mean() {
        let (mean, variance) = mean_and_variance(&counts(&[3, 1, 0]), &[[3.0], [1.0], [0.0]]);
        assert!((mean[0] - 1.0).abs() < 1e-12, "mean of four ones");
        assert!(variance[0].abs() < 1e-12, "which do not differ");
    }

    #[test]
    fn one_replicate_claims_nothing() {
        let (_, variance) = mean_and_variance(&counts(&[1, 0]), &[[3.0], [0.0]]);
        assert!(variance[0].is_infinite(), "infinite variance");
    }
}
