//! The finished table: one byte a node, and what inversion needs.

use super::minifloat::{MAX, decode, encode, look_up};
use super::optimise::normalise;
use super::options::MAX_B;
use super::problem::Unknowns;
use super::shape::{Blend, Shape};
use crate::pseudo_log::LARGE;

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
    /// 1 / (n_a - 1).
    step_a: f64,
}

/// Bytes after the last node, so that words of four may be read anywhere.
const PADDING: usize = 3;

/// A place between slices.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<const S: usize> {
    blend: Blend<S>,
    /// Factors of the decoded nodes: weight times scale.
    factor: [f32; S],
}

/// A point found by inversion, and the density there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) density: f32,
}

/// A blended row of nodes.
type Row<const B: usize> = [f32; B];

impl Table {
    /// Rounds node values to bytes and restores the mass of every slice.
    pub(crate) fn new(shape: Shape, mut x: Unknowns) -> Self {
        normalise(shape, &mut x);
        let n = shape.slice();
        let mut table = Self {
            shape,
            nodes: Vec::with_capacity(shape.nodes()),
            scale: Vec::with_capacity(shape.slices()),
            lobe: x.lobe.iter().map(|l| *l as f32).collect(),
            below: Vec::with_capacity(shape.slices() * shape.n_a),
            step_a: 1.0 / (shape.n_a - 1) as f64,
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

    /// The slices and their factors.
    #[inline(always)]
    pub(crate) fn place<const S: usize>(&self, blend: Blend<S>) -> Place<S> {
        let mut factor = blend.weight;
        for (f, k) in factor.iter_mut().zip(blend.slice) {
            *f *= self.scale[k];
        }
        Place { blend, factor }
    }

    /// Weight of the cosine lobe.
    #[inline(always)]
    pub(crate) fn lobe<const S: usize>(&self, p: &Place<S>) -> f32 {
        let mut sum = 0.0;
        for (w, k) in p.blend.weight.iter().zip(p.blend.slice) {
            sum += w * self.lobe[k];
        }
        sum
    }

    /// The bilinear density at (a, b) in [0, 1]^2. Places are f64 so that `sample` and `pdf` find the same one.
    #[inline(always)]
    pub(crate) fn density<const S: usize>(&self, p: &Place<S>, a: f64, b: f64) -> f32 {
        let (i, x) = split(a, self.shape.n_a);
        let (j, y) = split(b, self.shape.n_b);
        // rows of 32 bits cannot wrap, which spares bounds checks
        let nb = self.shape.n_b as u32 as usize;
        let (node, n) = (i * nb + j, self.shape.slice());
        let (left, right) = (1.0 - y, y);
        let hats = [(1.0 - x) * left, (1.0 - x) * right, x * left, x * right];
        let mut sum = 0.0;
        for (slice, factor) in p.blend.slice.iter().zip(p.factor) {
            let q = &self.nodes[slice * n + node..][..nb + 2];
            // scalar on purpose: packed, the four nodes of a corner would wait for each other
            let low = hats[0] * look_up(q[0]) + hats[1] * look_up(q[1]);
            let high = hats[2] * look_up(q[nb]) + hats[3] * look_up(q[nb + 1]);
            sum += factor * (low + high);
        }
        sum
    }

    /// The point whose marginal mass is `u` of a and whose conditional mass fraction is `v` of b; `u` in [0, 1 -
    /// lobe).
    #[inline]
    pub(crate) fn invert<const S: usize>(&self, p: &Place<S>, u: f32, v: f32) -> Hit {
        // loops of fixed length are worth a copy of the code for every length
        match self.shape.n_b {
            8 => self.invert_rows::<S, 8>(p, u, v),
            16 => self.invert_rows::<S, 16>(p, u, v),
            24 => self.invert_rows::<S, 24>(p, u, v),
            _ => self.invert_rows::<S, 32>(p, u, v),
        }
    }

    /// [`Self::invert`] for rows of `B` nodes.
    #[inline]
    fn invert_rows<const S: usize, const B: usize>(&self, p: &Place<S>, u: f32, v: f32) -> Hit {
        let (i, fraction) = self.row_of(p, u);
        let (low, high) = (self.row::<S, B>(p, i), self.row::<S, B>(p, i + 1));
        // the trapezoid rule: half weights at both ends
        let mass = |r: &Row<B>| eighths(r) - 0.5 * (r[0] + r[B - 1]);
        let x = linear(mass(&low), mass(&high), fraction);
        let mut row = [0.0; B];
        for j in 0..B {
            row[j] = lerp(low[j], high[j], x);
        }
        let (j, y) = column(&row, v);
        Hit {
            a: (f64::from(i as u32) + f64::from(x)) * self.step_a,
            b: (f64::from(j as u32) + f64::from(y)) * (1.0 / (B - 1) as f64),
            density: lerp(row[j], row[j + 1], y),
        }
    }

    /// The interval of rows in which the blended marginal reaches `u`, and the fraction of its mass. Rows whose mass is
    /// not above `u` are counted: no branch, no chain of loads.
    #[inline]
    fn row_of<const S: usize>(&self, p: &Place<S>, u: f32) -> (usize, f32) {
        let na = self.shape.n_a;
        let list = |s: usize| &self.below[p.blend.slice[s] * na..][..na];
        let w = p.blend.weight;
        let count = if S == 2 {
            let pairs = list(0)[1..na - 1].iter().zip(&list(1)[1..na - 1]);
            pairs
                .map(|(l, h)| u32::from(w[0] * l + w[1] * h <= u))
                .sum::<u32>()
        } else {
            let first = list(0)[1..na - 1].iter().zip(&list(1)[1..na - 1]);
            let second = list(2)[1..na - 1].iter().zip(&list(3)[1..na - 1]);
            first
                .zip(second)
                .map(|((a, b), (c, d))| {
                    u32::from((w[0] * a + w[1] * b) + (w[2] * c + w[3] * d) <= u)
                })
                .sum::<u32>()
        };
        let i = count as usize;
        let below = |i: usize| {
            let mut sum = 0.0;
            for (s, w) in w.iter().enumerate() {
                sum += w * list(s)[i];
            }
            sum
        };
        let (l, h) = (below(i), below(i + 1));
        (i, ((u - l) / (h - l)).clamp(0.0, 1.0))
    }

    #[inline]
    fn row<const S: usize, const B: usize>(&self, p: &Place<S>, i: usize) -> Row<B> {
        let (nb, n) = (self.shape.n_b, self.shape.slice());
        let mut row = [0.0; B];
        for (slice, factor) in p.blend.slice.iter().zip(p.factor) {
            let nodes: &[u8; B] = self.nodes[slice * n + i * nb..]
                .first_chunk()
                .unwrap_or(&[0; B]);
            for j in 0..B {
                row[j] += factor * decode(nodes[j]);
            }
        }
        row
    }
}

/// From `l` at 0 to `r` at 1, good to a few roundings of the result: the form with one product cancels between
/// neighbours of very different size, and `sample` and `pdf` would disagree.
#[inline(always)]
fn lerp(l: f32, r: f32, x: f32) -> f32 {
    (1.0 - x) * l + x * r
}

/// The interval of `x` in [0, 1] among `n` nodes, and where in it. Rounds by adding a large number, which is three times
/// as fast as to whole numbers and back; the last place of [0, 1] is drawn in by 1e-12 so that it falls into the last interval.
#[inline(always)]
fn split(x: f64, n: usize) -> (usize, f32) {
    let last = n as u32 - 1;
    let x = x * (f64::from(last) * (1.0 - 1e-12));
    let shifted = (x - 0.5) + LARGE;
    let i = (shifted.to_bits() as u32).min(last - 1);
    (i as usize, (x - (shifted - LARGE)) as f32)
}

/// The point of [0, 1] at which a density linear from `r0` to `r1` holds the fraction `y` of its mass. The
/// quadratic is solved in the form without cancellation.
#[inline(always)]
pub(crate) fn linear(r0: f32, r1: f32, y: f32) -> f32 {
    linear_at(r0, r1, y * (r0 + r1))
}

/// [`linear`] for twice the mass itself.
#[inline(always)]
fn linear_at(r0: f32, r1: f32, y: f32) -> f32 {
    (y / (r0 + (r0 * r0 + (r1 - r0) * y).max(0.0).sqrt())).clamp(0.0, 1.0)
}

/// The sum of a row, by eight independent sums.
#[inline]
fn eighths<const B: usize>(row: &Row<B>) -> f32 {
    let mut s = [0.0; 8];
    for eight in row.chunks_exact(8) {
        for k in 0..8 {
            s[k] += eight[k];
        }
    }
    ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]))
}

