//! Branch-free single-precision functions that the compiler turns into SIMD over lanes.
//!
//! Polynomials are those of the Cephes library [Moshier1992]; the stated errors are checked by the tests below.

use brdf::{LANES, Lanes3};
use glam::Vec3;

/// One number a lane.
pub(crate) type F = [f32; LANES];
/// One index a lane.
pub(crate) type U = [u32; LANES];

/// arcsin on [-1, 1] (clamped), relative error below 3e-7.
#[inline(always)]
pub(crate) fn asin(x: f32) -> f32 {
    let a = x.abs().min(1.0);
    let wide = a > 0.5;
    let z = if wide { 0.5 * (1.0 - a) } else { a * a };
    let s = if wide { z.sqrt() } else { a };
    let p = ((((4.2163199048e-2 * z + 2.4181311049e-2) * z + 4.5470025998e-2) * z
        + 7.4953002686e-2)
        * z
        + 1.6666752422e-1)
        * z
        * s
        + s;
    let r = if wide {
        std::f32::consts::FRAC_PI_2 - 2.0 * p
    } else {
        p
    };
    r.copysign(x)
}

/// (sin, cos) for |x| <= 8, absolute error below 2e-7.
#[inline(always)]
pub(crate) fn sin_cos(x: f32) -> (f32, f32) {
    // adding 1.5 * 2^23 rounds to the nearest integer and leaves it in the low mantissa bits
    const ROUND: f32 = 12_582_912.0;
    let shifted = x * std::f32::consts::FRAC_2_PI + ROUND;
    let quadrant = shifted.to_bits();
    let j = shifted - ROUND;
    // pi/2 in three parts (Cody and Waite), so that the reduction keeps its digits
    let r = ((x - j * 1.5703125) - j * 4.837513e-4) - j * 7.549_79e-8;
    let z = r * r;
    let s = ((-1.9515295891e-4 * z + 8.3321608736e-3) * z - 1.6666654611e-1) * z * r + r;
    let c = ((2.443315711809948e-5 * z - 1.388731625493765e-3) * z + 4.166664568298827e-2) * z * z
        - 0.5 * z
        + 1.0;
    let swap = quadrant & 1 == 1;
    let (s, c) = if swap { (c, s) } else { (s, c) };
    let sign_s = (quadrant & 2) << 30;
    let sign_c = ((quadrant + 1) & 2) << 30;
    (
        f32::from_bits(s.to_bits() ^ sign_s),
        f32::from_bits(c.to_bits() ^ sign_c),
    )
}

/// Two unit vectors that make a right-handed frame with the unit vector `n` [Duff2017].
#[inline(always)]
pub(crate) fn tangents(n: Vec3) -> (Vec3, Vec3) {
    let sign = 1.0_f32.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (
        Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        Vec3::new(b, sign + n.y * n.y * a, -n.y),
    )
}

/// The same three coordinates in every lane.
#[inline(always)]
pub(crate) fn splat3(v: Vec3) -> Lanes3 {
    Lanes3 {
        x: [v.x; LANES],
        y: [v.y; LANES],
        z: [v.z; LANES],
    }
}

/// A 64-bit finaliser (the one of SplitMix64 [Steele2014]): seeds and roulette numbers.
#[inline]
pub(crate) fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn asin_keeps_its_digits() {
        for i in -100_000..=100_000_i32 {
            let x = i as f32 / 100_000.0;
            let exact = f64::from(x).asin();
            let error = (f64::from(asin(x)) - exact).abs();
            assert!(error <= 3e-7 * exact.abs(), "asin({x}) off by {error}");
        }
        assert!(asin(1.0 + 1e-6).is_finite(), "clamped outside");
    }

    #[test]
    fn sin_cos_keeps_its_digits() {
        for i in -80_000..=80_000_i32 {
            let x = i as f32 / 10_000.0;
            let (s, c) = sin_cos(x);
            let (es, ec) = f64::from(x).sin_cos();
            let error = (f64::from(s) - es).abs().max((f64::from(c) - ec).abs());
            assert!(error < 2e-7, "sin_cos({x}) off by {error}");
        }
    }

    #[test]
    fn tangents_are_orthonormal() {
        for v in [
            Vec3::Z,
            Vec3::NEG_Z,
            Vec3::X,
            Vec3::new(0.3, -0.7, -0.2),
            Vec3::new(1e-4, 1e-4, -1.0),
        ] {
            let n = v.normalize();
            let (s, t) = tangents(n);
            assert!((s.cross(t) - n).length() < 1e-6, "frame of {n}");
        }
    }
}
