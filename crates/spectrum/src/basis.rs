//! What the channels of a measurement or a rendering mean.

use crate::matrix::{Matrix3, diagonal, product, transform, transpose};
use crate::{Bins, LINEAR_SRGB_FROM_XYZ, LinearUplift, Outside, RgbSpace, Spectrum, Viewing};

/// The meaning of a list of channels: which linear functionals of the spectrum they are.
///
/// Every basis is linear, so channels may be interpolated and mixed before they are converted. Two maps say all:
/// [`Self::project`] takes a spectrum to its channels, [`Self::reconstruction`] gives the spectrum that
/// channels stand for; conversions between bases are the one after the other.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Basis {
    /// Three additive primaries; a reflectance of 1 at every wavelength is `(scale, scale, scale)`,
    /// up to the rounding of the file, where `scale` is [`RgbSpace::white_level`].
    Rgb(RgbSpace),
    /// CIE 1931 XYZ under D65, normalised so that a reflectance of 1 has Y = 1.
    Xyz,
    /// Reflectance at the given wavelengths in nm, ascending, piecewise linear between them, flat beyond.
    Bands(Vec<f64>),
    /// Means over intervals of wavelengths, constant in each, flat beyond.
    Bins(Bins),
}

impl Basis {
    /// How many channels the basis has.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Rgb(_) | Self::Xyz => 3,
            Self::Bands(nm) => nm.len(),
            Self::Bins(bins) => bins.len(),
        }
    }

    /// True for a basis without channels, which only an empty band list is.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Short channel names: `R`, `X`, `550nm` for a band, `380-422.5nm` for a bin.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Rgb(_) => ["R", "G", "B"].map(String::from).to_vec(),
            Self::Xyz => ["X", "Y", "Z"].map(String::from).to_vec(),
            Self::Bands(nm) => nm.iter().map(|l| format!("{l}nm")).collect(),
            Self::Bins(bins) => {
                let short = |nm: f64| (nm * 1e3).round() / 1e3;
                bins.ranges()
                    .map(|[a, b]| format!("{}-{}nm", short(a), short(b)))
                    .collect()
            }
        }
    }

    /// A row for each native channel: what one unit of it adds to linear sRGB.
    ///
    /// Whatever the basis, a reflectance of 1 at every wavelength maps to (1, 1, 1), to rounding. Bands and bins
    /// are integrated exactly under D65; RGB goes through its primaries and white, a white other than
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
            Self::Xyz => transpose(&table_srgb_from_xyz(&Viewing::standard())).to_vec(),
            Self::Bands(_) | Self::Bins(_) => {
                let viewing = Viewing::standard();
                let matrix = table_srgb_from_xyz(&viewing);
                let mut rows: Vec<_> = viewing
                    .weights(&self.reconstruction())
                    .into_iter()
                    .map(|xyz| transform(&matrix, xyz))
                    .collect();
                normalise(&mut rows, &vec![1.0; self.len()]);
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
            Self::Bands(_) | Self::Bins(_) => {
                let xyz = self.xyz_weights(&Viewing::standard());
                xyz.into_iter().map(|w| w[1]).collect()
            }
        }
    }

    /// XYZ that one unit of each channel adds under a light and for an observer: for bands and bins the exact
    /// integrals of light times colour-matching function, which sum to the white point.
    ///
    /// RGB and XYZ, told under D65, are seen through their [`Self::reconstruction`].
    #[must_use]
    pub fn xyz_weights(&self, viewing: &Viewing) -> Vec<[f64; 3]> {
        viewing.weights(&self.reconstruction())
    }

    /// The reflectance that one unit of each channel stands for, such that channels of a whole sum to a
    /// spectrum: hats for bands, boxes for bins, the linear basis of [`LinearUplift`] for RGB and XYZ.
    ///
    /// All NaN if an RGB space has no matrix.
    #[must_use]
    pub fn reconstruction(&self) -> Vec<Spectrum> {
        match self {
            Self::Rgb(_) | Self::Xyz => self
                .to_linear_srgb()
                .into_iter()
                .map(LinearUplift::spectrum)
                .collect(),
            Self::Bands(nm) => (0..nm.len())
                .map(|k| {
                    let unit = (0..nm.len()).map(|j| f64::from(u8::from(j == k)));
                    Spectrum::from_knots(nm.clone(), unit.collect(), Outside::Hold)
                })
                .collect(),
            Self::Bins(bins) => (0..bins.len()).map(|k| bin_box(bins, k)).collect(),
        }
    }

    /// The channels of a reflectance: values at bands, means over bins, colours under D65.
    #[must_use]
    pub fn project(&self, reflectance: &Spectrum) -> Vec<f64> {
        match self {
            Self::Rgb(_) | Self::Xyz => {
                let viewing = Viewing::standard();
                let matrix = table_srgb_from_xyz(&viewing);
                let srgb = transform(&matrix, viewing.xyz(reflectance));
                transform(&self.matrix_from_srgb(), srgb).to_vec()
            }
            Self::Bands(nm) => nm.iter().map(|l| reflectance.at(*l)).collect(),
            Self::Bins(bins) => bins.means(reflectance),
        }
    }

    /// A row for each native channel: what one unit of it adds to each channel of `target`.
    ///
    /// To bins: the exact bin means of the piecewise-linear measurement. White goes to white. RGB and XYZ
    /// go to each other by matrices, to bands and bins by [`LinearUplift`], under which they keep their
    /// colour. All NaN if an RGB space has no matrix.
    #[must_use]
    pub fn rows_to(&self, target: &Self) -> Vec<Vec<f64>> {
        if self == target {
            let one = |k| (0..self.len()).map(move |j| f64::from(u8::from(j == k)));
            return (0..self.len()).map(|k| one(k).collect()).collect();
        }
        match target {
            Self::Rgb(_) | Self::Xyz => {
                let matrix = target.matrix_from_srgb();
                self.to_linear_srgb()
                    .into_iter()
                    .map(|srgb| transform(&matrix, srgb).to_vec())
                    .collect()
            }
            Self::Bands(_) | Self::Bins(_) => self
                .reconstruction()
                .iter()
                .map(|s| target.project(s))
                .collect(),
        }
    }

    /// What one unit of each channel adds to the reflectance at a wavelength in nm.
    ///
    /// For many wavelengths, keep the [`Self::reconstruction`] and ask it.
    #[must_use]
    pub fn at(&self, lambda_nm: f64) -> Vec<f64> {
        self.reconstruction()
            .iter()
            .map(|s| s.at(lambda_nm))
            .collect()
    }

    /// The inverse of [`Self::to_linear_srgb`], for three channels; NaN where there is none.
    fn matrix_from_srgb(&self) -> Matrix3 {
        let rows = self.to_linear_srgb();
        let columns: Option<Matrix3> = rows.try_into().ok();
        columns
            .and_then(|c| crate::matrix::inverse(&transpose(&c)))
            .unwrap_or([[f64::NAN; 3]; 3])
    }
}

