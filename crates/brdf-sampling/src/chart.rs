//! The horizon-adapted half-vector chart: the hemisphere of `wi` as a unit square, for one `wo`.
//!
//! With wo = (si, 0, ci) (its azimuth rotated away), the half vector h = (s cos phi, s sin phi, c) and
//! r = 2 sin(theta_h / 2) (equal-area radius: c = 1 - r^2/2, dwh = d(r^2) dphi / 2):
//!
//! - a in [0, 1] is the radial coordinate: a = L(y) / L(y_max), y = 1 + r^2 / r0^2, with L the [`crate::pseudo_log`].
//!   Even in solid angle below r0, logarithmic above, up to r_max, where theta_h = (theta_o + 90 deg) / 2: beyond, no
//!   wi is above the horizon.
//! - b in [0, 1] is the azimuth: b = (1 + t / t_max) / 2 with t = sin(phi / 4), where phi_max(s) is the
//!   azimuth at which wi meets the horizon: cos phi_max = n/d, n = -ci (c^2 - s^2), d = 2 si s c.
//!
//! Every point of the square is a direction above the horizon and the reverse, so nothing is ever wasted. No
//! transcendental function is needed either way. The Jacobian is
//!
//! J = dwi / (da db) = 4 (wo.h) (1/2 d(r^2)/da) (4 / cos(phi/4)) (2 t_max).

use crate::pseudo_log::{pseudo_exp, pseudo_log};
use glam::{DVec2, DVec3};

/// Keeps wi a hair above the horizon where rounding would drop it below.
const MIN_COS: f64 = 1e-12;
/// Viewers whose sine is below this have no azimuth: its square would underflow.
const FLAT: f64 = 1e-100;

/// The chart of one viewer elevation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chart {
    sin_o: f64,
    cos_o: f64,
    /// r0^2 and its inverse.
    scale2: f64,
    inv_scale2: f64,
    /// L(y_max): a times this is L(y).
    span: f64,
    /// Cosine of the largest theta_h: sqrt((1 - si) / 2).
    pub(crate) min_cos_h: f64,
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

// Square roots and divisions are most of the cost of both directions, so squares of sines are carried as long
// as possible: cos^2(phi/4) = (1 + cos(phi/2)) / 2 and sin^2(phi/4) = sin^2(phi/2) / (2 (1 + cos(phi/2))).
impl Chart {
    /// The chart of a viewer at sin/cos `sin_o`, `cos_o` > 0, with radial scale `r0` > 0, radians.
    #[inline]
    pub(crate) fn new(sin_o: f64, cos_o: f64, r0: f64) -> Self {
        let scale2 = r0 * r0;
        Self::of(sin_o, cos_o, [scale2, 1.0 / scale2])
    }

    /// [`Self::new`] from the square of the radial scale and its inverse.
    #[inline(always)]
    pub(crate) fn of(sin_o: f64, cos_o: f64, [scale2, inv_scale2]: [f64; 2]) -> Self {
        let min_cos_h = (0.5 - 0.5 * sin_o).max(0.0).sqrt();
        let y_max = 1.0 + (2.0 - 2.0 * min_cos_h) * inv_scale2;
        Self {
            sin_o,
            cos_o,
            scale2,
            inv_scale2,
            span: pseudo_log(y_max).0,
            min_cos_h,
        }
    }

    /// From the square to the hemisphere.
    #[inline(always)]
    pub(crate) fn forward(&self, ab: DVec2) -> ChartPoint {
        let e = pseudo_exp(ab.x * self.span);
        let r2 = self.scale2 * e.minus_one;
        let c = 1.0 - 0.5 * r2;
        let s = (r2 * (1.0 - 0.25 * r2)).max(0.0).sqrt();
        let half_max = self.half_max(s, c);
        let cos_half_max = (1.0 - half_max).sqrt();
        let t_max = (0.5 * half_max / (1.0 + cos_half_max)).sqrt();
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
        let jacobian =
            16.0 * wo_h * (self.scale2 + r2) * self.span * t_max / (e.slope * cos_quarter);
        ChartPoint {
            wi,
            ab,
            jacobian: jacobian.max(f64::MIN_POSITIVE),
        }
    }

