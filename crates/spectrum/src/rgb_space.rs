//! Linear RGB spaces by their primaries and white.

use crate::adaptation::bradford;
use crate::matrix::{Matrix3, inverse, product, transform};

/// A linear RGB space: three primaries and a white point as CIE 1931 xy chromaticities.
#[derive(Clone, Debug, PartialEq)]
pub struct RgbSpace {
    /// A name a person knows it by, such as `sRGB`.
    pub name: String,
    /// xy of red, green and blue.
    pub primaries: [[f64; 2]; 3],
    /// xy of the white point.
    pub white: [f64; 2],
    /// What a perfect white diffuse reflectance of 1 reads in each channel (1 for all but odd files:
    /// Cornell's RGB tables have 0.358).
    pub white_level: f64,
}

/// CIE D65 chromaticity, 2 degree observer [Cie15].
pub const D65_XY: [f64; 2] = [0.312_72, 0.329_03];

/// XYZ of linear sRGB: `RgbSpace::srgb().to_xyz()` to the last digit. White is D65 with Y = 1.
pub const XYZ_FROM_LINEAR_SRGB: Matrix3 = [
    [0.4124078805165856, 0.3575895737668074, 0.1804325976875519],
    LUMINANCE_SRGB,
    [0.01933161939921495, 0.1191965245889358, 0.9502783478211068],
];

/// Linear sRGB of XYZ: the inverse of [`XYZ_FROM_LINEAR_SRGB`].
pub const LINEAR_SRGB_FROM_XYZ: Matrix3 = [
    [3.240835706303155, -1.5373195017079069, -0.49859010866202386],
    [-0.9692294485284497, 1.8759400411649523, 0.04155444912578521],
    [0.0556449376179599, -0.2040314379325196, 1.057253814741238],
];

/// Luminance Y of linear sRGB [Bt709]; the weights sum to 1.
pub const LUMINANCE_SRGB: [f64; 3] = [0.21264781339136443, 0.7151791475336148, 0.07217303907502076];

/// Linear sRGB of an XYZ colour under D65, white Y = 1; out-of-gamut colours have negative components.
#[inline]
#[must_use]
pub fn linear_srgb_from_xyz(xyz: [f64; 3]) -> [f64; 3] {
    transform(&LINEAR_SRGB_FROM_XYZ, xyz)
}

/// XYZ of the chromaticity `xy` with Y = 1; `None` if y is 0 or anything is not finite.
#[must_use]
pub fn xyz_of_xy([x, y]: [f64; 2]) -> Option<[f64; 3]> {
    let xyz = [x / y, 1.0, (1.0 - x - y) / y];
    xyz.iter().all(|v| v.is_finite()).then_some(xyz)
}

