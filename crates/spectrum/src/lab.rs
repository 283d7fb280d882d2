//! CIE 1976 L*a*b* [Cie15].

/// L*, a*, b* of `xyz` relative to the `white` (same scale); L* is 100 for the white.
///
/// Defined for negative tristimulus values, too, by the linear branch.
#[must_use]
pub fn lab_from_xyz(xyz: [f64; 3], white: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = std::array::from_fn(|c| compress(xyz[c] / white[c]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The inverse of [`lab_from_xyz`].
#[must_use]
pub fn xyz_from_lab([l, a, b]: [f64; 3], white: [f64; 3]) -> [f64; 3] {
    let y = (l + 16.0) / 116.0;
    let f = [y + a / 500.0, y, y - b / 200.0];
    std::array::from_fn(|c| white[c] * expand(f[c]))
}

/// The joint of the cube root and the line: 6/29.
const JOINT: f64 = 6.0 / 29.0;

fn compress(t: f64) -> f64 {
    if t > JOINT.powi(3) {
        t.cbrt()
    } else {
        t / (3.0 * JOINT * JOINT) + 4.0 / 29.0
    }
}

fn expand(f: f64) -> f64 {
    if f > JOINT {
        f.powi(3)
    } else {
        3.0 * JOINT * JOINT * (f - 4.0 / 29.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_black() {
        // D65 by [Lindbloom]; any white would do
        let white = [0.95047, 1.0, 1.08883];
        for (xyz, lab) in [(white, [100.0, 0.0, 0.0]), ([0.0; 3], [0.0; 3])] {
            let found = lab_from_xyz(xyz, white);
            assert!(
                found.iter().zip(lab).all(|(f, l)| (f - l).abs() < 1e-12),
                "{found:?}"
            );
        }
    }

    #[test]
    fn there_and_back() {
        // likewise
        let white = [0.95047, 1.0, 1.08883];
        for k in 0..200 {
            let xyz = [
                f64::from(k % 7) * 0.1 - 0.05,
                f64::from(k) * 0.005,
                f64::from(k % 11) * 0.08,
            ];
            let back = xyz_from_lab(lab_from_xyz(xyz, white), white);
            assert!(
                back.iter().zip(xyz).all(|(b, x)| (b - x).abs() < 1e-13),
                "{xyz:?}"
            );
        }
    }
}
