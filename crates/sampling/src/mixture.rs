//! Mixtures of samplers.

use crate::ONE_MINUS_EPSILON;
use crate::density_error::{DensityError, check, check_sum};

/// A choice among samplers with fixed probabilities.
///
/// The number that chooses is stretched and handed on, so strata stay connected within each component.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixture {
    weights: Vec<f64>,
}

impl Mixture {
    /// Components with probabilities proportional to `weights`.
    ///
    /// # Errors
    /// If there are none, one is negative or not finite, or all are 0.
    pub fn new(weights: &[f64]) -> Result<Self, DensityError> {
        check(weights, 1)?;
        let sum = check_sum(weights.iter().sum())?;
        Ok(Self {
            weights: weights.iter().map(|w| w / sum).collect(),
        })
    }

    /// Probabilities of the components.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The component chosen by `u` in [0, 1), and a number in [0, 1) to sample it with.
    #[inline]
    #[must_use]
    pub fn choose(&self, u: f64) -> (usize, f64) {
        let mut below = 0.0;
        let mut last = (0, 0.0);
        for (k, &w) in self.weights.iter().enumerate().filter(|(_, w)| **w > 0.0) {
            last = (k, ((u - below) / w).min(ONE_MINUS_EPSILON));
            below += w;
            if u < below {
                return last;
            }
        }
        // The weights sum to 1 up to rounding, and u is above that sum.
        last
    }

    /// Density of the mixture, from the densities of its components.
    #[inline]
    pub fn pdf(&self, mut component: impl FnMut(usize) -> f64) -> f64 {
        let term = |(k, w): (usize, &f64)| if *w > 0.0 { w * component(k) } else { 0.0 };
        self.weights.iter().enumerate().map(term).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chooses_and_stretches() {
        let m = Mixture::new(&[1.0, 0.0, 3.0]).unwrap();
        assert_eq!(m.choose(0.125), (0, 0.5));
        assert_eq!(m.choose(0.25), (2, 0.0));
        let (k, u) = m.choose(ONE_MINUS_EPSILON);
        assert!(k == 2 && u < 1.0 && u > 0.999);
        assert!((m.pdf(|k| k as f64) - 1.5).abs() < 1e-15);
    }

    #[test]
    fn refuses_what_is_no_mixture() {
        for weights in [&[][..], &[0.0], &[1.0, -1.0], &[f64::NAN]] {
            assert!(Mixture::new(weights).is_err(), "{weights:?}");
        }
    }
}