impl RgbSpace {
    /// ITU-R BT.709 primaries with D65 white, linear: what gonio renders in [Bt709].
    #[must_use]
    pub fn srgb() -> Self {
        Self {
            name: "sRGB".into(),
            primaries: [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]],
            white: D65_XY,
            white_level: 1.0,
        }
    }

    /// ITU-R BT.2020 primaries with D65 white, linear [Bt2020].
    #[must_use]
    pub fn rec2020() -> Self {
        Self {
            name: "Rec.2020".into(),
            primaries: [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]],
            white: D65_XY,
            white_level: 1.0,
        }
    }

    /// `ACEScg`: AP1 primaries with the ACES white near D60, linear [Aces2014].
    #[must_use]
    pub fn acescg() -> Self {
        Self {
            name: "ACEScg".into(),
            primaries: [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]],
            white: [0.32168, 0.33767],
            white_level: 1.0,
        }
    }

    /// The space of Cornell's RGB measurements, "RGB for Trinitron phosphors".
    ///
    /// The files state no numbers. These were recovered by least squares from materials that are published
    /// both as spectra and as RGB [Cornell], with XYZ as sums over the files' 10 nm bands under D65; they
    /// return the RGB columns to 4e-6 of their size. Rounded they are (0.620, 0.341), (0.276, 0.597),
    /// (0.150, 0.072) with D65 white.
    #[must_use]
    pub fn trinitron() -> Self {
        Self {
            name: "Trinitron (Cornell)".into(),
            primaries: [
                [0.6200191, 0.3409933],
                [0.2760245, 0.5970069],
                [0.1499904, 0.0719965],
            ],
            white: [0.3127110, 0.3290148],
            white_level: 0.3582531,
        }
    }

    /// Whether primaries and white are exactly those of `other`, whatever the names and levels.
    #[must_use]
    pub fn has_colours_of(&self, other: &Self) -> bool {
        let bits = |s: &Self| {
            let [r, g, b] = s.primaries;
            [r, g, b, s.white].map(|xy| xy.map(f64::to_bits))
        };
        bits(self) == bits(other)
    }

    /// XYZ of channel values, with Y = 1 for a reflectance of 1 (all channels at [`Self::white_level`]).
    ///
    /// `None` if the primaries lie on a line, or white or level are no colour.
    #[must_use]
    pub fn to_xyz(&self) -> Option<Matrix3> {
        let [r, g, b] = self.primaries.map(xyz_of_xy);
        let (r, g, b) = (r?, g?, b?);
        let columns = [[r[0], g[0], b[0]], [r[1], g[1], b[1]], [r[2], g[2], b[2]]];
        // How much of each primary makes the white [Lindbloom].
        let parts = transform(&inverse(&columns)?, xyz_of_xy(self.white)?);
        let scaled =
            columns.map(|row| std::array::from_fn(|c| row[c] * parts[c] / self.white_level));
        // Also refuses a level of 0 and a white on the line of two primaries.
        inverse(&scaled).map(|_| scaled)
    }

    /// Channel values of XYZ: the inverse of [`Self::to_xyz`].
    #[must_use]
    pub fn from_xyz(&self) -> Option<Matrix3> {
        inverse(&self.to_xyz()?)
    }

    /// Channel values of `other` for channel values of this space: white goes to white by Bradford's
    /// adaptation, level to level. `None` if either space is degenerate.
    #[must_use]
    pub fn convert_to(&self, other: &Self) -> Option<Matrix3> {
        let adapt = bradford(self.white, other.white)?;
        Some(product(
            &other.from_xyz()?,
            &product(&adapt, &self.to_xyz()?),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_matrix(found: &Matrix3, expected: &Matrix3, tolerance: f64) {
        for i in 0..3 {
            for j in 0..3 {
                let error = (found[i][j] - expected[i][j]).abs();
                assert!(error <= tolerance, "{found:?}\ninstead of\n{expected:?}");
            }
        }
    }

    #[test]
    fn constants_are_those_of_the_space() {
        let srgb = RgbSpace::srgb();
        assert_matrix(&srgb.to_xyz().unwrap(), &XYZ_FROM_LINEAR_SRGB, 1e-15);
        assert_matrix(&srgb.from_xyz().unwrap(), &LINEAR_SRGB_FROM_XYZ, 4e-15);
        assert!((LUMINANCE_SRGB.iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn published_matrices() {
        // [Iec61966] and [Bt2020], whose D65 is (0.3127, 0.3290): 2e-4 apart
        let srgb = [
            [0.4124, 0.3576, 0.1805],
            [0.2126, 0.7152, 0.0722],
            [0.0193, 0.1192, 0.9505],
        ];
        assert_matrix(&RgbSpace::srgb().to_xyz().unwrap(), &srgb, 3e-4);
        let rec2020 = [
            [0.6370, 0.1446, 0.1689],
            [0.2627, 0.6780, 0.0593],
            [0.0, 0.0281, 1.0610],
        ];
        assert_matrix(&RgbSpace::rec2020().to_xyz().unwrap(), &rec2020, 3e-4);
        // [Aces2014] AP1 to XYZ
        let ap1 = [
            [0.6624541811, 0.1340042065, 0.1561876870],
            [0.2722287168, 0.6740817658, 0.0536895174],
            [-0.0055746495, 0.0040607335, 1.0103391003],
        ];
        assert_matrix(&RgbSpace::acescg().to_xyz().unwrap(), &ap1, 1e-9);
    }

    #[test]
    fn white_is_white_in_every_space() {
        let spaces = [
            RgbSpace::srgb(),
            RgbSpace::rec2020(),
            RgbSpace::acescg(),
            RgbSpace::trinitron(),
        ];
        for a in &spaces {
            for b in &spaces {
                let m = a.convert_to(b).unwrap();
                for v in transform(&m, [a.white_level; 3]) {
                    assert!(
                        (v - b.white_level).abs() < 1e-13,
                        "{} to {}",
                        a.name,
                        b.name
                    );
                }
            }
        }
    }

    #[test]
    fn degenerate_spaces_have_no_matrix() {
        let mut line = RgbSpace::srgb();
        line.primaries[2] = [0.47, 0.465];
        assert!(line.to_xyz().is_none());
        let mut dark = RgbSpace::srgb();
        dark.white_level = 0.0;
        assert!(dark.to_xyz().is_none());
        let mut nan = RgbSpace::srgb();
        nan.white[0] = f64::NAN;
        assert!(nan.convert_to(&RgbSpace::srgb()).is_none());
    }
}
