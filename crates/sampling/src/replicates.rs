//! A mean from independent replicates, with its confidence interval.

use crate::{Welford, student_quantile};

/// Independent, identically distributed estimates of one number: the way to an error bar where samples
/// within an estimate are dependent, as low-discrepancy points are.
///
/// Each replicate must use its own scramble (seed) and the same number of points. The interval is the plain
/// Student t one, which serves well even for few replicates [LEcuyer2023].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Replicates(Welford);

impl Replicates {
    /// No replicates yet.
    #[must_use]
    pub const fn new() -> Self {
        Self(Welford::new())
    }

    /// Adds the estimate of one replicate.
    pub fn push(&mut self, estimate: f64) {
        self.0.push(estimate);
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.0.count()
    }

    /// Their mean.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.0.mean()
    }

    /// Standard error of the mean; NaN below two replicates.
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        self.0.standard_error()
    }

    /// Half the width of the interval about the mean that covers the truth with probability
    /// `confidence` in (0, 1); NaN below two replicates.
    #[must_use]
    pub fn half_width(&self, confidence: f64) -> f64 {
        let dof = u32::try_from(self.count().saturating_sub(1)).unwrap_or(u32::MAX);
        // Beyond this the distribution is normal to 1e-6, and the series would take long.
        let t = student_quantile(confidence, dof.min(1_000_000));
        t * self.standard_error()
    }
}

impl FromIterator<f64> for Replicates {
    fn from_iter<I: IntoIterator<Item = f64>>(estimates: I) -> Self {
        Self(estimates.into_iter().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn intervals_cover_as_often_as_they_claim() {
        // 4000 intervals of 8 normal replicates at 90 %: 3600 +- 19 cover
        let mut rng = Rng::new(3);
        let covered = (0..4000)
            .filter(|_| {
                let r: Replicates = (0..8).map(|_| 5.0 + rng.normal()).collect();
                (r.mean() - 5.0).abs() <= r.half_width(0.9)
            })
            .count();
        assert!((3600 - 60..3600 + 60).contains(&covered), "{covered}");
    }

    #[test]
    fn one_replicate_promises_nothing() {
        let r: Replicates = [1.0].into_iter().collect();
        assert!(r.half_width(0.95).is_nan());
    }
}
