//! When a render has enough samples, decided without looking at the picture that is published.
//!
//! Two rules, both of which choose nothing but a number of samples: the picture is then that of a render which was asked
//! for this number from the start. `docs/error.md` has the proofs.

use crate::estimate::Estimate;

/// A relative RMSE to stay below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Relative RMSE, positive.
    pub rel_rmse: f64,
    /// Probability in (0, 1) with which the expected error of the picture is at most that.
    pub confidence: f64,
    /// Samples a pixel at most.
    pub most: u32,
}

/// What a pilot found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Samples a pixel.
    pub spp: u32,
    /// Upper bound of the relative RMSE of a picture of so many.
    pub bound: f64,
    /// Whether the bound is below the target; false if `most` came first.
    pub reached: bool,
    /// Looks at the pilot.
    pub rounds: u32,
}

impl Target {
    /// The samples a pixel that keep a picture below the target, from a pilot render that doubles its samples, starting
    /// at `first`.
    ///
    /// `pilot(spp, confidence)` is the estimate of a pilot with `spp` samples a pixel. Its random numbers must be
    /// independent of those of the picture that is published: then the number it chose is, too, and that picture is
    /// unbiased. Round k = 0, 1, ... may err with probability alpha / 2^(k + 1), all together with alpha.
    ///
    /// # Errors
    /// Those of the pilot.
    pub fn choose<E>(
        &self,
        first: u32,
        mut pilot: impl FnMut(u32, f64) -> Result<Estimate, E>,
    ) -> Result<Choice, E> {
        let mut alpha = 1.0 - self.confidence;
        let mut spp = first.clamp(1, self.most.max(1));
        let mut rounds = 0;
        loop {
            // the upper end of a two-sided interval that leaves alpha / 2 above it
            let [_, bound] = pilot(spp, 1.0 - alpha)?.rel_rmse_ci;
            rounds += 1;
            let reached = bound <= self.rel_rmse;
            if reached || spp >= self.most {
                return Ok(Choice {
                    spp,
                    bound,
                    reached,
                    rounds,
                });
            }
            alpha *= 0.5;
            spp = spp.saturating_mul(2).min(self.most);
        }
    }
}

/// Part of the time left that a plan fills: the rest is for what it can't foresee.
const FILLED: f64 = 0.97;

/// The samples a pixel to go on to after `spp` of them took `seconds` of a `budget`, or `None` to end here; in steps of
/// `replicates`.
///
/// At most doubles, so that the count of the last half of all samples at least is fixed before they are drawn, and goes by
/// time alone, never by values.
#[must_use]
pub fn next_spp(spp: u32, seconds: f64, budget: f64, replicates: u32) -> Option<u32> {
    let step = replicates.max(1);
    let left = (budget - seconds) * FILLED;
    let fit = left / seconds * f64::from(spp);
    if fit >= f64::from(spp) {
        return spp.checked_mul(2);
    }
    // `as` takes a negative or undefined number for none
    let more = (fit / f64::from(step)) as u32 * step;
    (more > 0).then(|| spp.saturating_add(more))
}

#[cfg(test)]
mod tests {
    use super::next_spp;

    #[test]
    fn plans_fill_the_time_and_never_more_than_double() {
        assert_eq!(next_spp(8, 1.0, 60.0, 8), Some(16));
        // 20 s left of 60, 40 s for 64: 0.97 * 32 = 31.04 more fit, 24 in steps of 8
        assert_eq!(next_spp(64, 40.0, 60.0, 8), Some(88));
        assert_eq!(next_spp(64, 58.0, 60.0, 8), None);
        assert_eq!(next_spp(64, 70.0, 60.0, 8), None);
    }
}
