//! 3 x 3 matrices, as arrays of rows: all that colour conversions need.

/// Rows of a linear map of three numbers.
pub type Matrix3 = [[f64; 3]; 3];

/// `m` times the column `v`.
#[inline]
#[must_use]
pub fn transform(m: &Matrix3, v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// The matrix that applies `b` first, then `a`.
#[must_use]
pub fn product(a: &Matrix3, b: &Matrix3) -> Matrix3 {
    transpose(&transpose(b).map(|column| transform(a, column)))
}

/// Rows become columns.
pub(crate) fn transpose(m: &Matrix3) -> Matrix3 {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// The matrix with `d` on its diagonal.
pub(crate) fn diagonal(d: [f64; 3]) -> Matrix3 {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}

/// The inverse; `None` if the rows are dependent to rounding, or anything is not finite.
#[must_use]
pub fn inverse(m: &Matrix3) -> Option<Matrix3> {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let columns = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let determinant = dot(m[0], columns[0]);
    let volume: f64 = m.iter().map(|row| dot(*row, *row).sqrt()).product();
    let regular = determinant.abs() > 1e-12 * volume && determinant.is_finite();
    regular.then(|| transpose(&columns.map(|c| c.map(|v| v / determinant))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_undoes() {
        let m = [[2.0, 1.0, 0.5], [-1.0, 3.0, 0.0], [0.1, 0.2, 0.3]];
        let one = product(&inverse(&m).unwrap(), &m);
        for i in 0..3 {
            for j in 0..3 {
                let expected = f64::from(u8::from(i == j));
                assert!((one[i][j] - expected).abs() < 1e-14, "{one:?}");
            }
        }
    }

    #[test]
    fn singular_matrices_have_none() {
        assert!(inverse(&[[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, 0.0]]).is_none());
        assert!(inverse(&[[f64::NAN; 3]; 3]).is_none());
        assert!(inverse(&[[0.0; 3]; 3]).is_none());
    }
}
