//! Bradford's chromatic adaptation: what a white under one light is under another.

use crate::matrix::{Matrix3, diagonal, inverse, product, transform};
use crate::rgb_space::xyz_of_xy;

/// XYZ to Bradford's sharpened cone responses [Lam1985].
const BRADFORD: Matrix3 = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];

/// Maps XYZ seen under the white `from` to XYZ of the same look under the white `to`, both xy.
///
/// Exactly the identity for equal whites. `None` if a white is no colour (y = 0, not finite).
#[must_use]
pub fn bradford(from: [f64; 2], to: [f64; 2]) -> Option<Matrix3> {
    let (source, target) = (xyz_of_xy(from)?, xyz_of_xy(to)?);
    let back = inverse(&BRADFORD)?;
    let (s, t) = (transform(&BRADFORD, source), transform(&BRADFORD, target));
    let gain: [f64; 3] = std::array::from_fn(|c| t[c] / s[c]);
    if gain.iter().any(|g| !g.is_finite()) {
        return None;
    }
    Some(product(&back, &product(&diagonal(gain), &BRADFORD)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_white_to_white() {
        // [Lindbloom]: D50 = (0.96422, 1, 0.82521), D65 = (0.95047, 1, 1.08883)
        let d50 = [0.96422 / 2.78943, 1.0 / 2.78943];
        let d65 = [0.95047 / 3.03930, 1.0 / 3.03930];
        let m = bradford(d50, d65).unwrap();
        let white = transform(&m, xyz_of_xy(d50).unwrap());
        for (found, expected) in white.into_iter().zip(xyz_of_xy(d65).unwrap()) {
            assert!((found - expected).abs() < 1e-12);
        }
        // his matrix, seven decimals
        let published = [
            [0.9555766, -0.0230393, 0.0631636],
            [-0.0282895, 1.0099416, 0.0210077],
            [0.0122982, -0.0204830, 1.3299098],
        ];
        for i in 0..3 {
            for j in 0..3 {
                assert!((m[i][j] - published[i][j]).abs() < 1e-7, "{m:?}");
            }
        }
    }

    #[test]
    fn refuses_no_colour() {
        assert!(bradford([0.3, 0.0], [0.3, 0.3]).is_none());
        assert!(bradford([0.3, 0.3], [f64::NAN, 0.3]).is_none());
    }
}
