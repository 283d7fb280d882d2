//! Rejection sampling that admits when its bound was wrong.

use crate::Rng;

/// Rejection sampling [VonNeumann1951] with a bound on target / proposal, and what became of it.
///
/// A ratio above the bound makes the samples follow min(target, bound x proposal) instead of the target.
/// That can't be repaired after the fact, so it is counted: check [`Self::violations`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejection {
    bound: f64,
    tries: u64,
    accepted: u64,
    violations: u64,
    largest: f64,
}

impl Rejection {
    /// Sampling with target / proposal <= `bound`; `None` unless the bound is positive and finite.
    #[must_use]
    pub fn new(bound: f64) -> Option<Self> {
        (bound > 0.0 && bound.is_finite()).then_some(Self {
            bound,
            tries: 0,
            accepted: 0,
            violations: 0,
            largest: 0.0,
        })
    }

    /// Whether a proposal with this target / proposal `ratio` is accepted, by `u` uniform in [0, 1).
    ///
    /// A NaN ratio is refused and counts as a violation.
    #[inline]
    pub fn accept(&mut self, ratio: f64, u: f64) -> bool {
        self.tries += 1;
        self.violations += u64::from(ratio > self.bound || ratio.is_nan());
        self.largest = self.largest.max(ratio);
        let accepted = u * self.bound < ratio;
        self.accepted += u64::from(accepted);
        accepted
    }

    /// Proposes (value, ratio) until one is accepted, at most `max_tries` times.
    pub fn sample<T>(
        &mut self,
        rng: &mut Rng,
        max_tries: u64,
        mut propose: impl FnMut(&mut Rng) -> (T, f64),
    ) -> Option<T> {
        for _ in 0..max_tries {
            let (value, ratio) = propose(rng);
            if self.accept(ratio, rng.uniform()) {
                return Some(value);
            }
        }
        None
    }

    /// Proposals made.
    #[must_use]
    pub fn tries(&self) -> u64 {
        self.tries
    }

    /// Proposals accepted.
    #[must_use]
    pub fn accepted(&self) -> u64 {
        self.accepted
    }

    /// Proposals whose ratio exceeded the bound: 0, or the samples are biased.
    #[must_use]
    pub fn violations(&self) -> u64 {
        self.violations
    }

    /// The largest ratio met.
    #[must_use]
    pub fn largest_ratio(&self) -> f64 {
        self.largest
    }

    /// The bound in use.
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::Domain;
    use testkit::chi2::{Config, test};

    /// Samples density 2x on [0, 1) from uniform proposals.
    fn ramp(rejection: &mut Rejection, seed: u64) -> testkit::chi2::Chi2Report {
        let mut rng = Rng::new(seed);
        let config = Config {
            domain: Domain::Square,
            samples: 50_000,
            ..Config::default()
        };
        let draw = |_: &mut testkit::Rng| {
            let x = rejection.sample(&mut rng, 1000, |r| {
                let x = r.uniform();
                (x, 2.0 * x)
            })?;
            Some([x, rng.uniform(), 0.0])
        };
        test(&config, draw, |p| 2.0 * p[0])
    }

    #[test]
    fn honest_bound_gives_the_target() {
        let mut rejection = Rejection::new(2.0).unwrap();
        let report = ramp(&mut rejection, 1);
        assert!(report.ok, "{report}");
        assert_eq!(rejection.violations(), 0);
        let acceptance = rejection.accepted() as f64 / rejection.tries() as f64;
        assert!((acceptance - 0.5).abs() < 0.01, "{acceptance}");
    }

    #[test]
    fn wrong_bound_is_reported_and_the_test_sees_it() {
        let mut rejection = Rejection::new(1.5).unwrap();
        let report = ramp(&mut rejection, 1);
        assert!(!report.ok, "{report}");
        assert!(rejection.violations() > 10_000);
        assert!((rejection.largest_ratio() - 2.0).abs() < 1e-3);
    }

    #[test]
    fn impossible_bounds_and_ratios() {
        assert!(Rejection::new(0.0).is_none() && Rejection::new(f64::INFINITY).is_none());
        let mut rejection = Rejection::new(1.0).unwrap();
        assert!(!rejection.accept(f64::NAN, 0.0));
        assert_eq!(rejection.violations(), 1);
        assert!(
            !rejection.accept(0.0, 0.0),
            "zero density is never accepted"
        );
    }
}
