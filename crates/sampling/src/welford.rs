//! Running mean and variance without cancellation.

/// Mean and variance of a stream of numbers [Welford1962], mergeable [Chan1983].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Welford {
    count: u64,
    mean: f64,
    /// Sum of squared deviations from the mean.
    m2: f64,
}

impl Welford {
    /// No values yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            count: 0,
            mean: 0.0,
            m2: 0.0,
        }
    }

    /// Adds one value.
    #[inline]
    pub fn push(&mut self, x: f64) {
        self.count += 1;
        let before = x - self.mean;
        self.mean += before / self.count as f64;
        self.m2 += before * (x - self.mean);
    }

    /// Adds all that `other` has seen.
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        let (a, b) = (self.count as f64, other.count as f64);
        let delta = other.mean - self.mean;
        self.count += other.count;
        self.mean += delta * (b / (a + b));
        self.m2 += other.m2 + delta * delta * (a * (b / (a + b)));
    }

    /// How many values there were.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Arithmetic mean; 0 without values.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Unbiased sample variance (divided by n - 1); NaN below two values: it is unknown.
    #[must_use]
    pub fn variance(&self) -> f64 {
        if self.count < 2 {
            f64::NAN
        } else {
            self.m2 / (self.count - 1) as f64
        }
    }

    /// Standard error of the mean, sqrt(variance / n); NaN below two values.
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        (self.variance() / self.count as f64).sqrt()
    }
}

impl Extend<f64> for Welford {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        values.into_iter().for_each(|x| self.push(x));
    }
}

impl FromIterator<f64> for Welford {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let mut w = Self::new();
        w.extend(values);
        w
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::assert_relative;

    #[test]
    fn survives_a_large_offset() {
        // 1e9 + {4, 7, 13, 16}: variance 30; the textbook formula loses it all at this offset
        let w: Welford = [4.0, 7.0, 13.0, 16.0].iter().map(|x| x + 1e9).collect();
        assert_relative(w.variance(), 30.0, 1e-12, "variance");
        assert_relative(w.mean(), 1e9 + 10.0, 1e-15, "mean");
        assert_relative(w.standard_error(), 7.5_f64.sqrt(), 1e-12, "standard error");
    }

    #[test]
    fn merging_equals_pushing() {
        let values: Vec<f64> = (0..100).map(|k| f64::from(k * k % 37)).collect();
        let whole: Welford = values.iter().copied().collect();
        let mut parts = Welford::new();
        for chunk in values.chunks(7) {
            parts.merge(&chunk.iter().copied().collect());
        }
        parts.merge(&Welford::new());
        assert_eq!(parts.count(), whole.count());
        assert_relative(parts.mean(), whole.mean(), 1e-13, "mean");
        assert_relative(parts.variance(), whole.variance(), 1e-13, "variance");
    }

    #[test]
    fn one_value_has_no_variance() {
        let w: Welford = [3.0].into_iter().collect();
        assert!(w.variance().is_nan() && w.standard_error().is_nan());
    }
}
