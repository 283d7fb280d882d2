//! Branch-free f32 pieces for packets: plain loops over lanes that the compiler turns into SIMD.

use brdf::{LANES, Lanes3};
use std::f32::consts::{FRAC_1_PI, TAU};

/// Sine and cosine of 2 pi u for u in [0, 1); absolute error below 2e-7.
#[inline(always)]
pub(crate) fn sin_cos_turn(u: f32) -> (f32, f32) {
    // quadrant q, remainder r in [-1/8, 1/8] turns, then Taylor on |x| <= pi/4
    let q = (4.0 * u + 0.5) as i32;
    let x = TAU * (u - 0.25 * q as f32);
    let x2 = x * x;
    let s = x + x
        * x2
        * (-1.666_666_6e-1 + x2 * (8.333_332e-3 + x2 * (-1.984_087_5e-4 + x2 * 2.752_5e-6)));
    let c = 1.0 + x2 * (-0.5 + x2 * (4.166_666_6e-2 + x2 * (-1.388_888_6e-3 + x2 * 2.476_9e-5)));
    let swap = q & 1 == 1;
    let (s, c) = if swap { (c, s) } else { (s, c) };
    let s = if q & 2 == 2 { -s } else { s };
    let c = if (q + 1) & 2 == 2 { -c } else { c };
    (s, c)
}

/// Cosine-distributed directions, polar map.
#[inline(always)]
pub(crate) fn cosine(u: &[[f32; LANES]; 2]) -> Lanes3 {
    let mut w = Lanes3::ZERO;
    for k in 0..LANES {
        let (sin_phi, cos_phi) = sin_cos_turn(u[1][k]);
        let r = u[0][k].sqrt();
        w.x[k] = r * cos_phi;
        w.y[k] = r * sin_phi;
        w.z[k] = (1.0 - u[0][k]).sqrt();
    }
    w
}

/// Densities of [`cosine`].
#[inline(always)]
pub(crate) fn cosine_pdf(wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
    std::array::from_fn(|k| {
        if wo.z[k] > 0.0 {
            wi.z[k].max(0.0) * FRAC_1_PI
        } else {
            0.0
        }
    })
}

/// 1 where both directions are above the horizon, else 0.
#[inline(always)]
pub(crate) fn above(wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
    std::array::from_fn(|k| if wi.z[k].min(wo.z[k]) > 0.0 { 1.0 } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::sin_cos_turn;

    #[test]
    fn sine_and_cosine_of_a_turn() {
        for k in 0..100_000 {
            let u = k as f32 / 100_000.0;
            let (s, c) = sin_cos_turn(u);
            let (s_ref, c_ref) = (std::f64::consts::TAU * f64::from(u)).sin_cos();
            // f32 rounding of 2 pi u over an eighth of a turn, and of the polynomial
            assert!(
                (f64::from(s) - s_ref).abs() < 2e-7,
                "sin at {u}: {s} {s_ref}"
            );
            assert!(
                (f64::from(c) - c_ref).abs() < 2e-7,
                "cos at {u}: {c} {c_ref}"
            );
        }
    }
}
