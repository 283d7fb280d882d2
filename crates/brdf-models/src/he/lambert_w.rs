//! Lambert's W function on the positive axis [Corless1996].

use crate::elementary::{ln, polynomial};

/// W_0(y) from l = ln(1 + y) >= 0; to 1.1e-3 relative up to l = 70, to 1.1 % beyond.
#[inline(always)]
pub(super) fn rough(l: f64) -> f64 {
    // W(e^l - 1)/l as a ratio of polynomials of least relative error there
    let numerator = 0.99967 + l * (2.05166 + l * (0.715346 + l * 0.1554022));
    let denominator = 1.0 + l * (2.55193 + l * (1.29285 + l * 0.1577674));
    l * numerator / denominator
}

/// W_0(y), the solution of w e^w = y, for 0 <= y < infinity; to 1e-13 relative up to y = 1e30, to 6e-13 beyond.
#[inline(always)]
pub(super) fn lambert_w(y: f64) -> f64 {
    /// W_0(y)/y on [0, 1] as a ratio of polynomials through 14 Chebyshev points.
    const NUMERATOR: [f64; 7] = [
        0.999_999_999_999_907_2,
        6.331_067_611_740_449,
        14.493_596_996_070_176,
        14.704_749_049_439_349,
        6.534_837_555_422_725,
        1.083_889_144_665_469_8,
        4.217_486_435_272_694e-2,
    ];
    const DENOMINATOR: [f64; 8] = [
        1.0,
        7.331_067_611_703_273,
        20.324_664_610_457_845,
        26.699_478_826_249_382,
        17.088_501_214_381_86,
        4.939_617_165_519_558,
        0.522_637_467_700_723_1,
        1.140_596_008_081_610_6e-2,
    ];
    if y <= 1.0 {
        return y * polynomial(&NUMERATOR, y) / polynomial(&DENOMINATOR, y);
    }
    // a step of the fourth order [Fritsch1973]
    let w = rough(ln(1.0 + y));
    let z = ln(y / w) - w;
    let q = 2.0 * (1.0 + w) * (1.0 + w + 2.0 / 3.0 * z);
    w * (1.0 + z / (1.0 + w) * (q - z) / (q - 2.0 * z))
}

#[cfg(test)]
mod tests {
    use super::lambert_w;
    use testkit::assert_relative;

    #[test]
    fn inverts_w_exp_w() {
        for k in -300..=240 {
            let y = 10_f64.powi(k);
            let w = lambert_w(y);
            // w e^w in logarithms, so that it does not overflow; error of w (1 + w) / w
            let error = (w.ln() + w - y.ln()).abs();
            let allowed = if y < 1e30 { 1e-13 } else { 6e-13 } * (1.0 + w) + 1e-15 * y.ln().abs();
            assert!(error < allowed, "{y}: {w} {error}");
        }
        assert_relative(lambert_w(std::f64::consts::E), 1.0, 1e-13, "W(e)");
        assert!(lambert_w(0.0).abs() < f64::MIN_POSITIVE, "W(0)");
    }
}
