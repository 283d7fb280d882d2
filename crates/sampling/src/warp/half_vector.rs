//! Half vectors of the classic lobes, with density D(h) cos(theta_h) per steradian.
//!
//! u.x = 0 is the centre of the lobe. Formulas use tan^2 and 1 - cos from components, so they hold down to
//! the narrowest lobes. `alpha` and `n` must be positive.

use super::{at_depth, depth, turn, unit};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Unit vector at azimuth 2 pi `turn` with tan^2(theta) = `tan2`.
#[inline]
fn at_tan2(tan2: f64, turn: f64) -> DVec3 {
    let cos = (1.0 + tan2).sqrt().recip();
    let sin = tan2.sqrt() * cos;
    let (s, c) = (TAU * turn).sin_cos();
    DVec3::new(sin * c, sin * s, cos)
}

/// tan^2(theta) of a vector of any length; infinite at the horizon.
#[inline]
fn tan2(h: DVec3) -> f64 {
    (h.x * h.x + h.y * h.y) / (h.z * h.z)
}

/// Half vector of the Trowbridge-Reitz (GGX) distribution [Walter2007, eq. 35 and 36].
#[inline]
#[must_use]
pub fn ggx_half(u: DVec2, alpha: f64) -> DVec3 {
    at_tan2(alpha * alpha * u.x / (1.0 - u.x), u.y)
}

/// D cos = alpha^2 / (pi cos^3 (alpha^2 + tan^2)^2), in the form that survives small alpha:
/// 1 / (pi alpha^2 (x^2/alpha^2 + y^2/alpha^2 + z^2)^2) z. 0 below the horizon.
#[inline]
#[must_use]
pub fn ggx_half_pdf(h: DVec3, alpha: f64) -> f64 {
    let (x, y) = (h.x / alpha, h.y / alpha);
    let e = x * x + y * y + h.z * h.z;
    h.z.max(0.0) / (PI * alpha * alpha * e * e)
}

/// The u that [`ggx_half`] maps to `h`.
#[inline]
#[must_use]
pub fn ggx_half_inverse(h: DVec3, alpha: f64) -> DVec2 {
    let r2 = h.x * h.x + h.y * h.y;
    unit(DVec2::new(r2 / (r2 + alpha * alpha * h.z * h.z), turn(h)))
}

/// Half vector of the Beckmann distribution [Walter2007, eq. 28 and 29].
#[inline]
#[must_use]
pub fn beckmann_half(u: DVec2, alpha: f64) -> DVec3 {
    at_tan2(-alpha * alpha * (-u.x).ln_1p(), u.y)
}

/// D cos = exp(-tan^2 / alpha^2) / (pi alpha^2 cos^3); 0 at and below the horizon.
#[inline]
#[must_use]
pub fn beckmann_half_pdf(h: DVec3, alpha: f64) -> f64 {
    if h.z <= 0.0 {
        return 0.0;
    }
    let a2 = alpha * alpha;
    // One exponential: at grazing angles exp(..) and 1/cos^3 would meet as 0 times infinity.
    (-tan2(h) / a2 - 3.0 * h.z.ln()).exp() / (PI * a2)
}

/// The u that [`beckmann_half`] maps to `h`.
#[inline]
#[must_use]
pub fn beckmann_half_inverse(h: DVec3, alpha: f64) -> DVec2 {
    let x = -(-tan2(h) / (alpha * alpha)).exp_m1();
    unit(DVec2::new(x, turn(h)))
}

/// Half vector with density proportional to cos^(n+1): Blinn's lobe with exponent `n` [Blinn1977].
#[inline]
#[must_use]
pub fn blinn_half(u: DVec2, n: f64) -> DVec3 {
    at_depth(-((-u.x).ln_1p() / (n + 2.0)).exp_m1(), u.y)
}

/// D cos = (n + 2) / (2 pi) cos^(n+1), as exp((n+1) ln(1 - (1 - cos))) so that n = 1e5 and more keep their
/// digits; 0 at and below the horizon.
#[inline]
#[must_use]
pub fn blinn_half_pdf(h: DVec3, n: f64) -> f64 {
    if h.z <= 0.0 {
        return 0.0;
    }
    (n + 2.0) / TAU * ((n + 1.0) * (-depth(h)).ln_1p()).exp()
}

/// The u that [`blinn_half`] maps to `h`.
#[inline]
#[must_use]
pub fn blinn_half_inverse(h: DVec3, n: f64) -> DVec2 {
    let x = -((n + 2.0) * (-depth(h)).ln_1p()).exp_m1();
    unit(DVec2::new(x, turn(h)))
}
