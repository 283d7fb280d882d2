//! A smooth stand-in for log2 that costs one division and inverts exactly.
//!
//! Within each octave x = 2^e (1 + m), 0 <= m < 1, take
//!
//! L(x) = e + sqrt2 m / (1 + (sqrt2 - 1) m).
//!
//! The Moebius term runs from 0 to 1; its slope sqrt2 at m = 0 is twice that at m = 1, just as octaves halve
//! the slope of log2, so L is continuously differentiable. It differs from log2 by less than 0.01. The
//! inverse is m = r / (sqrt2 - (sqrt2 - 1) r): no series, no table, hence the same point both ways.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

const MANTISSA: u64 = (1 << 52) - 1;
/// Doubles around it are whole.
pub(crate) const LARGE: f64 = 1.5 * (1_u64 << 52) as f64;
const ONE: u64 = 1023 << 52;

/// L of an x >= 1 as a fraction, and its derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Logarithm {
    /// L(x) = `num / den`.
    pub(crate) num: f64,
    pub(crate) den: f64,
    /// x L'(x) den^2.
    pub(crate) slope: f64,
}

/// L(x), for x >= 1.
#[inline(always)]
pub(crate) fn pseudo_log(x: f64) -> Logarithm {
    let bits = x.to_bits();
    let e = ((bits >> 52) as i32 - 1023) as f64;
    let m1 = f64::from_bits((bits & MANTISSA) | ONE);
    let den = (2.0 - SQRT_2) + (SQRT_2 - 1.0) * m1;
    Logarithm {
        num: e * den + SQRT_2 * (m1 - 1.0),
        den,
        slope: SQRT_2 * m1,
    }
}

/// An x >= 1 and what goes with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exponential {
    /// x - 1, without cancellation near 1.
    pub(crate) minus_one: f64,
    /// x L'(x).
    pub(crate) slope: f64,
}

/// The x with L(x) = l, for 0 <= l < 1000.
#[inline(always)]
pub(crate) fn pseudo_exp(l: f64) -> Exponential {
    // whole numbers by rounding near a large one, whose low 32 bits are 0; at whole l either octave will do
    let shifted = (l - 0.5) + LARGE;
    let e = shifted.to_bits() as u32;
    let r = l - (shifted - LARGE);
    let d = SQRT_2 - (SQRT_2 - 1.0) * r;
    let m = r / d;
    let scale = f64::from_bits((u64::from(e) + 1023) << 52);
    Exponential {
        minus_one: (scale - 1.0) + scale * m,
        slope: (1.0 + m) * d * d * FRAC_1_SQRT_2,
    }
}

#[cfg(test)]
mod tests {
    use super::{pseudo_exp, pseudo_log};

    /// L(x) and x L'(x).
    fn log(x: f64) -> (f64, f64) {
        let l = pseudo_log(x);
        (l.num / l.den, l.slope / l.den.powi(2))
    }

    #[test]
    fn inverts_itself_and_stays_near_log2() {
        for k in 0..4000 {
            let x = (1.0 + 1e-9 * f64::from(k)) * (0.004 * f64::from(k)).exp();
            let (l, slope) = log(x);
            let exp = pseudo_exp(l);
            let (back, slope_back) = (1.0 + exp.minus_one, exp.slope);
            // a few roundings of l, which is below 24
            assert!((back / x - 1.0).abs() < 1e-13, "{x} came back as {back}");
            assert!((slope_back / slope - 1.0).abs() < 1e-12, "slope at {x}");
            assert!((l - x.log2()).abs() < 0.01, "{l} is not near log2 {x}");
        }
    }

    #[test]
    fn slope_is_the_derivative_across_octaves() {
        for x in [1.0, 1.3, 1.999_999, 2.0, 3.7, 4.0, 900.0] {
            let d = 1e-7 * x;
            let numeric = (log(x + d).0 - log(x).0) / d * x;
            // first-order difference over 1e-7: curvature below 2, cancellation near 1e-8
            assert!((numeric - log(x).1).abs() < 1e-5, "slope at {x}");
        }
    }
}
