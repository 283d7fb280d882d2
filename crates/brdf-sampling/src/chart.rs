//! The horizon-adapted half-vector chart: the hemisphere of `wi` as a unit square, for one `wo`.
//!
//! With wo = (si, 0, ci) (its azimuth rotated away), the half vector h = (s cos phi, s sin phi, c) and
//! r = 2 sin(theta_h / 2) (equal-area radius: c = 1 - r^2/2, dwh = r dr dphi):
//!
//! - a in [0, 1] is the radial coordinate: a = L(y) / L(y_max), y = (r + sqrt(r^2 + r0^2)) / r0, with L the
//!   [`crate::pseudo_log`] (L(y) ~ asinh(r/r0) / ln 2). Linear in r below r0, logarithmic above, up to r_max,
//!   where theta_h = (theta_o + 90 deg) / 2: beyond, no wi is above the horizon.
//! - b in [0, 1] is the azimuth: b = (1 + t / t_max) / 2 with t = sin(phi / 4), where phi_max(s) is the
//!   azimuth at which wi meets the horizon: cos phi_max = n/d, n = -ci (c^2 - s^2), d = 2 si s c.
//!
//! Every point of the square is a direction above the horizon and the reverse, so nothing is ever wasted. No
//! transcendental function is needed either way. The Jacobian is
//!
//! J = dwi / (da db) = 4 (wo.h) r (dr/da) (4 / cos(phi/4)) (2 t_max).

use crate::pseudo_log::{pseudo_exp, pseudo_log};
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_1_SQRT_2;

/// Keeps wi a hair above the horizon where rounding would drop it below.
const MIN_COS: f64 = 1e-12;

/// The chart of one viewer elevation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chart {
    sin_o: f64,
    cos_o: f64,
    r0: f64,
    /// L(y_max): a times this is L(y).
    span: f64,
}

/// A point of the chart in both descriptions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChartPoint {
    /// Direction toward the light, in the frame where wo has azimuth 0.
    pub(crate) wi: DVec3,
    /// (a, b) in the unit square.
    pub(crate) ab: DVec2,
    /// dwi / (da db), > 0.
    pub(crate) jacobian: f64,
}

impl Chart {
    /// The chart of a viewer at sin/cos `sin_o`, `cos_o` > 0, with radial scale `r0` > 0, radians.
    #[inline]
    pub(crate) fn new(sin_o: f64, cos_o: f64, r0: f64) -> Self {
        // cos of the largest theta_h is sqrt((1 - si)/2); 1 - si = ci^2 / (1 + si)
        let c_min = cos_o / (2.0 + 2.0 * sin_o).sqrt();
        let r2 = 2.0 - 2.0 * c_min;
        let y_max = (r2.sqrt() + (r2 + r0 * r0).sqrt()) / r0;
        Self {
            sin_o,
            cos_o,
            r0,
            span: pseudo_log(y_max).0,
        }
    }

    /// From the square to the hemisphere.
    #[inline]
    pub(crate) fn forward(&self, ab: DVec2) -> ChartPoint {
        let (y, y_slope) = pseudo_exp(ab.x * self.span);
        // (y - 1/y) / 2 without cancellation at y = 1
        let r = 0.5 * self.r0 * (y - 1.0) * (y + 1.0) / y;
        let root = 0.5 * self.r0 * (y + 1.0 / y);
        let c = 1.0 - 0.5 * r * r;
        let s = r * (1.0 - 0.25 * r * r).max(0.0).sqrt();
        let t_max = self.t_max(s, c);
        let t = (2.0 * ab.y - 1.0) * t_max;
        let cos_quarter = (1.0 - t * t).sqrt();
        let sin_half = 2.0 * t * cos_quarter;
        let cos_half = 1.0 - 2.0 * t * t;
        let (sin_phi, cos_phi) = (2.0 * sin_half * cos_half, 1.0 - 2.0 * sin_half * sin_half);
        let wo_h = self.sin_o * s * cos_phi + self.cos_o * c;
        let wi = DVec3::new(
            2.0 * wo_h * s * cos_phi - self.sin_o,
            2.0 * wo_h * s * sin_phi,
            (2.0 * wo_h * c - self.cos_o).max(MIN_COS),
        );
        let jacobian = self.jacobian(wo_h * r, root / y_slope, cos_quarter, t_max);
        ChartPoint { wi, ab, jacobian }
    }

