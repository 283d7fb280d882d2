//! How well the data determine what was fitted.
//!
//! The covariance is the heteroscedasticity-consistent one, A^-1 B A^-1 with A = J^T J and B = J^T diag(r^2) J, summed
//! over pairs with the channels of a pair together [White1980]. It assumes that errors of different pairs are
//! independent and that the model holds where it is fitted; it does not assume that they are equally large, which
//! reflectance data of a thousandfold range never are, nor that channels are independent. Where a model does not fit,
//! the interval is that of the parameter that fits best. Intervals are Gaussian: data have thousands of rows.

use nalgebra::{DMatrix, DVector};

use crate::levenberg::active_weights;
use crate::problem::{Normal, Point, Problem};

/// Half-width of a 95 % interval in standard deviations.
pub(crate) const Z95: f64 = 1.959_963_984_540_054;

/// Covariance of the unknowns: variables of the shape first, then weights channel by channel. Unknowns held at a bound
/// and those the data say nothing about have NaN on the diagonal.
pub(crate) fn covariance(problem: &Problem<'_>, point: &Point, normal: &Normal) -> DMatrix<f64> {
    let n = normal.jtr.len();
    let bounds = problem.bounds();
    let inside =
        (0..point.u.len()).filter(|&j| point.u[j] > bounds[j].0 && point.u[j] < bounds[j].1);
    let used: Vec<usize> = inside
        .chain(active_weights(point))
        .filter(|&j| normal.jtj[(j, j)] > 0.0)
        .collect();
    let mut full = DMatrix::from_element(n, n, f64::NAN);
    let d = DVector::from_fn(used.len(), |i, _| normal.jtj[(used[i], used[i])].sqrt());
    let scaled = |m: &DMatrix<f64>| {
        DMatrix::from_fn(used.len(), used.len(), |i, j| {
            m[(used[i], used[j])] / (d[i] * d[j])
        })
    };
    let Some(a) = scaled(&normal.jtj).cholesky() else {
        return full;
    };
    let pairs = problem.samples.len() as f64;
    // the small-sample factor n / (n - p) of the estimator called HC1
    let factor = pairs / (pairs - used.len() as f64).max(1.0);
    let half = a.solve(&scaled(&normal.meat));
    let covariance = a.solve(&half.transpose()) * factor;
    for (i, &row) in used.iter().enumerate() {
        for (j, &column) in used.iter().enumerate() {
            full[(row, column)] = covariance[(i, j)] / (d[i] * d[j]);
        }
    }
    full
}
