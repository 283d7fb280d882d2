//! The same density for packets of directions in f32: arithmetic in loops over lanes the compiler vectorises,
//! look-ups lane by lane.
//!
//! Formulas as in [`crate::chart`], symbol by symbol. Directions rounded to f32 leave the half vector uncertain
//! by 1e-7, so that densities of lobes of width r0 agree with the f64 form to some 1e-7 / r0.

use super::table::Table;
use brdf::{LANES, Lanes3, SampleLanes};
use std::f32::consts::{FRAC_1_PI, FRAC_1_SQRT_2, SQRT_2, TAU};

type F = [f32; LANES];

/// A lane's worth of zeros.
const ZERO: F = [0.0; LANES];
/// Keeps wi above the horizon, and divisors away from 0.
const TINY: f32 = 1e-12;

/// Viewer-dependent quantities.
struct Views {
    sin_o: F,
    cos_o: F,
    cos_phi: F,
    sin_phi: F,
    span: F,
    /// Slice coordinate, 0 to `n_theta` - 1.
    slice: F,
}

impl Views {
    #[inline]
    fn new(wo: &Lanes3, r0: f32, n_theta: usize) -> Self {
        let mut v = Self {
            sin_o: ZERO,
            cos_o: ZERO,
            cos_phi: ZERO,
            sin_phi: ZERO,
            span: ZERO,
            slice: ZERO,
        };
        let (inv_r0, slices) = (1.0 / r0, (n_theta - 1) as f32);
        for k in 0..LANES {
            let r2 = wo.x[k] * wo.x[k] + wo.y[k] * wo.y[k];
            let r = r2.sqrt();
            let inv = 1.0 / r.max(TINY);
            let flat = r > TINY;
            v.cos_phi[k] = if flat { wo.x[k] * inv } else { 1.0 };
            v.sin_phi[k] = if flat { wo.y[k] * inv } else { 0.0 };
            let (s, c) = (r.min(1.0), wo.z[k].clamp(TINY, 1.0));
            let c_min = (0.5 - 0.5 * s).sqrt();
            let max2 = 2.0 - 2.0 * c_min;
            v.span[k] = pseudo_log((max2.sqrt() + (max2 + r0 * r0).sqrt()) * inv_r0).0;
            let tau = 1.0 - (1.0 - (1.0 - c).sqrt()).max(0.0).sqrt();
            v.slice[k] = tau * slices;
            v.sin_o[k] = s;
            v.cos_o[k] = c;
        }
        v
    }
}

/// Where a direction lies on the chart, and dwi / (da db).
struct Points {
    a: F,
    b: F,
    jacobian: F,
}

/// Densities of `wi`; 0 where either direction is below the horizon.
#[inline]
pub(crate) fn pdf(table: &Table, r0: f32, wi: &Lanes3, wo: &Lanes3) -> F {
    let views = Views::new(wo, r0, table.shape.n_theta);
    let points = inverse(&views, r0, wi);
    let (mut body, mut lobe) = (ZERO, ZERO);
    for k in 0..LANES {
        let place = table.place_at(views.slice[k]);
        body[k] = table.density(place, points.a[k], points.b[k]);
        lobe[k] = table.lobe_at(place);
    }
    let mut out = ZERO;
    for k in 0..LANES {
        let above = wi.z[k] > 0.0 && wo.z[k] > 0.0;
        let p = lobe[k] * FRAC_1_PI * wi.z[k] + body[k] / points.jacobian[k];
        out[k] = if above { p } else { 0.0 };
    }
    out
}

/// Directions and their densities.
#[inline]
pub(crate) fn sample(table: &Table, r0: f32, wo: &Lanes3, u: &[F; 2]) -> SampleLanes {
    let views = Views::new(wo, r0, table.shape.n_theta);
    let mut points = Points {
        a: ZERO,
        b: ZERO,
        jacobian: ZERO,
    };
    let (mut body, mut lobe, mut from_lobe) = (ZERO, ZERO, [false; LANES]);
    for k in 0..LANES {
        let place = table.place_at(views.slice[k]);
        lobe[k] = table.lobe_at(place);
        from_lobe[k] = u[0][k] >= 1.0 - lobe[k];
        let (a, b) = table.invert(place, u[0][k].min(1.0 - lobe[k]), u[1][k]);
        (points.a[k], points.b[k]) = (a, b);
        body[k] = table.density(place, a, b);
    }
    let mut wi = forward(&views, r0, &mut points);
    if from_lobe.contains(&true) {
        replace_by_cosine(&mut wi, &from_lobe, &lobe, u);
        let inverted = inverse(&views, r0, &wi);
        for k in (0..LANES).filter(|k| from_lobe[*k]) {
            let place = table.place_at(views.slice[k]);
            body[k] = table.density(place, inverted.a[k], inverted.b[k]);
            points.jacobian[k] = inverted.jacobian[k];
        }
    }
    let mut out = ZERO;
    for k in 0..LANES {
        let p = lobe[k] * FRAC_1_PI * wi.z[k] + body[k] / points.jacobian[k];
        out[k] = if wo.z[k] > 0.0 { p } else { 0.0 };
    }
    SampleLanes { wi, pdf: out }
}

/// The lanes that drew the cosine lobe.
fn replace_by_cosine(wi: &mut Lanes3, chosen: &[bool; LANES], lobe: &F, u: &[F; 2]) {
    for k in (0..LANES).filter(|k| chosen[*k]) {
        let x = ((u[0][k] - (1.0 - lobe[k])) / lobe[k]).clamp(0.0, 1.0);
        let (sin, cos) = (TAU * u[1][k]).sin_cos();
        wi.x[k] = x.sqrt() * cos;
        wi.y[k] = x.sqrt() * sin;
        wi.z[k] = (1.0 - x).sqrt().max(TINY);
    }
}