    /// From the hemisphere to the square; `wi` in the frame where wo has azimuth 0, wi.z > 0.
    #[inline]
    pub(crate) fn inverse(&self, wi: DVec3) -> ChartPoint {
        let hx = wi.x + self.sin_o;
        let hz = wi.z + self.cos_o;
        let xy2 = hx * hx + wi.y * wi.y;
        let len2 = xy2 + hz * hz;
        let len = len2.sqrt();
        let inv_len = 1.0 / len;
        let xy = xy2.sqrt();
        let s = xy * inv_len;
        let c = hz * inv_len;
        // 2 (1 - c) = 2 xy^2 / (len (len + hz))
        let r2 = 2.0 * xy2 / (len2 + len * hz);
        let r = r2.sqrt();
        let root = (r2 + self.r0 * self.r0).sqrt();
        let (l, y_slope) = pseudo_log(((r + root) / self.r0).max(1.0));
        let t_max = self.t_max(s, c);
        let t = quarter_sine(hx, wi.y, xy);
        let cos_quarter = (1.0 - t * t).sqrt();
        let ab = DVec2::new(
            (l / self.span).min(1.0),
            (0.5 + 0.5 * t / t_max).clamp(0.0, 1.0),
        );
        // wo.h = |wi + wo| / 2
        let jacobian = self.jacobian(0.5 * len * r, root / y_slope, cos_quarter, t_max);
        ChartPoint { wi, ab, jacobian }
    }

    /// sin(phi_max / 4): from 1 - cos phi_max = (d - n) / d, branching before dividing.
    #[inline]
    fn t_max(&self, s: f64, c: f64) -> f64 {
        let n = -self.cos_o * (c - s) * (c + s);
        let d = 2.0 * self.sin_o * s * c;
        if n <= -d {
            return FRAC_1_SQRT_2;
        }
        let half = (0.5 * (d - n) / d).max(MIN_T * MIN_T); // sin^2(phi_max / 2)
        quarter(half.sqrt(), (1.0 - half).max(0.0).sqrt())
    }

    #[inline]
    fn jacobian(&self, wo_h_r: f64, dr_dl: f64, cos_quarter: f64, t_max: f64) -> f64 {
        (32.0 * wo_h_r * dr_dl * self.span * t_max / cos_quarter).max(f64::MIN_POSITIVE)
    }
}

/// Lower bound of sin(phi_max / 2), reached only at the rim a = 1.
const MIN_T: f64 = 1e-9;

/// sin(x/2) from sin x and cos x, x in [-pi/2, pi/2].
#[inline]
fn quarter(sin: f64, cos: f64) -> f64 {
    sin * FRAC_1_SQRT_2 / (1.0 + cos).sqrt()
}

/// sin(phi / 4) of the vector (x, y) of length r, phi in (-pi, pi]; 0 for r = 0.
#[inline]
fn quarter_sine(x: f64, y: f64, r: f64) -> f64 {
    if r <= 0.0 {
        return 0.0;
    }
    // (cos, sin)(phi/2) is parallel to (r + x, y) and to (|y|, r - x): take the one without cancellation
    let (cos, sin) = if x >= 0.0 {
        (r + x, y)
    } else {
        (y.abs(), (r - x).copysign(y))
    };
    let inv = 1.0 / (cos * cos + sin * sin).sqrt();
    quarter(sin * inv, cos * inv)
}

#[cfg(test)]
mod tests {
    use super::Chart;
    use brdf::direction;
    use glam::{DVec2, DVec3};

    fn charts() -> impl Iterator<Item = (DVec3, Chart)> {
        [0.0, 1e-9, 0.3, 0.8, 1.2, 1.5, 1.5706]
            .into_iter()
            .flat_map(|theta: f64| {
                [7e-4, 0.02, 0.5].map(|r0| {
                    let wo = direction(theta, 0.0);
                    (wo, Chart::new(theta.sin(), theta.cos(), r0))
                })
            })
    }

    #[test]
    fn goes_there_and_back() {
        for (wo, chart) in charts() {
            for i in 0..40 {
                for j in 0..40 {
                    let ab = DVec2::new((f64::from(i) + 0.5) / 40.0, (f64::from(j) + 0.5) / 40.0);
                    let there = chart.forward(ab);
                    let back = chart.inverse(there.wi);
                    assert!(there.wi.z > 0.0, "below the horizon at {ab}");
                    assert!((there.wi.length() - 1.0).abs() < 1e-12, "length at {ab}");
                    // near grazing the horizon angle is a ratio of small numbers
                    assert!((back.ab - ab).length() < 1e-8, "{wo}: {ab} -> {}", back.ab);
                    let ratio = back.jacobian / there.jacobian;
                    assert!((ratio - 1.0).abs() < 1e-7, "{wo} {ab}: {ratio}");
                }
            }
        }
    }

    #[test]
    fn jacobian_integrates_to_the_hemisphere() {
        let n = 400;
        for (wo, chart) in charts() {
            let mut sum = 0.0;
            for i in 0..n {
                for j in 0..64 {
                    // 1 - x^2 takes the square-root end at the rim away
                    let x = (f64::from(i) + 0.5) / f64::from(n);
                    let ab = DVec2::new(1.0 - x * x, (f64::from(j) + 0.5) / 64.0);
                    sum += 2.0 * x * chart.forward(ab).jacobian;
                }
            }
            let area = sum / f64::from(n * 64);
            // midpoint rule, 64 points across
            assert!(
                (area / std::f64::consts::TAU - 1.0).abs() < 3e-4,
                "{wo}: {area}"
            );
        }
    }
}
