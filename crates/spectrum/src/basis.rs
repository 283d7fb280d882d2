//! What the channels of a measurement or a rendering mean.

use crate::matrix::{Matrix3, transpose};
use crate::{
    Illuminant, LINEAR_SRGB_FROM_XYZ, Observer, RgbSpace, band_weights, linear_srgb_from_xyz,
    white_xyz,
};

/// The meaning of a list of channels: which linear functionals of the spectrum they are.
///
/// Every basis is linear, so channels may be interpolated and mixed before they are converted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Basis {
    /// Three additive primaries; a reflectance of 1 at every wavelength is `(scale, scale, scale)`,
    /// up to the rounding of the file, where `scale` is [`RgbSpace::white_level`].
    Rgb(RgbSpace),
    /// CIE 1931 XYZ under D65, normalised so that a reflectance of 1 has Y = 1.
    Xyz,
    /// Reflectance at the given wavelengths in nm, ascending, piecewise linear between them.
    Bands(Vec<f64>),
}

impl Basis {
    /// How many channels the basis has.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Rgb(_) | Self::Xyz => 3,
            Self::Bands(nm) => nm.len(),
        }
    }

    /// True for a basis without channels, which only an empty band list is.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Short channel names: `R`, `X`, `550nm`.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Rgb(_) => ["R", "G", "B"].map(String::from).to_vec(),
            Self::Xyz => ["X", "Y", "Z"].map(String::from).to_vec(),
            Self::Bands(nm) => nm.iter().map(|l| format!("{l}nm")).collect(),
        }
    }

    /// A row for each native channel: what one unit of it adds to linear sRGB.
    ///
    /// Whatever the basis, a reflectance of 1 at every wavelength maps to (1, 1, 1), to rounding. Bands are
    /// weighted by [`band_weights`] under D65; RGB goes through its primaries and white, a white other than
    /// D65 by Bradford's adaptation. Colours out of gamut keep their negative components.
    /// All NaN if an RGB space has no matrix ([`RgbSpace::to_xyz`]).
    #[must_use]
    pub fn to_linear_srgb(&self) -> Vec<[f64; 3]> {
        let srgb = RgbSpace::srgb();
        match self {
            Self::Rgb(space) if space.has_colours_of(&srgb) => {
                // Without the rounding of going to XYZ and back.
                let level = space.white_level.recip();
                vec![[level, 0.0, 0.0], [0.0, level, 0.0], [0.0, 0.0, level]]
            }
            Self::Rgb(space) => {
                let matrix: Matrix3 = space.convert_to(&srgb).unwrap_or([[f64::NAN; 3]; 3]);
                let mut rows = transpose(&matrix).to_vec();
                normalise(&mut rows, &[space.white_level; 3]);
                rows
            }
            Self::Xyz => {
                let mut rows = transpose(&LINEAR_SRGB_FROM_XYZ).to_vec();
                normalise(&mut rows, &white_xyz(&Illuminant::D65, &Observer::CIE_1931));
                rows
            }
            Self::Bands(nm) => {
                let xyz = band_weights(nm, &Illuminant::D65, &Observer::CIE_1931);
                let mut rows: Vec<_> = xyz.into_iter().map(linear_srgb_from_xyz).collect();
                normalise(&mut rows, &vec![1.0; nm.len()]);
                rows
            }
        }
    }

    /// What one unit of each native channel adds to the luminance Y under D65; a reflectance of 1 has Y = 1.
    ///
    /// All NaN if an RGB space has no matrix.
    #[must_use]
    pub fn luminance_weights(&self) -> Vec<f64> {
        match self {
            Self::Rgb(space) => match space.to_xyz() {
                Some(matrix) => matrix[1].to_vec(),
                None => vec![f64::NAN; 3],
            },
            Self::Xyz => vec![0.0, 1.0, 0.0],
            Self::Bands(nm) => {
                let xyz = band_weights(nm, &Illuminant::D65, &Observer::CIE_1931);
                xyz.into_iter().map(|w| w[1]).collect()
            }
        }
    }
}

/// Scales the three columns so that the native `white` maps to (1, 1, 1).
///
/// It is there already but for the digits of the white points: [`crate::D65_XY`] has five, the tables give
/// (0.312727, 0.329023), which moves blue by 1e-4.
fn normalise(rows: &mut [[f64; 3]], white: &[f64]) {
    let mut sum = [0.0; 3];
    for (row, w) in rows.iter().zip(white) {
        for c in 0..3 {
            sum[c] += row[c] * w;
        }
    }
    for row in rows {
        for c in 0..3 {
            row[c] /= sum[c];
        }
    }
}
