//! Quantiles of Student's t distribution, for confidence intervals of few replicates.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// The t that a Student variable with `dof` >= 1 degrees of freedom stays within with probability
/// `confidence` (two-sided, in (0, 1)); infinite for `dof` = 0, 0 for a confidence <= 0.
///
/// `student_quantile(0.95, 7)` is 2.3646. Absolute error below 1e-12 times 1 + t^2.
#[must_use]
pub fn student_quantile(confidence: f64, dof: u32) -> f64 {
    if dof == 0 || confidence >= 1.0 {
        return f64::INFINITY;
    }
    // Bisection in the angle atan(t / sqrt(dof)), where the probability is monotone and bounded.
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if within(middle, dof) < confidence {
            low = middle;
        } else {
            high = middle;
        }
    }
    low.tan() * f64::from(dof).sqrt()
}

/// P(|t| <= sqrt(dof) tan(angle)): the finite series [Abramowitz1964, 26.7.3 and 26.7.4].
fn within(angle: f64, dof: u32) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let odd = dof % 2 == 1;
    let mut term = if odd { cos } else { 1.0 };
    let mut sum = 0.0;
    let mut k = if odd { 1 } else { 0 };
    while k + 1 < dof {
        sum += term;
        k += 2;
        term *= cos * cos * f64::from(k - 1) / f64::from(k);
    }
    if odd {
        FRAC_2_PI * (angle + sin * sum)
    } else {
        sin * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::{assert_close, assert_relative, special::student_two_sided};

    #[test]
    fn printed_percentage_points() {
        // [Abramowitz1964, table 26.10], three decimals
        for (dof, confidence, t) in [
            (1, 0.95, 12.706),
            (2, 0.95, 4.303),
            (3, 0.99, 5.841),
            (7, 0.95, 2.365),
            (10, 0.99, 3.169),
            (120, 0.95, 1.980),
        ] {
            assert_close(student_quantile(confidence, dof), t, 5e-4, "t");
        }
    }

    #[test]
    fn agrees_with_the_incomplete_beta_function() {
        for dof in [1, 2, 3, 8, 31, 1000] {
            for confidence in [0.5, 0.9, 0.999] {
                let t = student_quantile(confidence, dof);
                let tail = student_two_sided(t, f64::from(dof));
                assert_relative(tail, 1.0 - confidence, 1e-9, "tail");
            }
        }
    }
}
