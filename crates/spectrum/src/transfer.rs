//! The sRGB transfer function, for 8-bit pictures.

/// The encoded value in [0, 1] of a linear one [Iec61966]; odd for negative values, unbounded above 1.
#[must_use]
pub fn srgb_encode(linear: f64) -> f64 {
    let x = linear.abs();
    let y = if x <= 0.0031308 {
        12.92 * x
    } else {
        1.055 * x.powf(1.0 / 2.4) - 0.055
    };
    y.copysign(linear)
}

/// The inverse of [`srgb_encode`], up to the standard's own 1e-8 at the joint.
#[must_use]
pub fn srgb_decode(encoded: f64) -> f64 {
    let y = encoded.abs();
    let x = if y <= 0.04045 {
        y / 12.92
    } else {
        ((y + 0.055) / 1.055).powf(2.4)
    };
    x.copysign(encoded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        for k in -20..=300 {
            let x = f64::from(k) / 256.0;
            assert!((srgb_decode(srgb_encode(x)) - x).abs() < 1e-7, "{x}");
        }
        assert!((srgb_encode(1.0) - 1.0).abs() < 1e-15);
        // by hand: 1.055 * 0.18^(1/2.4) - 0.055 [Iec61966]
        assert!((srgb_encode(0.18) - 0.46135).abs() < 1e-5);
    }
}
