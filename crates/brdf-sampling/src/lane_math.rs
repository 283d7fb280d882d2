//! Functions of one lane without branches, for loops over lanes that the compiler vectorises.
//!
//! All of it is inlined always: the caller decides for which instruction set it is compiled.

use brdf::{LANES, Lanes3};
use std::f32::consts::{FRAC_1_SQRT_2, SQRT_2, TAU};

/// One number a lane.
pub(crate) type F = [f32; LANES];

/// A lane's worth of zeros.
pub(crate) const ZERO: F = [0.0; LANES];
/// Keeps wi above the horizon, and divisors away from 0.
pub(crate) const TINY: f32 = 1e-12;

/// [`crate::pseudo_log::pseudo_log`] in f32.
#[inline(always)]
pub(crate) fn pseudo_log(x: f32) -> (f32, f32) {
    let bits = x.to_bits();
    let e = ((bits >> 23).cast_signed() - 127) as f32;
    let m = f32::from_bits((bits & 0x007f_ffff) | 0x3f80_0000) - 1.0;
    let inverse = 1.0 / (1.0 + (SQRT_2 - 1.0) * m);
    let slope = SQRT_2 * inverse;
    (e + m * slope, (1.0 + m) * slope * inverse)
}

/// [`crate::pseudo_log::pseudo_exp`] in f32: x - 1 and x L'(x).
#[inline(always)]
pub(crate) fn pseudo_exp(l: f32) -> (f32, f32) {
    let e = l as i32;
    let r = l - e as f32;
    let d = SQRT_2 - (SQRT_2 - 1.0) * r;
    let scale = f32::from_bits(((e + 127) as u32) << 23);
    let m = r / d;
    ((scale - 1.0) + scale * m, (1.0 + m) * d * d * FRAC_1_SQRT_2)
}

/// [`crate::pseudo_angle::quarters`] in f32: numerator and denominator.
#[inline(always)]
pub(crate) fn quarters(x: f32, y: f32, rho: f32) -> [f32; 2] {
    let den = rho + FRAC_1_SQRT_2 * x.abs();
    [(den - den.copysign(x)) + y.copysign(x), den]
}

/// [`crate::pseudo_angle::slope`] in f32.
#[inline(always)]
pub(crate) fn quarters_slope(x: f32, rho: f32) -> f32 {
    (x.abs() + FRAC_1_SQRT_2 * rho) * rho
}

/// [`crate::pseudo_angle::circle`] in f32: cosine, sine and dphi/dq.
#[inline(always)]
pub(crate) fn circle(num: f32, den: f32) -> (f32, f32, f32) {
    let ahead = den - num.abs();
    let m = den - ahead.abs();
    let (m2, den2) = (m * m, den * den);
    let x = (den * (den2 - 0.5 * m2).sqrt() - FRAC_1_SQRT_2 * m2) / (den2 + 0.5 * m2);
    let reach = 1.0 + FRAC_1_SQRT_2 * x;
    let y = m / den * reach;
    let stretch = reach * reach / (x + FRAC_1_SQRT_2);
    (x.copysign(ahead), y.copysign(num), stretch)
}

/// Sine and cosine of 2 pi `turns`, for `turns` in [0, 1]: an octant either side of the nearest quarter turn, by the
/// polynomials of Cephes, good to 1e-7.
#[inline(always)]
pub(crate) fn sin_cos_turns(turns: f32) -> (f32, f32) {
    let quarter = (4.0 * turns + 0.5) as i32;
    let r = (turns - 0.25 * quarter as f32) * TAU;
    let r2 = r * r;
    let sine = r + r * r2 * (-1.666_665_5e-1 + r2 * (8.332_161e-3 - r2 * 1.951_529_6e-4));
    let cosine =
        1.0 - 0.5 * r2 + r2 * r2 * (4.166_664_6e-2 + r2 * (-1.388_731_6e-3 + r2 * 2.443_315_7e-5));
    let odd = quarter & 1 == 1;
    let (s, c) = if odd { (cosine, sine) } else { (sine, cosine) };
    let s = if quarter & 2 == 2 { -s } else { s };
    let c = if (quarter + 1) & 2 == 2 { -c } else { c };
    (s, c)
}

/// Directions of the cosine density, as [`crate::cosine::cosine_hemisphere`].
#[inline(always)]
pub(crate) fn cosine_hemisphere(u: &F, v: &F) -> Lanes3 {
    let mut wi = Lanes3::ZERO;
    for k in 0..LANES {
        let x = u[k].clamp(0.0, 1.0);
        let (sin, cos) = sin_cos_turns(v[k]);
        let s = x.sqrt();
        wi.x[k] = s * cos;
        wi.y[k] = s * sin;
        wi.z[k] = (1.0 - x).sqrt().max(TINY);
    }
    wi
}

#[cfg(test)]
mod tests {
    use super::sin_cos_turns;

    #[test]
    fn sine_and_cosine_all_around() {
        for k in 0..=10_000 {
            let turns = k as f32 / 10_000.0;
            let (s, c) = sin_cos_turns(turns);
            let (sin, cos) = (f64::from(turns) * std::f64::consts::TAU).sin_cos();
            // one rounding of the reduced angle, one of the polynomial
            assert!((f64::from(s) - sin).abs() < 2e-7, "sine of {turns}: {s}");
            assert!((f64::from(c) - cos).abs() < 2e-7, "cosine of {turns}: {c}");
        }
    }
}
