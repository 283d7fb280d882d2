//! The finished table: one byte a node, and what inversion needs.

use super::minifloat::{MAX, decode, encode};
use super::optimise::normalise;
use super::options::MAX_B;
use super::problem::Unknowns;
use super::shape::Shape;

/// Quantised densities of all slices. The density of slice k on the unit square is scale_k times the bilinear
/// interpolant of the decoded nodes and has mass 1 - lobe_k.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) shape: Shape,
    /// Slice after slice, rows of constant a; then [`PADDING`].
    nodes: Vec<u8>,
    pub(crate) scale: Vec<f32>,
    pub(crate) lobe: Vec<f32>,
    /// Mass of the slice below row i, f32, `n_a` entries a slice.
    below: Vec<f32>,
}

/// Bytes after the last node, so that words of four may be read anywhere.
const PADDING: usize = 3;

/// A place between two slices.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    k: usize,
    t: f32,
    /// Factors of the decoded nodes of either slice: (1 - t) scale_k, t scale_{k+1}.
    factor: [f32; 2],
}

/// A blended row of nodes; entries beyond the row are 0.
type Row<const B: usize> = [f32; B];

impl Table {
    /// Rounds node values to bytes and restores the mass of every slice.
    pub(crate) fn new(shape: Shape, mut x: Unknowns) -> Self {
        normalise(shape, &mut x);
        let n = shape.slice();
        let mut table = Self {
            shape,
            nodes: Vec::with_capacity(shape.nodes()),
            scale: Vec::with_capacity(shape.n_theta),
            lobe: x.lobe.iter().map(|l| *l as f32).collect(),
            below: Vec::with_capacity(shape.n_theta * shape.n_a),
        };
        for (k, values) in x.nodes.chunks_exact(n).enumerate() {
            let unit = values.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(*v)) / MAX;
            let bytes: Vec<u8> = values.iter().map(|v| encode(v / unit)).collect();
            let decoded: Vec<f64> = bytes.iter().map(|q| f64::from(decode(*q))).collect();
            let scale = (1.0 - f64::from(table.lobe[k])) / shape.mass(&decoded);
            table.nodes.extend(bytes);
            table.scale.push(scale as f32);
            let mut sum = 0.0;
            for i in 0..shape.n_a {
                table.below.push(sum as f32);
                let row = |i: usize| -> f64 {
                    let at = |j: usize| decoded[i * shape.n_b + j];
                    let ends = 0.5 * (at(0) + at(shape.n_b - 1));
                    (0..shape.n_b).map(at).sum::<f64>() - ends
                };
                if i + 1 < shape.n_a {
                    sum += 0.5 * scale * (row(i) + row(i + 1)) / shape.cells() as f64;
                }
            }
        }
        table.nodes.resize(shape.nodes() + PADDING, 0);
        table
    }

    /// The nodes as stored, and a few bytes more.
    #[inline(always)]
    pub(crate) fn nodes(&self) -> &[u8] {
        &self.nodes
    }

    /// Mass of each slice below its rows, `n_a` entries a slice.
    #[inline(always)]
    pub(crate) fn below(&self) -> &[f32] {
        &self.below
    }

    pub(crate) fn bytes(&self) -> usize {
        self.shape.nodes()
            + size_of::<f32>() * (self.scale.len() + self.lobe.len() + self.below.len())
    }

    /// The blend at slice coordinate `x` in [0, `n_theta` - 1].
    #[inline]
    pub(crate) fn place_at(&self, x: f32) -> Place {
        let k = (x as usize).min(self.shape.n_theta - 2);
        let t = x - k as f32;
        Place {
            k,
            t,
            factor: [(1.0 - t) * self.scale[k], t * self.scale[k + 1]],
        }
    }

    /// Weight of the cosine lobe.
    #[inline]
    pub(crate) fn lobe_at(&self, p: Place) -> f32 {
        (1.0 - p.t) * self.lobe[p.k] + p.t * self.lobe[p.k + 1]
    }

    /// The bilinear density at (a, b) in [0, 1]^2.
    #[inline]
    pub(crate) fn density(&self, p: Place, a: f32, b: f32) -> f32 {
        let (i, x) = split(a, self.shape.n_a);
        let (j, y) = split(b, self.shape.n_b);
        let (nb, n) = (self.shape.n_b, self.shape.slice());
        let corner = |slice: usize| {
            let at = slice * n + i * nb + j;
            // one bounds check for the nodes from here to the next row
            let q = &self.nodes[at..at + nb + 2];
            let low = decode(q[0]) + y * (decode(q[1]) - decode(q[0]));
            let high = decode(q[nb]) + y * (decode(q[nb + 1]) - decode(q[nb]));
            low + x * (high - low)
        };
        p.factor[0] * corner(p.k) + p.factor[1] * corner(p.k + 1)
    }

    /// The point whose marginal mass is `u` of a and whose conditional mass fraction is `v` of b; `u` in [0, 1 -
    /// lobe).
    #[inline]
    pub(crate) fn invert(&self, p: Place, u: f32, v: f32) -> (f32, f32) {
        // loops of fixed length are worth a copy of the code for the usual rows
        if self.shape.n_b <= MAX_B / 2 {
            self.invert_within::<{ MAX_B / 2 }>(p, u, v)
        } else {
            self.invert_within::<MAX_B>(p, u, v)
        }
    }

    /// [`Self::invert`] for rows of at most `B` nodes.
    #[inline]
    fn invert_within<const B: usize>(&self, p: Place, u: f32, v: f32) -> (f32, f32) {
        let (i, fraction) = self.row_of(p, u);
        let (low, high) = (self.row::<B>(p, i), self.row::<B>(p, i + 1));
        let nb = self.shape.n_b;
        // the trapezoid rule: half weights at both ends
        let mass = |r: &Row<B>| eighths(r) - 0.5 * (r[0] + r[nb - 1]);
        let x = linear(mass(&low), mass(&high), fraction);
        let mut row = [0.0; B];
        for j in 0..B {
            row[j] = low[j] + x * (high[j] - low[j]);
        }
        let (j, y) = column(&row, nb - 1, v);
        (
            (i as f32 + x) / (self.shape.n_a - 1) as f32,
            (j as f32 + y) / (nb - 1) as f32,
        )
    }

    /// The interval of rows in which the blended marginal reaches `u`, and the fraction of its mass.
    #[inline]
    fn row_of(&self, p: Place, u: f32) -> (usize, f32) {
        let na = self.shape.n_a;
        let (low, high) = (
            &self.below[p.k * na..][..na],
            &self.below[(p.k + 1) * na..][..na],
        );
        let below = |i: usize| low[i] + p.t * (high[i] - low[i]);
        let (mut first, mut len) = (0, na - 1);
        while len > 1 {
            let half = len / 2;
            first = if below(first + half) <= u {
                first + half
            } else {
                first
            };
            len -= half;
        }
        let (l, h) = (below(first), below(first + 1));
        (first, ((u - l) / (h - l)).clamp(0.0, 1.0))
    }

    #[inline]
    fn row<const B: usize>(&self, p: Place, i: usize) -> Row<B> {
        let (nb, n) = (self.shape.n_b, self.shape.slice());
        let low = &self.nodes[p.k * n + i * nb..][..nb];
        let high = &self.nodes[(p.k + 1) * n + i * nb..][..nb];
        let mut row = [0.0; B];
        for (r, (a, b)) in row.iter_mut().zip(low.iter().zip(high)) {
            *r = p.factor[0] * decode(*a) + p.factor[1] * decode(*b);
        }
        row
    }
}

