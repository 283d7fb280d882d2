//! What the channels of a measurement or a rendering mean.

use crate::RgbSpace;

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
}
