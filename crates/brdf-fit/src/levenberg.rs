//! The outer iteration: Levenberg-Marquardt [Marquardt1963] over the shape alone, the weights projected out
//! [GolubPereyra1973] in Kaufman's approximation [Kaufman1975].
//!
//! With the weights at their optimum for every shape, the Gauss-Newton matrix of the remaining problem is the Schur
//! complement of J^T J over the weights that are not held at zero. Own code, because the rows are summed in blocks and
//! never held: libraries for this method want the whole Jacobian.

use nalgebra::{DMatrix, DVector};

use crate::problem::{Normal, Point, Problem};

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) iterations: usize,
    /// Relative decrease of the cost below which a step counts as the last.
    pub(crate) tolerance: f64,
}

/// Damping of the first step, relative to the diagonal of the normal matrix [Marquardt1963].
const FIRST_DAMPING: f64 = 1e-2;
/// Damping at which no step is worth trying any more.
const LAST_DAMPING: f64 = 1e8;

/// Descends from `start`; the result is never worse. With it come its normal equations, if it ended knowing them.
pub(crate) fn descend(
    problem: &Problem<'_>,
    start: Point,
    limits: Limits,
) -> (Point, Option<Normal>) {
    let bounds = problem.bounds();
    let mut point = start;
    let mut damping = FIRST_DAMPING;
    for _ in 0..limits.iterations {
        if bounds.is_empty() || point.cost <= 0.0 {
            break;
        }
        let normal = problem.normal(&point);
        let reduced = Reduced::new(&normal, &point, &bounds);
        // what a whole step would gain is not worth taking it
        if reduced.promise() <= limits.tolerance * point.cost {
            return (point, Some(normal));
        }
        let Some((better, next)) = step(problem, &point, &reduced, damping) else {
            return (point, Some(normal));
        };
        let gained = point.cost - better.cost;
        let done = gained <= limits.tolerance * point.cost;
        point = better;
        damping = next;
        if done {
            break;
        }
    }
    (point, None)
}

/// Raises the damping until a step lowers the cost; the new point and the damping to go on with.
fn step(
    problem: &Problem<'_>,
    point: &Point,
    reduced: &Reduced,
    mut damping: f64,
) -> Option<(Point, f64)> {
    let bounds = problem.bounds();
    while damping < LAST_DAMPING {
        if let Some(delta) = reduced.step(damping) {
            let u: Vec<f64> = (point.u.iter().zip(&delta).zip(&bounds))
                .map(|((u, d), (low, high))| (u + d).clamp(*low, *high))
                .collect();
            let moved = u
                .iter()
                .zip(&point.u)
                .any(|(a, b)| a.to_bits() != b.to_bits());
            if !moved {
                return None;
            }
            let trial = problem.solve(&u, Some(&point.weights));
            if trial.cost < point.cost {
                return Some((trial, (0.1 * damping).max(1e-12)));
            }
        }
        damping *= 10.0;
    }
    None
}

/// The normal equations of the shape alone.
struct Reduced {
    matrix: DMatrix<f64>,
    gradient: DVector<f64>,
    /// Which variables may move: not those held at a bound by their gradient.
    free: Vec<bool>,
}

impl Reduced {
    fn new(normal: &Normal, point: &Point, bounds: &[(f64, f64)]) -> Self {
        let p = point.u.len();
        let active = active_weights(point);
        let (matrix, gradient) = schur(normal, p, &active);
        let free = (0..p)
            .map(|j| {
                let (low, high) = bounds[j];
                let at_low = point.u[j] <= low && gradient[j] > 0.0;
                let at_high = point.u[j] >= high && gradient[j] < 0.0;
                !(at_low || at_high)
            })
            .collect();
        Self {
            matrix,
            gradient,
            free,
        }
    }

    /// The decrease of the cost that an undamped step promises, g^T A^-1 g; infinite where there is none.
    fn promise(&self) -> f64 {
        let free: Vec<usize> = (0..self.free.len()).filter(|&j| self.free[j]).collect();
        let a = DMatrix::from_fn(free.len(), free.len(), |i, j| {
            self.matrix[(free[i], free[j])]
        });
        let g = DVector::from_fn(free.len(), |i, _| self.gradient[free[i]]);
        a.cholesky().map_or(f64::INFINITY, |a| a.solve(&g).dot(&g))
    }

    /// The damped step, at most two in any variable: beyond that the linearisation says nothing.
    fn step(&self, damping: f64) -> Option<Vec<f64>> {
        let free: Vec<usize> = (0..self.free.len()).filter(|&j| self.free[j]).collect();
        if free.is_empty() {
            return None;
        }
        let largest = free
            .iter()
            .map(|&j| self.matrix[(j, j)])
            .fold(0.0, f64::max);
        let a = DMatrix::from_fn(free.len(), free.len(), |i, j| {
            let value = self.matrix[(free[i], free[j])];
            if i == j {
                // a variable without influence gets a diagonal of its own
                value + damping * value.max(1e-9 * largest)
            } else {
                value
            }
        });
        let g = DVector::from_fn(free.len(), |i, _| -self.gradient[free[i]]);
        let z = a.cholesky()?.solve(&g);
        let longest = z.amax();
        let shrink = if longest > MAX_STEP {
            MAX_STEP / longest
        } else {
            1.0
        };
        let mut delta = vec![0.0; self.free.len()];
        free.iter()
            .zip(z.iter())
            .for_each(|(&j, z)| delta[j] = shrink * z);
        delta.iter().all(|d| d.is_finite()).then_some(delta)
    }
}

/// Largest change of a variable in one step: a factor of 7 of a roughness.
const MAX_STEP: f64 = 2.0;

/// Indices (in a normal matrix) of weights that are not held at zero.
pub(crate) fn active_weights(point: &Point) -> Vec<usize> {
    let p = point.u.len();
    (point.weights.iter().flatten().enumerate())
        .filter(|(_, w)| w.abs() > 0.0)
        .map(|(k, _)| p + k)
        .collect()
}

/// J^T J and J^T r over the first `p` unknowns with the `active` ones eliminated.
fn schur(normal: &Normal, p: usize, active: &[usize]) -> (DMatrix<f64>, DVector<f64>) {
    let a = normal.jtj.view((0, 0), (p, p)).into_owned();
    let g = normal.jtr.rows(0, p).into_owned();
    let n = active.len();
    if n == 0 {
        return (a, g);
    }
    let d = DVector::from_fn(n, |i, _| {
        normal.jtj[(active[i], active[i])]
            .max(f64::MIN_POSITIVE)
            .sqrt()
    });
    // unit diagonal, and a ridge of rounding size for lobes that are copies of each other
    let w = DMatrix::from_fn(n, n, |i, j| {
        let value = normal.jtj[(active[i], active[j])] / (d[i] * d[j]);
        if i == j { value + 1e-13 } else { value }
    });
    let b = DMatrix::from_fn(n, p, |i, j| normal.jtj[(active[i], j)] / d[i]);
    let h = DVector::from_fn(n, |i, _| normal.jtr[active[i]] / d[i]);
    match w.cholesky() {
        Some(w) => (
            a - b.transpose() * w.solve(&b),
            g - b.transpose() * w.solve(&h),
        ),
        None => (a, g),
    }
}
