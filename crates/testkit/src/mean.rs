//! Tests of a mean against its known value.

use sampling::special::{normal_two_sided, student_two_sided};

/// How far a mean is from its hypothesis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanTest {
    /// (mean - expected) / standard error.
    pub score: f64,
    /// Probability of a score at least as large in size, if the hypothesis is true.
    pub p_value: f64,
}

/// Z-test: `mean` is normal about `expected` with the known or well estimated `standard_error`.
///
/// A standard error of 0 gives a p-value of 1 where the mean is exact and 0 elsewhere.
#[must_use]
pub fn z_test(mean: f64, standard_error: f64, expected: f64) -> MeanTest {
    let score = score(mean, standard_error, expected);
    MeanTest {
        score,
        p_value: normal_two_sided(score),
    }
}

/// One-sample t-test: `mean` of `n` >= 2 normal values with sample `variance` (divided by n - 1).
///
/// Fewer than two values tell nothing: the p-value is NaN.
#[must_use]
pub fn t_test(mean: f64, variance: f64, n: usize, expected: f64) -> MeanTest {
    let score = score(mean, (variance / n as f64).sqrt(), expected);
    let p_value = match n.checked_sub(1) {
        None | Some(0) => f64::NAN,
        Some(_) if score.is_infinite() => 0.0,
        Some(dof) => student_two_sided(score, dof as f64),
    };
    MeanTest { score, p_value }
}

#[expect(
    clippy::float_cmp,
    reason = "an exact mean has score 0 whatever its error"
)]
fn score(mean: f64, standard_error: f64, expected: f64) -> f64 {
    if mean == expected {
        0.0
    } else {
        (mean - expected) / standard_error
    }
}

/// Whether `mean` is at most `k` standard errors from `expected`; false if anything is NaN.
#[must_use]
pub fn within_standard_errors(mean: f64, standard_error: f64, expected: f64, k: f64) -> bool {
    (mean - expected).abs() <= k * standard_error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn z_test_knows_two_sigma() {
        let t = z_test(1.2, 0.1, 1.0);
        assert!((t.p_value - 0.0455).abs() < 1e-4, "{t:?}");
        assert!((z_test(1.0, 0.0, 1.0).p_value - 1.0).abs() < 1e-15);
        assert!(z_test(1.1, 0.0, 1.0).p_value.abs() < 1e-300);
    }

    #[test]
    fn t_test_of_a_worked_example() {
        // mean 3, variance 2.5, n 5 against 2: t = 1/sqrt(0.5) = 1.41421, p = 0.2302 with 4 degrees
        let t = t_test(3.0, 2.5, 5, 2.0);
        assert!((t.score - std::f64::consts::SQRT_2).abs() < 1e-12, "{t:?}");
        assert!((t.p_value - 0.2302).abs() < 1e-4, "{t:?}");
        assert!(t_test(1.0, 0.0, 1, 1.0).p_value.is_nan());
    }

    #[test]
    fn within_is_false_for_nan() {
        assert!(within_standard_errors(1.0, 0.1, 1.25, 3.0));
        assert!(!within_standard_errors(1.0, 0.1, 1.35, 3.0));
        assert!(!within_standard_errors(f64::NAN, 0.1, 1.0, 3.0));
    }
}
