//! From a model's channels to the columns of a file.

use brdf_formats::Channels;
use glam::{DMat3, DVec3};
use spectrum::{Basis, RgbSpace};

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
        let unknown = || MeasureError::Columns(format!("{basis:?}"));
        let to_xyz = rgb_to_xyz(&RgbSpace::srgb()).ok_or_else(unknown)?;
        let (channels, matrix) = match basis {
            Basis::Rgb(space) => {
                let from_xyz = rgb_to_xyz(space).ok_or_else(unknown)?.inverse();
                (Channels::Rgb, Some(from_xyz * to_xyz * space.white_level))
            }
            Basis::Xyz => (Channels::Xyz, Some(to_xyz)),
            Basis::Bands(nm) => (Channels::Wavelengths(nm.clone()), None),
            _ => return Err(unknown()),
        };
        if matrix.is_some_and(|m| !m.is_finite()) {
            return Err(unknown());
        }
        Ok(Self { channels, matrix })
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

/// Linear RGB to CIE XYZ with Y = 1 for white, from primaries and white point [Lindbloom2003]; `None` if the
/// primaries lie on a line.
fn rgb_to_xyz(space: &RgbSpace) -> Option<DMat3> {
    let xyz = |[x, y]: [f64; 2]| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let p = space.primaries.map(xyz);
    let primaries = DMat3::from_cols(p[0], p[1], p[2]);
    if primaries.determinant().abs() < 1e-12 {
        return None;
    }
    let scale = primaries.inverse() * xyz(space.white);
    Some(primaries * DMat3::from_diagonal(scale))
}

#[cfg(test)]
mod tests {
    use super::{Columns, rgb_to_xyz};
    use spectrum::{Basis, RgbSpace};

    #[test]
    fn srgb_matrix_is_the_published_one() {
        // [Bt709] with D65, to the four digits everyone prints
        let m = rgb_to_xyz(&RgbSpace::srgb())
            .unwrap()
            .transpose()
            .to_cols_array();
        let published = [
            0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505,
        ];
        for (a, b) in m.iter().zip(published) {
            assert!((a - b).abs() < 3e-4, "{a} {b}");
        }
    }

    #[test]
    fn white_keeps_its_level() {
        let space = RgbSpace {
            white_level: 0.358,
            ..RgbSpace::srgb()
        };
        let columns = Columns::new(&Basis::Rgb(space), 3).unwrap();
        for v in columns.convert(&[1.0; 3]) {
            assert!((v - 0.358).abs() < 1e-12, "{v}");
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
