//! Lambert's W function on the positive axis [Corless1996].

/// W_0(y) to about 1 % for y >= 0, rising [Iacono2017, eq. 20]; 0 where 1 + y is 1.
#[inline]
pub(super) fn rough(y: f64) -> f64 {
    let l = (1.0 + y).ln();
    l * (1.0 - (1.0 + l).ln() / (2.0 + l))
}

/// The next approximation of W_0(y) after `w`, whose error it squares [Iacono2017, eq. 8].
#[inline]
pub(super) fn step(y: f64, w: f64) -> f64 {
    if w > 0.0 {
        w * (1.0 + (y / w).ln()) / (1.0 + w)
    } else {
        0.0
    }
}

/// W_0(y), the solution of w e^w = y, for 0 <= y < infinity; to a few units in the last place.
#[inline]
pub(super) fn lambert_w(y: f64) -> f64 {
    // y - y^2 + 3/2 y^3 - ...
    if y < 1e-8 {
        return y * (1.0 - y);
    }
    // 1e-2, 1e-4, 1e-8, 1e-16
    (0..3).fold(rough(y), |w, _| step(y, w))
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
            assert!(error < 1e-15 * (1.0 + y.ln().abs() + w), "{y}: {w} {error}");
        }
        assert_relative(lambert_w(std::f64::consts::E), 1.0, 1e-15, "W(e)");
        assert!(lambert_w(0.0).abs() < f64::MIN_POSITIVE, "W(0)");
    }
}
