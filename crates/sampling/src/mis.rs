//! Multiple importance sampling weights [Veach1997, 9.2].
//!
//! Densities enter as ratios, so products of densities neither overflow nor become 0/0.
//! For unequal sample counts pass n times the density.

/// Balance heuristic: p / (p + other). 0 where `p` is 0; 1 where `p` is infinite (a delta).
#[inline]
#[must_use]
pub fn balance(p: f64, other: f64) -> f64 {
    if p > 0.0 {
        1.0 / (1.0 + ratio(other, p))
    } else {
        0.0
    }
}

/// Power heuristic with exponent 2: p^2 / (p^2 + other^2). 0 where `p` is 0; 1 where `p` is infinite.
#[inline]
#[must_use]
pub fn power(p: f64, other: f64) -> f64 {
    if p > 0.0 {
        let r = ratio(other, p);
        1.0 / (1.0 + r * r)
    } else {
        0.0
    }
}

/// a / b for b > 0, with an infinite b winning over anything.
fn ratio(a: f64, b: f64) -> f64 {
    if b.is_infinite() { 0.0 } else { a / b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_all_samplers_sum_to_one() {
        for (a, b) in [
            (1.0, 3.0),
            (1e-300, 1e300),
            (2e200, 1e200),
            (1.0, 0.0),
            (0.3, f64::INFINITY),
        ] {
            for weight in [balance, power] {
                assert!((weight(a, b) + weight(b, a) - 1.0).abs() < 1e-15, "{a} {b}");
            }
        }
    }

    #[test]
    fn zero_density_has_no_weight() {
        assert!(balance(0.0, 0.0).abs() < 1e-300);
        assert!(power(0.0, 1.0).abs() < 1e-300);
        assert!((power(3.0, 1.0) - 0.9).abs() < 1e-15);
    }
}
