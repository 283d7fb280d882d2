//! The dense factorisations behind [`polyharmonic`](crate::scattered).
//!
//! Written out rather than taken from nalgebra because its Cholesky runs column by column on one thread: at
//! 1435 rows this one is several times faster.

use rayon::prelude::*;

/// Reflections that turn up to four columns into a triangle; dependent columns are left out.
pub(crate) struct Householder {
    /// Unit vectors, the first j entries of the j-th zero.
    mirrors: Vec<Vec<f64>>,
    /// Row i of R, one entry a kept column.
    r: Vec<[f64; 4]>,
    /// Which columns were kept.
    kept: Vec<usize>,
}

impl Householder {
    pub(crate) fn new(columns: &[Vec<f64>; 4]) -> Self {
        let mut out = Self {
            mirrors: Vec::new(),
            r: vec![[0.0; 4]; 4],
            kept: Vec::new(),
        };
        for (j, column) in columns.iter().enumerate() {
            let at = out.mirrors.len();
            let mut x = column.clone();
            out.apply(&mut x);
            if at >= x.len() {
                continue;
            }
            let (whole, tail) = (norm(column), norm(&x[at..]));
            if tail <= 1e-7 * whole.max(1e-6) {
                continue;
            }
            let alpha = if x[at] > 0.0 { -tail } else { tail };
            let mut v = x.clone();
            v[..at].fill(0.0);
            v[at] -= alpha;
            let length = norm(&v);
            v.iter_mut().for_each(|v| *v /= length);
            for i in 0..at {
                out.r[i][at] = x[i];
            }
            out.r[at][at] = alpha;
            out.mirrors.push(v);
            out.kept.push(j);
        }
        out
    }

    pub(crate) fn rank(&self) -> usize {
        self.mirrors.len()
    }

    /// x <- H_m ... H_1 x.
    pub(crate) fn apply(&self, x: &mut [f64]) {
        self.mirrors.iter().for_each(|v| reflect(v, x));
    }

    /// x <- H_1 ... H_m x.
    pub(crate) fn apply_reverse(&self, x: &mut [f64]) {
        self.mirrors.iter().rev().for_each(|v| reflect(v, x));
    }

    /// A <- H A H for symmetric row-major A.
    pub(crate) fn conjugate(&self, a: &mut [f64], n: usize) {
        for v in &self.mirrors {
            let mut p: Vec<f64> = a.par_chunks(n).map(|row| 2.0 * dot(row, v)).collect();
            let k = dot(v, &p);
            p.iter_mut().zip(v).for_each(|(p, v)| *p -= k * v);
            a.par_chunks_mut(n).enumerate().for_each(|(i, row)| {
                let (vi, pi) = (v[i], p[i]);
                for ((a, v), p) in row.iter_mut().zip(v).zip(&p) {
                    *a -= vi * p + pi * v;
                }
            });
        }
    }

    /// c with R c = y; zero for columns that were left out.
    pub(crate) fn back_substitute(&self, y: &[f64]) -> [f64; 4] {
        let mut c = [0.0; 4];
        for i in (0..self.rank()).rev() {
            let known: f64 = (i + 1..self.rank())
                .map(|k| self.r[i][k] * c[self.kept[k]])
                .sum();
            c[self.kept[i]] = (y[i] - known) / self.r[i][i];
        }
        c
    }
}

fn reflect(v: &[f64], x: &mut [f64]) {
    let k = 2.0 * dot(v, x);
    x.iter_mut().zip(v).for_each(|(x, v)| *x -= k * v);
}

fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Eight partial sums, because one would forbid vector code.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a8, a_rest) = a.as_chunks::<8>();
    let (b8, b_rest) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a8.iter().zip(b8) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// L of a symmetric positive definite matrix, row-major.
pub(crate) struct Cholesky {
    n: usize,
    l: Vec<f64>,
}

/// Columns eliminated at a time: the panel of all rows stays in the second-level cache.
const PANEL: usize = 48;

impl Cholesky {
    /// Of the block of row-major `a` (stride `stride`) below and right of `from`.
    ///
    /// A matrix that is not quite definite, from points almost in one place, gets the smallest of a few multiples of
    /// its diagonal added. `None` if none is enough.
    pub(crate) fn new(a: &[f64], stride: usize, from: usize) -> Option<Self> {
        let n = stride - from;
        let size = (from..stride)
            .map(|i| a[i * stride + i].abs())
            .fold(0.0, f64::max);
        for ridge in [0.0, 1e-13, 1e-11, 1e-9] {
            let mut l = Vec::with_capacity(n * n);
            for i in from..stride {
                l.extend_from_slice(&a[i * stride + from..(i + 1) * stride]);
                l[(i - from) * (n + 1)] += ridge * size;
            }
            if factor(&mut l, n) {
                return Some(Self { n, l });
            }
        }
        None
    }

    /// x <- A^-1 x.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        for i in 0..self.n {
            let row = &self.l[i * self.n..];
            x[i] = (x[i] - dot(&row[..i], &x[..i])) / row[i];
        }
        for i in (0..self.n).rev() {
            let row = &self.l[i * self.n..];
            x[i] /= row[i];
            let xi = x[i];
            x[..i].iter_mut().zip(row).for_each(|(x, l)| *x -= l * xi);
        }
    }
}

/// Right-looking blocked factorisation of the lower triangle; false if a pivot is not positive.
fn factor(a: &mut [f64], n: usize) -> bool {
    let mut panel = Vec::new();
    for start in (0..n).step_by(PANEL) {
        let end = (start + PANEL).min(n);
        // the diagonal block
        for i in start..end {
            for j in start..=i {
                let (upper, lower) = a.split_at_mut(i * n);
                let row_i = &mut lower[..n];
                if i == j {
                    let pivot = row_i[i] - dot(&row_i[start..i], &row_i[start..i]);
                    if !(pivot > 0.0 && pivot.is_finite()) {
                        return false;
                    }
                    row_i[i] = pivot.sqrt();
                } else {
                    let row_j = &upper[j * n..(j + 1) * n];
                    row_i[j] = (row_i[j] - dot(&row_i[start..j], &row_j[start..j])) / row_j[j];
                }
            }
        }
        // the panel below it
        let (done, rest) = a.split_at_mut(end * n);
        let block = &done[start * n..];
        rest.par_chunks_mut(n).for_each(|row| {
            for j in start..end {
                let row_j = &block[(j - start) * n..];
                row[j] = (row[j] - dot(&row[start..j], &row_j[start..j])) / row_j[j];
            }
        });
        // what the panel takes from the rest
        let width = end - start;
        panel.clear();
        rest.chunks(n)
            .for_each(|row| panel.extend_from_slice(&row[start..end]));
        rest.par_chunks_mut(n).enumerate().for_each(|(i, row)| {
            let mine: Vec<f64> = row[start..end].to_vec();
            for (j, theirs) in panel.chunks_exact(width).take(i + 1).enumerate() {
                row[end + j] -= dot(&mine, theirs);
            }
        });
    }
    true
}
