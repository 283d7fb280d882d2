//! Linear RGB spaces by their primaries and white.

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
}
