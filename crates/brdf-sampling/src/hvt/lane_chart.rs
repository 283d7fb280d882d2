//! The half-vector chart for packets of directions in f32: [`crate::chart`], symbol by symbol.
//!
//! Directions rounded to f32 leave the half vector uncertain by 1e-7, so that densities of lobes of width r0 agree
//! with the f64 form to some 1e-7 / r0.

use super::slices;
use crate::lane_math::{F, TINY, ZERO, circle, pseudo_exp, pseudo_log, quarters, quarters_slope};
use brdf::{LANES, Lanes3};

/// r0^2 and its inverse.
pub(crate) type Scale2 = [f32; 2];

/// Least Jacobian: densities divided by it stay finite.
const LEAST: f32 = 1e-30;

/// Viewer-dependent quantities.
pub(crate) struct Views {
    sin_o: F,
    cos_o: F,
    cos_phi: F,
    sin_phi: F,
    span: F,
    /// Slice coordinate of elevation, 0 to 1.
    pub(crate) tau: F,
}

impl Views {
    #[inline(always)]
    pub(crate) fn new(wo: &Lanes3, scale2: Scale2) -> Self {
        let mut v = Self {
            sin_o: ZERO,
            cos_o: ZERO,
            cos_phi: ZERO,
            sin_phi: ZERO,
            span: ZERO,
            tau: ZERO,
        };
        for k in 0..LANES {
            let r2 = wo.x[k] * wo.x[k] + wo.y[k] * wo.y[k];
            let r = r2.sqrt();
            let inv = 1.0 / r.max(TINY);
            let flat = r > TINY;
            v.cos_phi[k] = if flat { wo.x[k] * inv } else { 1.0 };
            v.sin_phi[k] = if flat { wo.y[k] * inv } else { 0.0 };
            let (s, c) = (r.min(1.0), wo.z[k].clamp(TINY, 1.0));
            // 1 - s without cancellation near grazing
            let min_cos_h = (0.5 * c * c / (1.0 + s)).sqrt();
            v.span[k] = pseudo_log(1.0 + (2.0 - 2.0 * min_cos_h) * scale2[1]).0;
            v.tau[k] = slices::tau(s, c);
            v.sin_o[k] = s;
            v.cos_o[k] = c;
        }
        v
    }
}

/// Where directions lie on the chart, and dwi / (da db).
pub(crate) struct Points {
    pub(crate) a: F,
    pub(crate) b: F,
    pub(crate) jacobian: F,
}

/// Fills the Jacobians of the points and returns their directions.
#[inline(always)]
pub(crate) fn forward(v: &Views, scale2: Scale2, points: &mut Points) -> Lanes3 {
    let mut wi = Lanes3::ZERO;
    for k in 0..LANES {
        let (minus_one, slope) = pseudo_exp(points.a[k] * v.span[k]);
        let r2 = scale2[0] * minus_one;
        let c = 1.0 - 0.5 * r2;
        let s2 = (r2 * (1.0 - 0.25 * r2)).max(0.0);
        let s = s2.sqrt();
        let [rim, den] = rim(v.sin_o[k], v.cos_o[k], [s2, c * c], s * c);
        let (cos_phi, sin_phi, stretch) = circle((2.0 * points.b[k] - 1.0) * rim, den);
        // wi = 2 (wo.h) h - wo is above the horizon, so wo.h is at least this; seen along the surface rounding takes
        // half vectors of narrow lobes below
        let least = 0.5 * v.cos_o[k] / c.max(v.cos_o[k]);
        let wo_h = (v.sin_o[k] * s * cos_phi + v.cos_o[k] * c).max(least);
        let x = 2.0 * wo_h * s * cos_phi - v.sin_o[k];
        let side = 2.0 * wo_h * s * sin_phi;
        wi.x[k] = x * v.cos_phi[k] - side * v.sin_phi[k];
        wi.y[k] = x * v.sin_phi[k] + side * v.cos_phi[k];
        wi.z[k] = (2.0 * wo_h * c - v.cos_o[k]).max(TINY);
        let radial = 4.0 * wo_h * (scale2[0] + r2) * v.span[k];
        let jacobian = radial * rim * stretch / (slope * den);
        points.jacobian[k] = jacobian.max(LEAST);
    }
    wi
}

#[inline(always)]
pub(crate) fn inverse(v: &Views, scale2: Scale2, wi: &Lanes3) -> Points {
    let mut p = Points {
        a: ZERO,
        b: ZERO,
        jacobian: ZERO,
    };
    for k in 0..LANES {
        let hx = wi.x[k] * v.cos_phi[k] + wi.y[k] * v.sin_phi[k] + v.sin_o[k];
        let hy = wi.y[k] * v.cos_phi[k] - wi.x[k] * v.sin_phi[k];
        let hz = wi.z[k].max(0.0) + v.cos_o[k];
        let len = (hx * hx + hy * hy + hz * hz).sqrt();
        // to unit length: light and viewer along the surface leave little, whose products would underflow
        let inv = 1.0 / len.max(TINY);
        let (hx, hy, hz) = (hx * inv, hy * inv, hz * inv);
        let (xy2, z2) = (hx * hx + hy * hy, hz * hz);
        let r2 = 2.0 * xy2 / (1.0 + hz);
        let (l, slope) = pseudo_log(1.0 + r2 * scale2[1]);
        let rho = xy2.sqrt().max(TINY);
        let [q, den] = quarters(hx, hy.abs(), rho);
        let [rim, rim_den] = rim(v.sin_o[k], v.cos_o[k], [xy2, z2], rho * hz);
        let here = q * rim_den;
        let there = (rim * den).max(here);
        p.a[k] = (l / v.span[k]).min(1.0);
        p.b[k] = 0.5 + (0.5 * here / there).copysign(hy);
        let radial = 2.0 * len * (scale2[0] + r2) * v.span[k];
        let jacobian = radial * there * den / (slope * (quarters_slope(hx, rho) * rim_den));
        p.jacobian[k] = jacobian.max(LEAST);
    }
    p
}

/// [`crate::chart`]'s rim: numerator and denominator of the quarters; `sc` is s c.
#[inline(always)]
fn rim(sin_o: f32, cos_o: f32, [s2, c2]: [f32; 2], sc: f32) -> [f32; 2] {
    let n = cos_o * (s2 - c2) - 2e-7 * (s2 + c2);
    let d2 = 4.0 * (sin_o * sin_o) * (s2 * c2);
    let y = (d2 - n * n).max(0.0).sqrt();
    let [num, den] = quarters(n, y, 2.0 * sin_o * sc);
    [num.max(1e-5 * den), den]
}
