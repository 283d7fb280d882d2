//! A stand-in for the azimuth that costs one root and one division where sine and arctangent would be.
//!
//! With x = |cos phi|, y = |sin phi| the place in a quadrant is m = y / (1 + x / sqrt2), from 0 to 1, and q counts
//! quarters: m, or 2 - m behind, with the sign of the sine. The factor 1 / sqrt2 is the one that leaves the second
//! derivative continuous where quadrants meet:
//!
//! dq/dphi = (x + 1/sqrt2) / (1 + x / sqrt2)^2, between 0.58 and 0.71 a radian.
//!
//! Backward x = (sqrt(1 - m^2 / 2) - m^2 / sqrt2) / (1 + m^2 / 2) and y = m (1 + x / sqrt2). Quarters come as fractions: what
//! they are divided by waits until all divisions are one.

use std::f64::consts::FRAC_1_SQRT_2;

/// 1 / sqrt2.
const BEND: f64 = FRAC_1_SQRT_2;

/// `num / den`, den > 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ratio {
    pub(crate) num: f64,
    pub(crate) den: f64,
}

/// Quarters of the direction (x, y), y >= 0, of length `rho`: 0 to 2.
#[inline(always)]
pub(crate) fn quarters(x: f64, y: f64, rho: f64) -> Ratio {
    let den = rho + BEND * x.abs();
    // counted on from the front, or back from behind; without a branch, for signs are random
    let num = (den - den.copysign(x)) + y.copysign(x);
    Ratio { num, den }
}

/// dq/dphi at the direction of cosine x / rho, times den^2 of its [`quarters`].
#[inline(always)]
pub(crate) fn slope(x: f64, rho: f64) -> f64 {
    (x.abs() + BEND * rho) * rho
}

/// A direction in the plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) cos: f64,
    pub(crate) sin: f64,
    /// cos phi again, not yet divided.
    pub(crate) x: Ratio,
    /// dq/dphi as a fraction.
    pub(crate) slope: [f64; 2],
}

/// The direction at quarters from -2 to 2.
#[inline(always)]
pub(crate) fn circle(q: Ratio) -> Circle {
    let ahead = q.den - q.num.abs();
    let m = q.den - ahead.abs();
    let (m2, den2) = (m * m, q.den * q.den);
    let root = (den2 - 0.5 * m2).sqrt();
    // |cos phi|
    let x = Ratio {
        num: q.den * root - BEND * m2,
        den: den2 + 0.5 * m2,
    };
    let cos = x.num / x.den;
    let sin = (m / q.den) * (1.0 + BEND * cos);
    let reach = x.den + BEND * x.num;
    Circle {
        cos: cos.copysign(ahead),
        sin: sin.copysign(q.num),
        slope: [x.den * (x.num + BEND * x.den), reach * reach],
        x: Ratio {
            num: x.num.copysign(ahead),
            ..x
        },
    }
}

#[cfg(test)]
mod tests {
    use super::{Circle, Ratio, circle, quarters, slope};
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn goes_there_and_back_near_the_angle() {
        for k in -2000..=2000 {
            let q = f64::from(k) / 1000.0;
            let there = circle(Ratio {
                num: 0.7 * q,
                den: 0.7,
            });
            let Circle { cos, sin, .. } = there;
            assert!((there.x.num / there.x.den - cos).abs() < 1e-15, "{q}");
            assert!((cos.hypot(sin) - 1.0).abs() < 1e-15, "unit at {q}");
            let back = quarters(3.0 * cos, 3.0 * sin.abs(), 3.0);
            let found = back.num / back.den;
            // a few roundings
            assert!((found - q.abs()).abs() < 1e-14, "{q} came back as {found}");
            let slope = slope(3.0 * cos, 3.0) / back.den.powi(2);
            let [over, under] = there.slope;
            assert!((over / under / slope - 1.0).abs() < 1e-14, "{q}");
            let angle = sin.atan2(cos) / FRAC_PI_2;
            assert!((angle - q).abs() < 0.04 || k == -2000, "{q}: {angle}");
        }
    }

    #[test]
    fn slope_is_the_derivative_across_quadrants() {
        for k in 1..200 {
            let phi = f64::from(k) * PI / 200.0;
            let at = |phi: f64| quarters(phi.cos(), phi.sin(), 1.0);
            let value = |phi: f64| at(phi).num / at(phi).den;
            let slope = slope(phi.cos(), 1.0) / at(phi).den.powi(2);
            let numeric = (value(phi + 1e-6) - value(phi - 1e-6)) / 2e-6;
            // second differences: 1e-12, cancellation 1e-10
            assert!((numeric - slope).abs() < 1e-8, "{phi}");
        }
    }
}
