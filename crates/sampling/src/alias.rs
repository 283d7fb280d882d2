//! Discrete sampling in constant time.

use crate::ONE_MINUS_EPSILON;
use crate::density_error::{DensityError, check, check_sum};

/// An alias table [Walker1977], built as in [Vose1991].
///
/// It breaks stratification: neighbouring numbers may map to far apart indices. Where points are
/// low-discrepancy, prefer [`crate::Piecewise1`].
#[derive(Clone, Debug, PartialEq)]
pub struct AliasTable {
    bins: Vec<Bin>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Bin {
    /// Part of the bin that belongs to its own index.
    keep: f64,
    /// Probability of its own index.
    probability: f64,
    /// Whom the rest belongs to.
    alias: u32,
}

impl AliasTable {
    /// Index k with probability proportional to `weights[k]`.
    ///
    /// # Errors
    /// If there are none or more than u32 counts, one is negative or not finite, or all are 0.
    pub fn new(weights: &[f64]) -> Result<Self, DensityError> {
        check(weights, 1)?;
        let n = weights.len();
        let size = |_| DensityError::Size {
            expected: u32::MAX as usize,
            found: n,
        };
        u32::try_from(n).map_err(size)?;
        let sum = check_sum(weights.iter().sum())?;
        let mut bins: Vec<Bin> = weights
            .iter()
            .map(|w| Bin {
                keep: w / sum * n as f64,
                probability: w / sum,
                alias: 0,
            })
            .collect();
        let (mut small, mut large): (Vec<usize>, Vec<usize>) =
            (0..n).partition(|&k| bins[k].keep < 1.0);
        while let (Some(s), Some(&l)) = (small.pop(), large.last()) {
            bins[s].alias = l as u32;
            // In this order no digits are lost: (large + small) - 1.
            bins[l].keep = (bins[l].keep + bins[s].keep) - 1.0;
            if bins[l].keep < 1.0 {
                large.pop();
                small.push(l);
            }
        }
        // What remains is 1 up to rounding: a bin of its own, unless it has no weight at all.
        let best = (0..n).max_by(|&a, &b| weights[a].total_cmp(&weights[b]));
        for k in small.into_iter().chain(large) {
            bins[k].keep = if weights[k] > 0.0 { 1.0 } else { 0.0 };
            bins[k].alias = best.unwrap_or(k) as u32;
        }
        Ok(Self { bins })
    }

    /// The index chosen by `u` in [0, 1), its probability, and a fresh number in [0, 1).
    #[inline]
    #[must_use]
    pub fn sample(&self, u: f64) -> (usize, f64, f64) {
        let n = self.bins.len();
        let scaled = u * n as f64;
        let k = (scaled as usize).min(n - 1);
        let bin = self.bins[k];
        let t = scaled - k as f64;
        let (index, rest) = if t < bin.keep {
            (k, t / bin.keep)
        } else {
            (bin.alias as usize, (t - bin.keep) / (1.0 - bin.keep))
        };
        let rest = rest.clamp(0.0, ONE_MINUS_EPSILON);
        (index, self.bins[index].probability, rest)
    }

    /// Probability of index `k`; 0 beyond the table.
    #[inline]
    #[must_use]
    pub fn probability(&self, k: usize) -> f64 {
        self.bins.get(k).map_or(0.0, |b| b.probability)
    }

    /// How many indices there are; at least 1.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a table is never empty")]
    pub fn len(&self) -> usize {
        self.bins.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact probabilities the table gives, from its bins.
    fn realised(table: &AliasTable) -> Vec<f64> {
        let n = table.len();
        let mut p = vec![0.0; n];
        for (k, bin) in table.bins.iter().enumerate() {
            p[k] += bin.keep / n as f64;
            p[bin.alias as usize] += (1.0 - bin.keep) / n as f64;
        }
        p
    }

    #[test]
    fn realises_its_probabilities() {
        for weights in [
            vec![1.0],
            vec![0.0, 1.0, 0.0],
            vec![5.0, 1.0, 1e-9, 3.0],
            (1..1000).map(f64::from).collect(),
        ] {
            let table = AliasTable::new(&weights).unwrap();
            for (k, p) in realised(&table).into_iter().enumerate() {
                testkit::assert_close(p, table.probability(k), 1e-13, "probability");
            }
        }
    }

    #[test]
    fn never_returns_a_zero_weight() {
        let table = AliasTable::new(&[0.0, 2.0, 0.0, 1.0, 0.0]).unwrap();
        for k in 0..10_000 {
            let (index, p, rest) = table.sample(f64::from(k) / 10_000.0);
            assert!(p > 0.0 && index % 2 == 1, "{index}");
            assert!((0.0..1.0).contains(&rest), "{rest}");
        }
    }

    #[test]
    fn refuses_what_is_no_density() {
        for weights in [&[][..], &[0.0, 0.0], &[1.0, -1.0], &[f64::INFINITY]] {
            assert!(AliasTable::new(weights).is_err(), "{weights:?}");
        }
    }
}
