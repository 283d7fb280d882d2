//! The horizon-adapted half-vector chart: the hemisphere of `wi` as a unit square, for one `wo`.
//!
//! With wo = (si, 0, ci) (its azimuth rotated away), the half vector h = (s cos phi, s sin phi, c) and
//! r = 2 sin(theta_h / 2) (equal-area radius: c = 1 - r^2/2, dwh = d(r^2) dphi / 2):
//!
//! - a in [0, 1] is the radial coordinate: a = L(y) / L(y_max), y = 1 + r^2 / r0^2, with L the [`crate::pseudo_log`].
//!   Even in solid angle below r0, logarithmic above, up to r_max, where theta_h = (theta_o + 90 deg) / 2: beyond, no
//!   wi is above the horizon.
//! - b in [0, 1] is the azimuth: b = (1 + q / q_max) / 2 with q(phi) the [`crate::pseudo_angle`], where phi_max(s) is
//!   the azimuth at which wi meets the horizon: cos phi_max = n/d, n = -ci (c^2 - s^2), d = 2 si s c.
//!
//! Every point of the square is a direction above the horizon and the reverse, so nothing is ever wasted. No
//! transcendental function is needed either way. The Jacobian is
//!
//! J = dwi / (da db) = 4 (wo.h) (1/2 d(r^2)/da) (dphi/dq) (2 q_max).

use crate::pseudo_angle::{self, Ratio, circle, quarters};
use crate::pseudo_log::{Logarithm, pseudo_exp, pseudo_log};
use glam::{DVec2, DVec3};

/// Keeps wi a hair above the horizon where rounding would drop it below.
const MIN_COS: f64 = 1e-12;
/// Added to the horizontal part of viewers, so that those straight along the normal have azimuth 0.
const AHEAD: f64 = 1e-30;
/// Least product of the horizontal parts of viewer and half vector: keeps fractions defined where both are 0.
const MIN_RHO: f64 = 1e-60;
/// Least quarters to the rim, reached only at a = 1.
const MIN_RIM: f64 = 1e-9;
/// Bound of 1/J: the Jacobian vanishes at the rim, where rounding may also turn its sign.
const MAX_DENSITY: f64 = 1e300;

/// The chart of one viewer elevation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chart {
    sin_o: f64,
    cos_o: f64,
    /// r0^2 and its inverse.
    scale2: f64,
    inv_scale2: f64,
    /// L(y_max): a times this is L(y).
    span: Logarithm,
}

/// A point of the chart in both descriptions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChartPoint {
    /// Direction toward the light, in the frame where wo has azimuth 0.
    pub(crate) wi: DVec3,
    /// (a, b) in the unit square.
    pub(crate) ab: DVec2,
    /// da db / dwi, > 0: the reciprocal of the Jacobian J.
    pub(crate) density: f64,
}

impl ChartPoint {
    /// J = dwi / (da db), > 0.
    #[inline]
    pub(crate) fn jacobian(&self) -> f64 {
        1.0 / self.density
    }
}

