//! A stand-in for the azimuth: one root and one division where the arctangent would be.
//!
//! With phi in its quadrant folded to [0, 90 deg], sigma = |sin 2 phi|,
//!
//! w = -cos 2 phi / (1 + sigma / sqrt2),  m = (1 + w) / 2 in [0, 1],
//!
//! and q counts quarters: m, or 2 - m behind, with the sign of the sine. The factor 1 / sqrt2 is the one that leaves
//! the second derivative continuous where quadrants meet: dq/dphi = g (2 - g) / sqrt2 with g = 1 / (1 + sigma / sqrt2), between
//! 0.59 and 0.71 per radian. As a ratio, tan phi = 2 m / (sqrt(1 - w^2 / 2) - w / sqrt2).

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// Least quarters to the rim, reached only at a = 1.
const MIN_RIM: f64 = 1e-9;

/// The quarters |q| of the direction (x, y), of any length, and g.
#[inline(always)]
pub(crate) fn quarters(x: f64, y: f64) -> (f64, f64) {
    let (ax, ay) = (x.abs(), y.abs());
    let rho2 = (x * x + y * y).max(f64::MIN_POSITIVE);
    let inv = 1.0 / (rho2 + SQRT_2 * (ax * ay));
    let m = ay * (ay + FRAC_1_SQRT_2 * ax) * inv;
    (fold(x, m), rho2 * inv)
}

/// The quarters of the angle in [0, 180 deg] whose cosine is n / d: 0 where n >= d, 2 where n <= -d.
#[inline(always)]
pub(crate) fn quarters_of_cosine(n: f64, d2: f64) -> f64 {
    let (an, y2) = (n.abs(), (d2 - n * n).max(0.0));
    let y = y2.sqrt();
    let m = (y2 + FRAC_1_SQRT_2 * (an * y)) / (d2 + SQRT_2 * (an * y)).max(f64::MIN_POSITIVE);
    fold(n, m).max(MIN_RIM)
}

/// m counted on from the front, or back from behind; without a branch, for signs are random.
#[inline(always)]
fn fold(x: f64, m: f64) -> f64 {
    (1.0 - 1.0_f64.copysign(x)) + m.copysign(x)
}

/// What [`circle`] finds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) cos: f64,
    pub(crate) sin: f64,
    /// 1 / (g (2 - g)) as a fraction.
    pub(crate) stretch: [f64; 2],
}

/// The angle of `q` quarters, -2 to 2.
#[inline(always)]
pub(crate) fn circle(q: f64) -> Circle {
    let ahead = 1.0 - q.abs();
    let w = 1.0 - 2.0 * ahead.abs();
    let y = 1.0 + w;
    let x = (1.0 - 0.5 * w * w).sqrt() - FRAC_1_SQRT_2 * w;
    let n2 = x * x + y * y;
    let inv = 1.0 / n2.sqrt();
    let d = n2 + SQRT_2 * (x * y);
    Circle {
        cos: (x * inv).copysign(ahead),
        sin: (y * inv).copysign(q),
        stretch: [d * d, n2 * (2.0 * d - n2)],
    }
}

#[cfg(test)]
mod tests {
    use super::{circle, quarters, quarters_of_cosine};
    use std::f64::consts::{FRAC_PI_2, SQRT_2};

    #[test]
    fn goes_there_and_back_near_the_angle() {
        for k in -2000..=2000 {
            let q = f64::from(k) / 1000.0;
            let c = circle(q);
            assert!((c.cos.hypot(c.sin) - 1.0).abs() < 1e-15, "unit at {q}");
            let (back, g) = quarters(3.0 * c.cos, 3.0 * c.sin);
            // quarters are even to rounding; at 180 degrees the sine is 0
            assert!((back - q.abs()).abs() < 1e-14, "{q} came back as {back}");
            let stretch = c.stretch[0] / c.stretch[1];
            assert!((stretch * g * (2.0 - g) - 1.0).abs() < 1e-14, "{q}");
            let rim = quarters_of_cosine(2.0 * c.cos, 4.0);
            // the root of a difference, 1e-8 where the sine vanishes
            assert!((rim - q.abs()).abs() < 3e-8, "{q} of its cosine: {rim}");
            let angle = c.sin.atan2(c.cos) / FRAC_PI_2;
            assert!(
                (angle - q).abs() < 0.0145 || k == -2000,
                "{q} is near {angle}"
            );
        }
        assert!(
            (quarters_of_cosine(-1.0, 0.5) - 2.0).abs() < 1e-15,
            "no rim"
        );
        assert!(quarters_of_cosine(1.0, 0.5) < 1e-8, "beyond the rim");
    }

    #[test]
    fn slope_is_the_derivative_across_quadrants() {
        for k in 1..200 {
            let phi = f64::from(k) * std::f64::consts::PI / 200.0;
            let at = |phi: f64| quarters(phi.cos(), phi.sin());
            let g = at(phi).1;
            let numeric = (at(phi + 1e-6).0 - at(phi - 1e-6).0) / 2e-6;
            // second differences: 1e-12, cancellation 1e-10
            assert!((numeric - g * (2.0 - g) / SQRT_2).abs() < 1e-8, "{phi}");
        }
    }
}
