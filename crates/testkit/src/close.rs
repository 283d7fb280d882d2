//! Comparing numbers with a stated tolerance.

/// |actual - expected| / |expected|; 0 if both are equal (also both 0), infinite if only `expected` is 0.
#[must_use]
#[expect(clippy::float_cmp, reason = "equal numbers have no error")]
pub fn relative_error(actual: f64, expected: f64) -> f64 {
    if actual == expected {
        0.0
    } else {
        (actual - expected).abs() / expected.abs()
    }
}

/// Asserts |actual - expected| <= tolerance; `what` names the quantity.
///
/// # Panics
/// If they differ by more, or either is NaN.
#[track_caller]
pub fn assert_close(actual: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (actual - expected).abs();
    assert!(
        error <= tolerance,
        "{what}: {actual} instead of {expected}, off by {error:e}, allowed {tolerance:e}"
    );
}

/// Asserts that [`relative_error`] is at most `tolerance`; `what` names the quantity.
///
/// # Panics
/// If it is larger, or either number is NaN.
#[track_caller]
pub fn assert_relative(actual: f64, expected: f64, tolerance: f64, what: &str) {
    let error = relative_error(actual, expected);
    assert!(
        error <= tolerance,
        "{what}: {actual} instead of {expected}, relative error {error:e}, allowed {tolerance:e}"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accepts_what_is_close() {
        assert_relative(1.0 + 1e-9, 1.0, 1e-8, "one");
        assert_relative(0.0, 0.0, 0.0, "zero");
        assert_close(1e-9, 0.0, 1e-8, "small");
    }

    #[test]
    #[should_panic(expected = "relative error")]
    fn rejects_what_is_not() {
        assert_relative(1.1, 1.0, 0.01, "one");
    }

    #[test]
    #[should_panic(expected = "NaN")]
    fn rejects_nan() {
        assert_close(f64::NAN, 1.0, 1.0, "nan");
    }
}