    /// From the hemisphere to the square; `wi` in the frame where wo has azimuth 0, wi.z > 0.
    #[inline]
    pub(crate) fn inverse(&self, wi: DVec3) -> ChartPoint {
        let h = DVec3::new(wi.x + self.sin_o, wi.y, wi.z + self.cos_o);
        let (ab, jacobian) = self.locate(h, DVec2::new(self.sin_o, 0.0));
        ChartPoint { wi, ab, jacobian }
    }

    /// (a, b) and the Jacobian of h = wi + wo in any frame about the normal, `v` being the horizontal part of wo there.
    /// Azimuths enter as products with `v`: no frame has to be made.
    #[inline(always)]
    pub(crate) fn locate(&self, h: DVec3, v: DVec2) -> (DVec2, f64) {
        let flat = self.sin_o < FLAT;
        let (v, v2) = if flat {
            (DVec2::X, 1.0)
        } else {
            (v, self.sin_o * self.sin_o)
        };
        let (xy2, hz) = (h.x * h.x + h.y * h.y, h.z);
        let len2 = xy2 + hz * hz;
        let (len, vh) = (len2.sqrt(), (v2 * xy2).sqrt().max(f64::MIN_POSITIVE));
        // 2 (1 - cos theta_h) = 2 xy^2 / (len (len + hz))
        let ratio = 2.0 * xy2 / (len2 + len * hz);
        let (l, slope) = pseudo_log(1.0 + ratio * self.inv_scale2);
        // the larger of sine and cosine of phi/2 is a root, the other follows from their product
        let inv = 0.5 / (vh * hz).max(f64::MIN_POSITIVE);
        let dot = h.x * v.x + h.y * v.y;
        let cross = h.y * v.x - h.x * v.y;
        let inv_vh = inv * hz;
        let large = ((vh + dot.abs()) * inv_vh).clamp(0.5, 1.0).sqrt();
        let small = (cross.abs() * inv_vh / large).min(large);
        let (cos_half, sin_half) = if dot >= 0.0 {
            (large, small)
        } else {
            (small, large)
        };
        // sin^2(phi_max / 2) = (d - n) / (2 d) as in `half_max`, with d = 2 vh hz
        let d = 2.0 * vh * hz;
        let n = self.cos_o * (xy2 - hz * hz);
        let half_max = if flat {
            1.0
        } else {
            ((d - n + 1e-15 * len2) * (0.5 * inv)).min(1.0)
        };
        // wi is above the horizon, so phi <= phi_max; at the rim rounding may say otherwise by far
        let half_max = half_max.max(sin_half * sin_half).max(MIN_HALF);
        let one_plus_max = 1.0 + (1.0 - half_max).max(0.0).sqrt();
        let one_plus = 1.0 + cos_half;
        // t / t_max and t_max / cos(phi/4), by one division and one root
        let root = (1.0 / (half_max * one_plus_max * one_plus)).sqrt();
        let across = (sin_half * one_plus_max * root).min(1.0);
        let reach = half_max * root;
        let ab = DVec2::new((l / self.span).min(1.0), 0.5 + 0.5 * across.copysign(cross));
        // wo.h = |wi + wo| / 2
        let jacobian = 8.0 * len * (self.scale2 + ratio) * self.span * reach / slope;
        (ab, jacobian.max(f64::MIN_POSITIVE))
    }

    /// sin^2(phi_max / 2) = (d - n) / (2 d), for sine and cosine of theta_h or any multiple of both. Where
    /// n <= -d, phi_max is pi: the ratio is then 1 or more, so the clamp is all it takes. Seen from the normal
    /// d is 0 and the rim is where n is: a rounding is added so that it stays on the inner side.
    #[inline]
    fn half_max(&self, s: f64, c: f64) -> f64 {
        let n = -self.cos_o * (c - s) * (c + s);
        let d = 2.0 * self.sin_o * s * c;
        let rounding = 1e-15 * (s * s + c * c);
        (0.5 * (d - n + rounding) / d.max(f64::MIN_POSITIVE)).clamp(MIN_HALF, 1.0)
    }
}

/// Lower bound of sin^2(phi_max / 2), reached only at the rim a = 1.
const MIN_HALF: f64 = 1e-18;

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