/// One in bin `k`, zero in the others; the outermost go on beyond their edges.
fn bin_box(bins: &Bins, k: usize) -> Spectrum {
    let e = bins.edges_nm();
    let (first, last) = (k == 0, k + 1 == bins.len());
    let (knots, values) = match (first, last) {
        (true, true) => (vec![e[0], e[1]], vec![1.0, 1.0]),
        (true, false) => (vec![e[0], e[1], e[1]], vec![1.0, 1.0, 0.0]),
        (false, true) => (vec![e[k], e[k], e[k + 1]], vec![0.0, 1.0, 1.0]),
        (false, false) => (
            vec![e[k], e[k], e[k + 1], e[k + 1]],
            vec![0.0, 1.0, 1.0, 0.0],
        ),
    };
    Spectrum::from_knots(knots, values, Outside::Hold)
}

/// Linear sRGB of XYZ that were integrated over the tables: D65 goes to (1, 1, 1) exactly.
///
/// [`LINEAR_SRGB_FROM_XYZ`] does so but for the digits of the white points: [`crate::D65_XY`] has five, the
/// tables give (0.312727, 0.329023), which moves blue by 1e-4. No adaptation: another light keeps its colour.
#[must_use]
pub fn table_srgb_from_xyz(standard: &Viewing) -> Matrix3 {
    let white = transform(&LINEAR_SRGB_FROM_XYZ, standard.white());
    product(&diagonal(white.map(f64::recip)), &LINEAR_SRGB_FROM_XYZ)
}

/// Scales the three columns so that the native `white` maps to (1, 1, 1), where it is but for rounding.
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
