//! How well the data determine what was fitted.
//!
//! The covariance is the heteroscedasticity-consistent one, A^-1 B A^-1 with A = J^T J and B the sum over pairs of
//! directions of g g^T, g = J_i^T (1 - H_i)^-1 r_i, with the rows J_i and residuals r_i of the pair's channels and their
//! leverage H_i = J_i A^-1 J_i^T [White1980]. The factor (1 - H_i)^-1, called HC3, makes it the jackknife's, which leaves
//! out one pair after the other [MacKinnonWhite1985]: without it, pairs that pull the fit to themselves seem free of error.
//! It assumes that errors of different pairs are independent and that the model holds where it is fitted; it does not
//! assume that they are equally large, which reflectance data of a thousandfold range never are, nor that channels are
//! independent. Where a model does not fit, the interval is that of the parameter that fits best.

use nalgebra::{DMatrix, DVector};

use crate::levenberg::active_weights;
use crate::problem::{Normal, PairRows, Point, Problem};

/// Half-width of a 95 % interval in standard deviations.
pub(crate) const Z95: f64 = 1.959_963_984_540_054;

/// Least share of a pair that is not leverage: of a pair that alone determines a parameter nothing would be left.
const LEAST: f64 = 1e-6;

/// Leverage below which a pair is taken to have none: it would change its residual by less than this.
const SMALL: f64 = 1e-2;

/// Covariance of the unknowns: variables of the shape first, then weights channel by channel. Unknowns held at a bound
/// and those the data say nothing about have NaN on the diagonal.
pub(crate) fn covariance(problem: &Problem<'_>, point: &Point, normal: &Normal) -> DMatrix<f64> {
    let jtj = &normal.jtj;
    let n = jtj.nrows();
    let bounds = problem.bounds();
    let inside =
        (0..point.u.len()).filter(|&j| point.u[j] > bounds[j].0 && point.u[j] < bounds[j].1);
    let used: Vec<usize> = inside
        .chain(active_weights(point))
        .filter(|&j| jtj[(j, j)] > 0.0)
        .collect();
    let mut full = DMatrix::from_element(n, n, f64::NAN);
    let Some(bread) = Bread::new(jtj, &used) else {
        return full;
    };
    let empty = || (DMatrix::zeros(n, n), DVector::zeros(n));
    let blocks = problem.by_pair(point, empty, |(meat, g), pair| {
        bread.gradient(pair, g);
        meat.ger(1.0, g, g, 1.0);
    });
    let meat = (blocks.iter()).fold(DMatrix::zeros(n, n), |sum: DMatrix<f64>, (b, _)| sum + b);
    let covariance = &bread.inverse * meat * &bread.inverse;
    for &i in &used {
        for &j in &used {
            full[(i, j)] = covariance[(i, j)];
        }
    }
    full
}

/// (J^T J)^-1 and what bounds leverages from above.
struct Bread {
    /// Zero for unknowns that are not used.
    inverse: DMatrix<f64>,
    /// x^T `inverse` x is at most the sum of (x_k `reach`_k)^2.
    reach: Vec<f64>,
}

impl Bread {
    fn new(jtj: &DMatrix<f64>, used: &[usize]) -> Option<Self> {
        let d: Vec<f64> = used.iter().map(|&j| jtj[(j, j)].sqrt()).collect();
        // unit diagonal
        let scaled = DMatrix::from_fn(used.len(), used.len(), |i, j| {
            jtj[(used[i], used[j])] / (d[i] * d[j])
        });
        let scaled = scaled.cholesky()?.inverse();
        // the largest eigenvalue is at most the trace
        let largest = scaled.trace();
        let mut inverse = DMatrix::zeros(jtj.nrows(), jtj.ncols());
        let mut reach = vec![0.0; jtj.nrows()];
        for (i, &row) in used.iter().enumerate() {
            reach[row] = largest.sqrt() / d[i];
            for (j, &column) in used.iter().enumerate() {
                inverse[(row, column)] = scaled[(i, j)] / (d[i] * d[j]);
            }
        }
        Some(Self { inverse, reach })
    }

    /// J^T (1 - H)^-1 r of one pair.
    fn gradient(&self, pair: &PairRows, g: &mut DVector<f64>) {
        let bound: f64 = (pair.rows.iter().enumerate())
            .map(|(c, row)| {
                let reach = |i: usize| self.reach[pair.unknown(c, i)];
                let terms = row.iter().enumerate().map(|(i, v)| (v * reach(i)).powi(2));
                terms.sum::<f64>()
            })
            .sum();
        if bound < SMALL {
            pair.pull(&pair.residuals, g);
        } else {
            pair.pull(&self.left_out(pair), g);
        }
    }

    /// The residuals of a pair if it were left out of the fit: (1 - H)^-1 r.
    fn left_out(&self, pair: &PairRows) -> Vec<f64> {
        let channels = pair.rows.len();
        let rest = DMatrix::from_fn(channels, channels, |a, b| {
            let mut leverage = 0.0;
            for (i, u) in pair.rows[a].iter().enumerate() {
                for (j, v) in pair.rows[b].iter().enumerate() {
                    leverage += u * v * self.inverse[(pair.unknown(a, i), pair.unknown(b, j))];
                }
            }
            f64::from(u8::from(a == b)) * (1.0 + LEAST) - leverage
        });
        let residuals = DVector::from_column_slice(&pair.residuals);
        let solved = rest.lu().solve(&residuals).unwrap_or(residuals);
        solved.iter().copied().collect()
    }
}
