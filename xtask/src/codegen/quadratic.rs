//! Small quadratic programmes: the smoothest numbers that keep equations and don't go below zero.

use anyhow::{Context, Result, bail};

/// Minimise x^T H x subject to A x = b and x >= 0.
pub(super) struct Programme {
    /// H, symmetric, positive semidefinite.
    pub(super) hessian: Vec<Vec<f64>>,
    /// Rows of A, independent of each other.
    pub(super) equations: Vec<Vec<f64>>,
    /// b.
    pub(super) values: Vec<f64>,
}

/// Rounds of the active set; the problems here take about ten.
const ROUNDS: usize = 100;

impl Programme {
    /// The minimum, proven by the conditions of Karush, Kuhn and Tucker: no x below zero, no bound that pulls.
    ///
    /// Active set by whole rounds: all x below zero are fixed at zero, all fixed whose multiplier is negative are
    /// freed (the primal-dual strategy of [Hintermuller2002]).
    pub(super) fn solve(&self) -> Result<Vec<f64>> {
        let n = self.hessian.len();
        let mut fixed = vec![false; n];
        for _ in 0..ROUNDS {
            let (x, multipliers) = self.solve_with(&fixed)?;
            // 2 H x - A^T y, what pulls on a bound: must not point below zero
            let next: Vec<bool> = (0..n)
                .map(|i| {
                    if fixed[i] {
                        multipliers[i] >= 0.0
                    } else {
                        x[i] < 0.0
                    }
                })
                .collect();
            if next == fixed {
                return Ok(x);
            }
            fixed = next;
        }
        bail!("the active set did not settle in {ROUNDS} rounds")
    }

    /// The minimum with some x fixed at zero, and the gradient of the Lagrangian, which is zero for free x.
    fn solve_with(&self, fixed: &[bool]) -> Result<(Vec<f64>, Vec<f64>)> {
        let free: Vec<usize> = (0..fixed.len()).filter(|i| !fixed[*i]).collect();
        let (n, m) = (free.len(), self.equations.len());
        let mut matrix = vec![vec![0.0; n + m]; n + m];
        let mut right = vec![0.0; n + m];
        for (r, i) in free.iter().enumerate() {
            for (c, j) in free.iter().enumerate() {
                matrix[r][c] = 2.0 * self.hessian[*i][*j];
            }
            for (k, equation) in self.equations.iter().enumerate() {
                matrix[r][n + k] = -equation[*i];
                matrix[n + k][r] = equation[*i];
            }
        }
        right[n..].copy_from_slice(&self.values);
        let solution = eliminate(matrix, right).context("equations depend on each other")?;
        let mut x = vec![0.0; fixed.len()];
        for (v, i) in solution.iter().zip(&free) {
            x[*i] = *v;
        }
        let gradient = (0..fixed.len())
            .map(|i| {
                let bend: f64 = self.hessian[i]
                    .iter()
                    .zip(&x)
                    .map(|(h, v)| 2.0 * h * v)
                    .sum();
                let pull: f64 = self
                    .equations
                    .iter()
                    .zip(&solution[n..])
                    .map(|(e, y)| e[i] * y)
                    .sum();
                bend - pull
            })
            .collect();
        Ok((x, gradient))
    }
}

/// Gauss' elimination with row pivots; `None` for a singular matrix.
fn eliminate(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()))?;
        a.swap(k, pivot);
        b.swap(k, pivot);
        if a[k][k].abs() < 1e-13 {
            return None;
        }
        let (upper, lower) = a.split_at_mut(k + 1);
        let row = &upper[k];
        for (i, other) in lower.iter_mut().enumerate() {
            let f = other[k] / row[k];
            if f.abs() > 0.0 {
                for (o, r) in other[k..].iter_mut().zip(&row[k..]) {
                    *o -= f * r;
                }
                b[k + 1 + i] -= f * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        let rest: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - rest) / a[k][k];
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_nearest_point_of_a_simplex() {
        // x^2 + y^2 + (z + 1)^2 over x + y + z = 1 in the coordinates that shift z: (0.5, 0.5, 0)
        let mut hessian = vec![vec![0.0; 4]; 4];
        for (i, row) in hessian.iter_mut().enumerate().take(2) {
            row[i] = 1.0;
        }
        // w = 1 by an equation, (z + w)^2
        for i in 2..4 {
            for j in 2..4 {
                hessian[i][j] = 1.0;
            }
        }
        let programme = Programme {
            hessian,
            equations: vec![vec![1.0, 1.0, 1.0, 0.0], vec![0.0, 0.0, 0.0, 1.0]],
            values: vec![1.0, 1.0],
        };
        let x = programme.solve().unwrap();
        for (found, expected) in x.iter().zip([0.5, 0.5, 0.0, 1.0]) {
            assert!((found - expected).abs() < 1e-12, "{x:?}");
        }
    }

    #[test]
    fn refuses_equations_that_depend() {
        let programme = Programme {
            hessian: vec![vec![1.0, 0.0], vec![0.0, 1.0]],
            equations: vec![vec![1.0, 1.0], vec![2.0, 2.0]],
            values: vec![1.0, 2.0],
        };
        assert!(programme.solve().is_err());
    }
}
