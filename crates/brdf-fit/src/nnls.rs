//! Least squares with non-negative unknowns [LawsonHanson1974], from the normal equations.
//!
//! The unknowns are the weights of a handful of lobes, the rows are millions of cells: only the Gram matrix is ever
//! held. The active-set method ends after finitely many steps at the exact optimum.

use nalgebra::{DMatrix, DVector};

/// Relative gradient below which a weight at zero stays there: rounding of sums of 1e6 terms.
const TOLERANCE: f64 = 1e-12;

/// The `x >= 0` that minimises x^T `gram` x - 2 `rhs`^T x.
///
/// `gram` is symmetric and positive semidefinite. Of several minimisers the one found first is returned.
#[must_use]
pub fn nnls(gram: &DMatrix<f64>, rhs: &DVector<f64>) -> DVector<f64> {
    let n = rhs.len();
    let mut x = DVector::zeros(n);
    let mut passive = vec![false; n];
    // each pass frees one unknown; 3 n passes are what the method needs in practice, the rest is insurance
    for _ in 0..10 * n.max(1) {
        let slope = rhs - gram * &x;
        let enters = (0..n)
            .filter(|&k| !passive[k] && slope[k] > TOLERANCE * rhs[k].abs())
            .max_by(|&a, &b| scaled(&slope, gram, a).total_cmp(&scaled(&slope, gram, b)));
        let Some(enters) = enters else { break };
        passive[enters] = true;
        if !settle(gram, rhs, &mut passive, &mut x) {
            // a copy of what is passive already: it cannot help
            passive[enters] = false;
            break;
        }
    }
    x
}

/// The descent of unknown `k` in units of its own curvature, so that the order does not depend on scale.
fn scaled(slope: &DVector<f64>, gram: &DMatrix<f64>, k: usize) -> f64 {
    slope[k] / gram[(k, k)].max(f64::MIN_POSITIVE).sqrt()
}

/// Solves over the passive set, dropping unknowns that would turn negative; false if the set is singular.
fn settle(
    gram: &DMatrix<f64>,
    rhs: &DVector<f64>,
    passive: &mut [bool],
    x: &mut DVector<f64>,
) -> bool {
    loop {
        let set: Vec<usize> = (0..x.len()).filter(|&k| passive[k]).collect();
        let Some(z) = solve_on(gram, rhs, &set) else {
            return false;
        };
        if z.iter().all(|v| *v > 0.0) {
            x.fill(0.0);
            set.iter().zip(z.iter()).for_each(|(&k, v)| x[k] = *v);
            return true;
        }
        // the step towards z that keeps all unknowns at or above zero
        let alpha = (set.iter().zip(z.iter()))
            .filter(|(_, z)| **z <= 0.0)
            .map(|(&k, z)| x[k] / (x[k] - z))
            .fold(1.0_f64, f64::min);
        for (&k, z) in set.iter().zip(z.iter()) {
            x[k] += alpha * (z - x[k]);
            if *z <= 0.0 && x[k] <= f64::EPSILON * z.abs() {
                x[k] = 0.0;
                passive[k] = false;
            }
        }
    }
}

/// The unconstrained solution over `set`, scaled to a unit diagonal; `None` if it is singular.
pub(crate) fn solve_on(
    gram: &DMatrix<f64>,
    rhs: &DVector<f64>,
    set: &[usize],
) -> Option<DVector<f64>> {
    let d: Vec<f64> = set.iter().map(|&k| gram[(k, k)].sqrt()).collect();
    if d.iter().any(|d| d.is_nan() || *d <= 0.0) {
        return None;
    }
    let a = DMatrix::from_fn(set.len(), set.len(), |i, j| {
        gram[(set[i], set[j])] / (d[i] * d[j])
    });
    let b = DVector::from_fn(set.len(), |i, _| rhs[set[i]] / d[i]);
    let z = a.cholesky()?.solve(&b);
    let z = DVector::from_fn(set.len(), |i, _| z[i] / d[i]);
    z.iter().all(|v| v.is_finite()).then_some(z)
}

#[cfg(test)]
mod tests {
    use super::{nnls, solve_on};
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    fn cost(gram: &DMatrix<f64>, rhs: &DVector<f64>, x: &DVector<f64>) -> f64 {
        (x.transpose() * gram * x)[0] - 2.0 * rhs.dot(x)
    }

    /// Every subset of unknowns, solved freely; the best that stays non-negative.
    fn brute_force(gram: &DMatrix<f64>, rhs: &DVector<f64>) -> f64 {
        let n = rhs.len();
        let mut best = 0.0;
        for subset in 1_usize..1 << n {
            let set: Vec<usize> = (0..n).filter(|k| subset >> k & 1 == 1).collect();
            let Some(z) = solve_on(gram, rhs, &set) else {
                continue;
            };
            if z.iter().all(|v| *v >= 0.0) {
                let mut x = DVector::zeros(n);
                set.iter().zip(z.iter()).for_each(|(&k, v)| x[k] = *v);
                best = cost(gram, rhs, &x).min(best);
            }
        }
        best
    }

    proptest! {
        #[test]
        fn as_good_as_trying_every_active_set(
            n in 1_usize..6,
            entries in prop::collection::vec(-1.0..1.0_f64, 60),
            data in prop::collection::vec(-1.0..1.0_f64, 10),
        ) {
            let a = DMatrix::from_fn(10, n, |i, j| entries[i * n + j]);
            let b = DVector::from_column_slice(&data);
            let (gram, rhs) = (a.transpose() * &a, a.transpose() * b);
            let x = nnls(&gram, &rhs);
            prop_assert!(x.iter().all(|v| *v >= 0.0), "{x}");
            let (found, best) = (cost(&gram, &rhs, &x), brute_force(&gram, &rhs));
            // both are solved to the rounding of a well-conditioned 5 x 5 system
            prop_assert!(found <= best + 1e-10 * best.abs() + 1e-12, "{found} {best}");
        }
    }

    #[test]
    fn two_copies_of_one_lobe_are_no_trouble() {
        let gram = DMatrix::from_element(2, 2, 1.0);
        let x = nnls(&gram, &DVector::from_element(2, 3.0));
        assert!((x.sum() - 3.0).abs() < 1e-15, "{x}");
    }

    #[test]
    fn a_lobe_that_is_nowhere_gets_nothing() {
        let gram = DMatrix::from_row_slice(2, 2, &[4.0, 0.0, 0.0, 0.0]);
        let x = nnls(&gram, &DVector::from_row_slice(&[2.0, 0.0]));
        assert!((x[0] - 0.5).abs() < 1e-15 && x[1] == 0.0, "{x}");
    }
}
