//! Polyharmonic interpolation of scattered points in three dimensions [Duchon1977; Wendland2005].
//!
//! s(x) = sum_k w_k |x - x_k|^2.25 + c . (1, x), the smoothest surface through all points in a norm
//! between those of the thin plate (r^2 ln r) and the cubic spline (r^3). The kernel is conditionally positive definite of
//! order 2, so that the system is symmetric positive definite once linear functions are projected out.

use crate::scattered::chart::Point;
use crate::scattered::error::CloudError;
use crate::scattered::factor::{Cholesky, Householder};

/// Points handled at a time; the kernels of one chunk fit the first-level cache with every channel's weights.
const CHUNK: usize = 64;

/// |x|^2.25 from |x|^2, by square roots alone so that it compiles to vector code.
#[inline(always)]
fn kernel(r2: f64) -> f64 {
    r2 * r2.sqrt().sqrt().sqrt()
}

/// An interpolant of several channels through the same points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Polyharmonic {
    channels: usize,
    /// x, y, z of a chunk's points, chunk by chunk, padded with the last point.
    points: Vec<[[f64; CHUNK]; 3]>,
    /// Chunk-major, then channel; zero for padding.
    weights: Vec<[f64; CHUNK]>,
    /// 1, x, y, z about `centre`, by channel.
    linear: Vec<[f64; 4]>,
    centre: Point,
}

impl Polyharmonic {
    /// Through `points`, with row-major `values` of `channels` channels.
    ///
    /// # Errors
    /// If points coincide.
    pub(crate) fn fit(
        points: &[Point],
        values: &[f64],
        channels: usize,
    ) -> Result<Self, CloudError> {
        let n = points.len();
        let singular = || CloudError::Singular { rows: n };
        let centre: Point =
            std::array::from_fn(|a| points.iter().map(|p| p[a]).sum::<f64>() / n as f64);
        let columns: [Vec<f64>; 4] = std::array::from_fn(|j| {
            let entry = |p: &Point| {
                if j == 0 {
                    1.0
                } else {
                    p[j - 1] - centre[j - 1]
                }
            };
            points.iter().map(entry).collect()
        });
        let q = Householder::new(&columns);
        let rank = q.rank();
        // the kernel matrix, seen through the reflections that leave linear functions in its first rows
        let mut a = kernel_matrix(points);
        q.conjugate(&mut a, n);
        let mut y: Vec<Vec<f64>> = (0..channels)
            .map(|c| values.iter().skip(c).step_by(channels).copied().collect())
            .collect();
        y.iter_mut().for_each(|y| q.apply(y));
        let top: Vec<Vec<f64>> = (0..rank)
            .map(|i| a[i * n + rank..(i + 1) * n].to_vec())
            .collect();
        let factor = Cholesky::new(&a, n, rank).ok_or_else(singular)?;
        drop(a);
        let mut out = Self::empty(points, channels, centre);
        for (c, y) in y.iter().enumerate() {
            let mut u = y[rank..].to_vec();
            factor.solve(&mut u);
            let rest: Vec<f64> = (0..rank)
                .map(|i| y[i] - top[i].iter().zip(&u).map(|(a, u)| a * u).sum::<f64>())
                .collect();
            out.linear[c] = q.back_substitute(&rest);
            let mut w = vec![0.0; rank];
            w.extend(u);
            q.apply_reverse(&mut w);
            if w.iter().any(|w| !w.is_finite()) {
                return Err(singular());
            }
            for (k, w) in w.into_iter().enumerate() {
                out.weights[(k / CHUNK) * channels + c][k % CHUNK] = w;
            }
        }
        Ok(out)
    }

    /// With all weights zero.
    fn empty(points: &[Point], channels: usize, centre: Point) -> Self {
        let chunks = points.chunks(CHUNK).map(|chunk| {
            let at = |k: usize| chunk[k.min(chunk.len() - 1)];
            std::array::from_fn(|axis| std::array::from_fn(|k| at(k)[axis]))
        });
        let points: Vec<_> = chunks.collect();
        Self {
            channels,
            weights: vec![[0.0; CHUNK]; points.len() * channels],
            points,
            linear: vec![[0.0; 4]; channels],
            centre,
        }
    }

    /// The first channel at `x` into `first`, as many of the others as fit into `rest`.
    ///
    /// Compiled for each width of vector registers, of which the machine's widest is taken; no operation is fused or
    /// reordered, so that all give the same bits.
    pub(crate) fn eval(&self, x: Point, first: &mut f64, rest: &mut [f64]) {
        let d: Point = std::array::from_fn(|a| x[a] - self.centre[a]);
        let linear = |l: &[f64; 4]| l[0] + l[1] * d[0] + l[2] * d[1] + l[3] * d[2];
        *first = self.linear.first().map_or(0.0, linear);
        for (o, l) in rest.iter_mut().zip(self.linear.iter().skip(1)) {
            *o = linear(l);
        }
        brdf::arch().dispatch(KernelSum {
            surface: self,
            x,
            first,
            rest,
        });
    }

    /// The same surface in other channels: `map` has, for each new channel, what each old one adds to it.
    pub(crate) fn mapped(&self, map: &[Vec<f64>]) -> Self {
        let mut weights = Vec::with_capacity(self.points.len() * map.len());
        for old in self.weights.chunks_exact(self.channels) {
            weights.extend(map.iter().map(|row| combine(row, old)));
        }
        Self {
            channels: map.len(),
            points: self.points.clone(),
            weights,
            linear: map.iter().map(|row| combine(row, &self.linear)).collect(),
            centre: self.centre,
        }
    }

    /// Bytes of tables.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.points[..]) + size_of_val(&self.weights[..])
    }
}

/// Adds sum_k w_k |x - x_k|^2.25 of every channel.
struct KernelSum<'a> {
    surface: &'a Polyharmonic,
    x: Point,
    first: &'a mut f64,
    rest: &'a mut [f64],
}

impl pulp::WithSimd for KernelSum<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self {
            surface,
            x,
            first,
            rest,
        } = self;
        let weights = surface.weights.chunks_exact(surface.channels);
        let mut kernels = [0.0; CHUNK];
        for (points, weights) in surface.points.iter().zip(weights) {
            for (k, kernel_k) in kernels.iter_mut().enumerate() {
                let (dx, dy, dz) = (
                    x[0] - points[0][k],
                    x[1] - points[1][k],
                    x[2] - points[2][k],
                );
                *kernel_k = kernel(dx * dx + dy * dy + dz * dz);
            }
            *first += dot_chunk(&kernels, &weights[0]);
            for (o, w) in rest.iter_mut().zip(&weights[1..]) {
                *o += dot_chunk(&kernels, w);
            }
        }
    }
}

/// sum_j row_j of_j.
fn combine<const N: usize>(row: &[f64], of: &[[f64; N]]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (m, of) in row.iter().zip(of) {
        sum.iter_mut().zip(of).for_each(|(s, x)| *s += m * x);
    }
    sum
}

/// Eight partial sums, because one would forbid vector code.
#[inline(always)]
fn dot_chunk(a: &[f64; CHUNK], b: &[f64; CHUNK]) -> f64 {
    let mut sums = [0.0; 8];
    for (a, b) in a.as_chunks::<8>().0.iter().zip(b.as_chunks::<8>().0) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum()
}

/// Row-major |x_i - x_j|^2.25.
fn kernel_matrix(points: &[Point]) -> Vec<f64> {
    let n = points.len();
    let mut a = Vec::with_capacity(n * n);
    for p in points {
        a.extend(points.iter().map(|q| {
            let d = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
            kernel(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
        }));
    }
    a
}
