//! Truncated power laws: lobes with long tails are drawn from these.

/// ln t for t between 1 and e^`span` with density proportional to t^(e-1), at the fraction `u` of the way.
///
/// t^e = 1 + u (e^(e span) - 1), in the form that holds for e -> 0, where t = e^(u span).
#[inline]
pub(crate) fn ln_power(u: f64, e: f64, span: f64) -> f64 {
    if (e * span).abs() < 1e-12 {
        u * span
    } else {
        (u * (e * span).exp_m1()).ln_1p() / e
    }
}

/// The integral of t^(e-1) from 1 to e^`span`: (e^(e span) - 1)/e.
#[inline]
pub(crate) fn power_mass(e: f64, span: f64) -> f64 {
    if (e * span).abs() < 1e-12 {
        span
    } else {
        (e * span).exp_m1() / e
    }
}

#[cfg(test)]
mod tests {
    use super::{ln_power, power_mass};
    use testkit::assert_relative;

    #[test]
    fn the_mass_grows_with_u() {
        for e in [-3.0, -0.5, -1e-13, 0.0, 1e-9, 0.7, 2.0] {
            for span in [-4.0, -1e-3, 0.5, 20.0] {
                for u in [0.0, 0.01, 0.5, 0.99, 1.0] {
                    let t = ln_power(u, e, span);
                    let error = (power_mass(e, t) - u * power_mass(e, span)).abs();
                    // relative to the whole
                    assert!(
                        error <= 1e-11 * power_mass(e, span).abs(),
                        "{e} {span} {u}: {error:e}"
                    );
                }
            }
        }
        assert_relative(
            power_mass(2.0, 1.0),
            0.5 * (2.0_f64.exp() - 1.0),
            1e-15,
            "e = 2",
        );
    }
}