/// Fills the Jacobians of the points and returns their directions.
#[inline]
fn forward(v: &Views, r0: f32, points: &mut Points) -> Lanes3 {
    let mut wi = Lanes3::ZERO;
    for k in 0..LANES {
        let (y, y_slope) = pseudo_exp(points.a[k] * v.span[k]);
        let inv_y = 1.0 / y;
        let r = 0.5 * r0 * (y - 1.0) * (y + 1.0) * inv_y;
        let root = 0.5 * r0 * (y + inv_y);
        let c = 1.0 - 0.5 * r * r;
        let s = r * (1.0 - 0.25 * r * r).max(0.0).sqrt();
        let max = half_max(v.sin_o[k], v.cos_o[k], s, c);
        let t_max = (0.5 * max / (1.0 + (1.0 - max).sqrt())).sqrt();
        let t = (2.0 * points.b[k] - 1.0) * t_max;
        let cos_quarter = (1.0 - t * t).sqrt();
        let sin_half = 2.0 * t * cos_quarter;
        let sin_phi = 2.0 * sin_half * (1.0 - 2.0 * t * t);
        let cos_phi = 1.0 - 2.0 * sin_half * sin_half;
        let wo_h = v.sin_o[k] * s * cos_phi + v.cos_o[k] * c;
        let x = 2.0 * wo_h * s * cos_phi - v.sin_o[k];
        let side = 2.0 * wo_h * s * sin_phi;
        wi.x[k] = x * v.cos_phi[k] - side * v.sin_phi[k];
        wi.y[k] = x * v.sin_phi[k] + side * v.cos_phi[k];
        wi.z[k] = (2.0 * wo_h * c - v.cos_o[k]).max(TINY);
        let jacobian = 32.0 * wo_h * r * root * v.span[k] * t_max / (y_slope * cos_quarter);
        points.jacobian[k] = jacobian.max(f32::MIN_POSITIVE);
    }
    wi
}

#[inline]
fn inverse(v: &Views, r0: f32, wi: &Lanes3) -> Points {
    let mut p = Points {
        a: ZERO,
        b: ZERO,
        jacobian: ZERO,
    };
    let inv_r0 = 1.0 / r0;
    for k in 0..LANES {
        let hx = wi.x[k] * v.cos_phi[k] + wi.y[k] * v.sin_phi[k] + v.sin_o[k];
        let hy = wi.y[k] * v.cos_phi[k] - wi.x[k] * v.sin_phi[k];
        let hz = wi.z[k].max(0.0) + v.cos_o[k];
        let xy2 = hx * hx + hy * hy;
        let len2 = xy2 + hz * hz;
        let (len, xy) = (len2.sqrt(), xy2.sqrt());
        let r = xy * (2.0 / (len2 + len * hz)).sqrt();
        let root = (r * r + r0 * r0).sqrt();
        let (l, y_slope) = pseudo_log(((r + root) * inv_r0).max(1.0));
        let e = xy + hx.abs();
        let inv = 1.0 / (2.0 * xy * e).max(f32::MIN_POSITIVE);
        let (large, small) = ((e * e * inv).min(1.0), (hy * hy * inv).min(1.0));
        let ahead = hx >= 0.0;
        let cos2 = if ahead { large } else { small };
        let sin2 = if ahead { small } else { large };
        let max = half_max(v.sin_o[k], v.cos_o[k], xy, hz).max(sin2);
        let one_plus_max = 1.0 + (1.0 - max).sqrt();
        let one_plus = 1.0 + cos2.sqrt();
        let ratio = (sin2 * one_plus_max / (one_plus * max)).sqrt().min(1.0);
        let reach = (max / (one_plus_max * one_plus)).sqrt();
        p.a[k] = (l / v.span[k]).min(1.0);
        p.b[k] = 0.5 + 0.5 * ratio.copysign(hy);
        let jacobian = 16.0 * len * r * root * v.span[k] * reach / y_slope;
        p.jacobian[k] = jacobian.max(f32::MIN_POSITIVE);
    }
    p
}

#[inline]
fn half_max(sin_o: f32, cos_o: f32, s: f32, c: f32) -> f32 {
    let n = -cos_o * (c - s) * (c + s);
    let d = 2.0 * sin_o * s * c;
    let rounding = 2e-7 * (s * s + c * c);
    (0.5 * (d - n + rounding) / d.max(f32::MIN_POSITIVE)).clamp(1e-10, 1.0)
}

#[inline]
fn pseudo_log(x: f32) -> (f32, f32) {
    let bits = x.to_bits();
    let e = ((bits >> 23).cast_signed() - 127) as f32;
    let m = f32::from_bits((bits & 0x007f_ffff) | 0x3f80_0000) - 1.0;
    let inverse = 1.0 / (1.0 + (SQRT_2 - 1.0) * m);
    let slope = SQRT_2 * inverse;
    (e + m * slope, (1.0 + m) * slope * inverse)
}

#[inline]
fn pseudo_exp(l: f32) -> (f32, f32) {
    let e = l as i32;
    let r = l - e as f32;
    let d = SQRT_2 - (SQRT_2 - 1.0) * r;
    let scale = f32::from_bits(((e + 127) as u32) << 23);
    let x = 1.0 + r / d;
    (scale * x, x * d * d * FRAC_1_SQRT_2)
}