// What a density costs is the chain of roots and divisions that wait for each other. So quotients stay fractions until
// they are needed, each coordinate is divided once, and none of the two waits for the other.
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
        // the cosine of the largest theta_h
        let min_cos_h = (0.5 - 0.5 * sin_o).max(0.0).sqrt();
        let y_max = (1.0 + 2.0 * inv_scale2) - (2.0 * inv_scale2) * min_cos_h;
        Self {
            sin_o,
            cos_o,
            scale2,
            inv_scale2,
            span: pseudo_log(y_max),
        }
    }

    /// From the square to the hemisphere.
    #[inline(always)]
    pub(crate) fn forward(&self, ab: DVec2) -> ChartPoint {
        let (wi, density) = self.direction(
            ab.x,
            Ratio {
                num: 2.0 * ab.y - 1.0,
                den: 1.0,
            },
        );
        ChartPoint { wi, ab, density }
    }

    /// wi and 1/J at (a, b), `side` being 2 b - 1.
    #[inline(always)]
    pub(crate) fn direction(&self, a: f64, side: Ratio) -> (DVec3, f64) {
        let span = self.span.num / self.span.den;
        let e = pseudo_exp(a * span);
        let r2 = self.scale2 * e.minus_one;
        let c = 1.0 - 0.5 * r2;
        let s2 = (r2 * (1.0 - 0.25 * r2)).max(0.0);
        let s = s2.sqrt();
        let rim = self.rim([s2, c * c, 1.0], self.sin_o * s * c, self.sin_o);
        let q = Ratio {
            num: side.num * rim.num,
            den: side.den * rim.den,
        };
        let phi = circle(q);
        let (ahead, up) = (self.sin_o * s, self.cos_o * c);
        let wo_h = ahead * phi.cos + up;
        // doubled beforehand: what waits for wo.h waits for one product
        let across = wo_h * (2.0 * s);
        let wi = DVec3::new(
            across * phi.cos - self.sin_o,
            across * phi.sin,
            (wo_h * (2.0 * c) - self.cos_o).max(MIN_COS),
        );
        // wo.h as a fraction again, so that this quotient does not wait for the one in phi
        let wo_h = ahead * phi.x.num + up * phi.x.den;
        let [over, under] = phi.slope;
        let radial = 4.0 * (self.scale2 + r2) * span * rim.num;
        let density = (e.slope * rim.den) * (over * phi.x.den) / (radial * (wo_h * under));
        (wi, density.abs().min(MAX_DENSITY))
    }

    /// From the hemisphere to the square; `wi` in the frame where wo has azimuth 0, wi.z > 0.
    #[inline]
    pub(crate) fn inverse(&self, wi: DVec3) -> ChartPoint {
        let h = DVec3::new(wi.x + self.sin_o, wi.y, wi.z + self.cos_o);
        let (ab, density) = self.locate(h, DVec2::new(self.sin_o, 0.0));
        ChartPoint { wi, ab, density }
    }

    /// (a, b) and 1/J of h = wi + wo in any frame about the normal, `v` being the horizontal part of wo there.
    /// Azimuths enter as products with `v`: no frame has to be made.
    #[inline(always)]
    pub(crate) fn locate(&self, h: DVec3, v: DVec2) -> (DVec2, f64) {
        let (xy2, z2) = (h.x * h.x + h.y * h.y, h.z * h.z);
        let len2 = xy2 + z2;
        let len = len2.sqrt();
        // 2 (1 - cos theta_h) = 2 xy^2 / (len (len + hz))
        let r2 = 2.0 * xy2 / (len2 + len * h.z);
        let l = pseudo_log(1.0 + r2 * self.inv_scale2);
        let vx = v.x + AHEAD;
        let rho = ((vx * vx + v.y * v.y) * xy2).sqrt().max(MIN_RHO);
        let (dot, cross) = (h.x * vx + h.y * v.y, h.y * vx - h.x * v.y);
        let q = quarters(dot, cross.abs(), rho);
        let rim = self.rim([xy2, z2, len2], rho * h.z, self.sin_o + AHEAD);
        // wi is above the horizon, so |q| <= q_max; at the rim rounding may say otherwise by far
        let here = q.num * rim.den;
        let there = rim.num * q.den;
        let there = if there > here { there } else { here };
        let ab = DVec2::new(
            (l.num * self.span.den / (l.den * self.span.num)).min(1.0),
            0.5 + (0.5 * here / there).copysign(cross),
        );
        // wo.h = |wi + wo| / 2, q_max = there / (q.den rim.den)
        let over = (l.slope * self.span.den) * (pseudo_angle::slope(dot, rho) * rim.den);
        let radial = (2.0 * len) * (self.scale2 + r2) * self.span.num;
        let under = (radial * (l.den * l.den)) * (q.den * there);
        (ab, (over / under).abs().min(MAX_DENSITY))
    }

    /// Quarters to the azimuth where wi meets the horizon, for the squares of sine and cosine of theta_h and their sum, or any
    /// multiple of them; `half_d` is si s c in the same measure, with `si` in whatever measure that has. Seen from the
    /// normal d is 0 and the rim is where n is: a rounding is taken off so that it stays on the inner side.
    #[inline(always)]
    fn rim(&self, [s2, c2, unit]: [f64; 3], half_d: f64, sin_o: f64) -> Ratio {
        let n = self.cos_o * (s2 - c2) - 1e-15 * unit;
        let d2 = (4.0 * sin_o * sin_o) * (s2 * c2);
        let y = (d2 - n * n).max(0.0).sqrt();
        let q = quarters(n, y, 2.0 * half_d);
        let least = MIN_RIM * q.den;
        Ratio {
            num: if q.num > least { q.num } else { least },
            ..q
        }
    }
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
                    let ratio = there.density / back.density;
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
                    sum += 2.0 * x * chart.forward(ab).jacobian();
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