/// The interval of `x` in [0, 1] among `n` nodes, and where in it.
#[inline]
fn split(x: f32, n: usize) -> (usize, f32) {
    let x = x * (n - 1) as f32;
    let i = (x as usize).min(n - 2);
    (i, x - i as f32)
}

/// The point of [0, 1] at which a density linear from `r0` to `r1` holds the fraction `y` of its mass. The
/// quadratic is solved in the form without cancellation.
#[inline(always)]
pub(crate) fn linear(r0: f32, r1: f32, y: f32) -> f32 {
    let y = y * (r0 + r1);
    (y / (r0 + (r0 * r0 + (r1 - r0) * y).max(0.0).sqrt())).min(1.0)
}

/// The sum of a row, by eight independent sums.
#[inline]
fn eighths<const B: usize>(row: &Row<B>) -> f32 {
    let mut sums = [0.0; 8];
    for eight in row.chunks_exact(8) {
        for k in 0..8 {
            sums[k] += eight[k];
        }
    }
    sums.iter().sum()
}

/// Cells that are summed together before they are searched one by one.
const BLOCK: usize = 4;

/// The interval, of the first `cells`, in which the trapezoid sums of `row` reach the fraction `v`, and the place
/// in it. Searched by blocks, then in the block; nothing branches on the outcome.
#[inline]
fn column<const B: usize>(row: &Row<B>, cells: usize, v: f32) -> (usize, f32) {
    let mut mass = [0.0; B];
    for j in 0..B - 1 {
        let inside = if j < cells { 0.5 } else { 0.0 };
        mass[j] = inside * (row[j] + row[j + 1]);
    }
    let mut blocks = [0.0; MAX_B / BLOCK];
    for (block, m) in blocks.iter_mut().zip(mass.chunks_exact(BLOCK)) {
        *block = (m[0] + m[1]) + (m[2] + m[3]);
    }
    let target = v * blocks.iter().sum::<f32>();
    let (mut below, mut at, mut first) = (0.0, 0.0, 0);
    for block in &blocks[..cells.div_ceil(BLOCK) - 1] {
        at += block;
        let passed = at <= target;
        first += BLOCK * usize::from(passed);
        below = if passed { at } else { below };
    }
    let block: [f32; BLOCK] = std::array::from_fn(|k| mass[first + k]);
    let (mut at, start, mut j) = (below, first, first);
    for (k, m) in block[..BLOCK - 1].iter().enumerate() {
        at += m;
        let passed = at <= target && start + k + 1 < cells;
        j += usize::from(passed);
        below = if passed { at } else { below };
    }
    let y = ((target - below) / mass[j]).clamp(0.0, 1.0);
    (j, linear(row[j], row[j + 1], y))
}
