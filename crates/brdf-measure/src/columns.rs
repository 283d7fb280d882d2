//! From a model's channels to the columns of a file.

use brdf_formats::Channels;
use glam::{DMat3, DVec3};
use spectrum::Basis;

use crate::MeasureError;

/// How `N` channels of a reflectance become the value columns of a file.
pub(crate) struct Columns {
    pub(crate) channels: Channels,
    /// Linear sRGB to the columns; `None` = as they are.
    matrix: Option<DMat3>,
}

impl Columns {
    /// For a reflectance of `n` channels: linear sRGB into RGB or XYZ, band by band into bands.
    pub(crate) fn new(basis: &Basis, n: usize) -> Result<Self, MeasureError> {
        if basis.len() != n {
            return Err(MeasureError::Channels {
                expected: basis.len(),
                found: n,
            });
        }
        let channels = match basis {
            Basis::Rgb(_) => Channels::Rgb,
            Basis::Xyz => Channels::Xyz,
            Basis::Bands(nm) => {
                return Ok(Self {
                    channels: Channels::Wavelengths(nm.clone()),
                    matrix: None,
                });
            }
            _ => return Err(MeasureError::Columns(format!("{basis:?}"))),
        };
        // row per native channel = column of the matrix that makes sRGB of them
        let rows = basis.to_linear_srgb();
        let to_srgb = DMat3::from_cols_slice(rows.as_flattened());
        let matrix = to_srgb.inverse();
        if to_srgb.determinant().abs() > 0.0 && matrix.is_finite() {
            Ok(Self {
                channels,
                matrix: Some(matrix),
            })
        } else {
            Err(MeasureError::Columns(format!("{basis:?}")))
        }
    }

    /// The column values of the channel values `f`.
    pub(crate) fn convert<const N: usize>(&self, f: &[f64; N]) -> [f64; N] {
        let Some(matrix) = self.matrix else {
            return *f;
        };
        let rgb = DVec3::new(f[0], f[1], f[2]);
        let out = (matrix * rgb).to_array();
        std::array::from_fn(|c| out[c])
    }
}

#[cfg(test)]
mod tests {
    use super::Columns;
    use spectrum::{Basis, RgbSpace};

    #[test]
    fn columns_go_back_to_the_model() {
        let f = [0.3, -0.02, 1.7];
        for basis in [
            Basis::Rgb(RgbSpace::srgb()),
            Basis::Rgb(RgbSpace::trinitron()),
            Basis::Xyz,
        ] {
            let native = Columns::new(&basis, 3).unwrap().convert(&f);
            let rows = basis.to_linear_srgb();
            for c in 0..3 {
                let back: f64 = native.iter().zip(&rows).map(|(v, row)| v * row[c]).sum();
                assert!((back - f[c]).abs() < 1e-12, "{basis:?}: {back} {}", f[c]);
            }
        }
        let line = RgbSpace {
            primaries: [[0.3, 0.3], [0.4, 0.3], [0.5, 0.3]],
            ..RgbSpace::srgb()
        };
        assert!(
            Columns::new(&Basis::Rgb(line), 3).is_err(),
            "primaries on a line"
        );
    }

    #[test]
    fn white_keeps_its_level() {
        let space = RgbSpace::trinitron();
        let level = space.white_level;
        let columns = Columns::new(&Basis::Rgb(space), 3).unwrap();
        for v in columns.convert(&[1.0; 3]) {
            assert!((v - level).abs() < 1e-12, "{v}");
        }
    }

    #[test]
    fn the_count_must_match() {
        assert!(
            Columns::new(&Basis::Bands(vec![500.0, 600.0]), 3).is_err(),
            "two bands, three channels"
        );
        assert!(
            Columns::new(&Basis::Bands(vec![500.0, 600.0]), 2).is_ok(),
            "two bands, two channels"
        );
    }
}