/// Cells that are summed together before they are searched one by one.
const BLOCK: usize = 4;

/// The interval in which the trapezoid sums of `row` reach the fraction `v`, and the place in it. Searched by blocks,
/// then in the block. Sums are kept and the one below the target is read by its number: chosen on the way, it would
/// branch on the outcome, which nothing foretells.
#[inline]
fn column<const B: usize>(row: &Row<B>, v: f32) -> (usize, f32) {
    let mut mass = [0.0; B];
    for j in 0..B - 1 {
        mass[j] = 0.5 * (row[j] + row[j + 1]);
    }
    let mut blocks = [0.0; MAX_B / BLOCK];
    let mut total = 0.0;
    for (below, m) in blocks.iter_mut().zip(mass.chunks_exact(BLOCK)) {
        *below = total;
        total += (m[0] + m[1]) + (m[2] + m[3]);
    }
    let target = v * total;
    let passed = |sums: &[f32]| sums.iter().map(|s| u32::from(*s <= target)).sum::<u32>() as usize;
    let block = passed(&blocks[1..B / BLOCK]);
    let m: &[f32; BLOCK] = mass[BLOCK * block..].first_chunk().unwrap_or(&[0.0; BLOCK]);
    let first = blocks[block] + m[0];
    let pair = blocks[block] + (m[0] + m[1]);
    let sums = [blocks[block], first, pair, pair + m[2]];
    // the last block has one cell less
    let cells = BLOCK - usize::from(block + 1 == B / BLOCK);
    let k = passed(&sums[1..]).min(cells - 1);
    let j = BLOCK * block + k;
    (j, linear_at(row[j], row[j + 1], 2.0 * (target - sums[k])))
}
