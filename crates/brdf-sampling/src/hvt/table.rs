//! The finished table: one byte a node, and what inversion needs.

use super::minifloat::{MAX, decode, encode, look_up};
use super::optimise::normalise;
use super::problem::Unknowns;
use super::shape::{Blend, Shape};
use crate::pseudo_angle::Ratio;
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
    /// Of every row the integral over b times the width of a cell in a: trapezoids between two of them are masses of
    /// cells. `n_a` entries a slice; then zeros so that [`SPAN`] + 1 may be read from anywhere.
    rows: Vec<f32>,
    /// Mass of the slice below row [`SPAN`], 2 [`SPAN`], ...; infinite entries make the number of a slice a multiple of
    /// [`BLOCK`].
    starts: Vec<f32>,
    /// 1 / (n_a - 1).
    step_a: f64,
}

/// Cells along a between two entries of `starts`.
pub(crate) const SPAN: usize = 8;

/// Cells that are summed together before they are searched one by one, and entries of `starts` compared together.
const BLOCK: usize = 4;

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
    /// 2 b - 1.
    pub(crate) side: Ratio,
    pub(crate) density: f32,
}

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
            rows: Vec::with_capacity(shape.slices() * shape.n_a + SPAN),
            starts: Vec::with_capacity(shape.slices() * starts(shape.n_a)),
            step_a: 1.0 / (shape.n_a - 1) as f64,
        };
        for (k, values) in x.nodes.chunks_exact(n).enumerate() {
            let unit = values.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(*v)) / MAX;
            let bytes: Vec<u8> = values.iter().map(|v| encode(v / unit)).collect();
            let decoded: Vec<f64> = bytes.iter().map(|q| f64::from(decode(*q))).collect();
            let scale = (1.0 - f64::from(table.lobe[k])) / shape.mass(&decoded);
            table.nodes.extend(bytes);
            table.scale.push(scale as f32);
            let row = |i: usize| -> f64 {
                let nodes = &decoded[i * shape.n_b..][..shape.n_b];
                let ends = 0.5 * (nodes[0] + nodes[shape.n_b - 1]);
                scale * (nodes.iter().sum::<f64>() - ends) / shape.cells() as f64
            };
            table.rows.extend((0..shape.n_a).map(|i| row(i) as f32));
            let mut sum = 0.0;
            for i in 1..shape.n_a - 1 {
                sum += 0.5 * (row(i - 1) + row(i));
                if i % SPAN == 0 {
                    table.starts.push(sum as f32);
                }
            }
            table
                .starts
                .resize((k + 1) * starts(shape.n_a), f32::INFINITY);
        }
        table.rows.resize(table.rows.len() + SPAN, 0.0);
        table.nodes.resize(shape.nodes() + PADDING, 0);
        table
    }

    /// The nodes as stored, and a few bytes more.
    #[inline(always)]
    pub(crate) fn nodes(&self) -> &[u8] {
        &self.nodes
    }

    /// Masses of rows: `n_a` entries a slice.
    #[inline(always)]
    pub(crate) fn rows(&self) -> &[f32] {
        &self.rows
    }

    /// Masses below every [`SPAN`]th row, and how many entries a slice has.
    #[inline(always)]
    pub(crate) fn starts(&self) -> (&[f32], usize) {
        (&self.starts, starts(self.shape.n_a))
    }

    pub(crate) fn bytes(&self) -> usize {
        self.shape.nodes()
            + size_of::<f32>()
                * (self.scale.len() + self.lobe.len() + self.rows.len() + self.starts.len())
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
    #[inline(always)]
    pub(crate) fn invert<const S: usize>(&self, p: &Place<S>, u: f32, v: f32) -> Hit {
        // loops of fixed length are worth a copy of the code for every length
        match self.shape.n_b {
            8 => self.invert_rows::<S, 8, 2>(p, u, v),
            16 => self.invert_rows::<S, 16, 4>(p, u, v),
            24 => self.invert_rows::<S, 24, 6>(p, u, v),
            _ => self.invert_rows::<S, 32, 8>(p, u, v),
        }
    }

    /// [`Self::invert`] for rows of `B` nodes in `N` blocks.
    #[inline(always)]
    fn invert_rows<const S: usize, const B: usize, const N: usize>(
        &self,
        p: &Place<S>,
        u: f32,
        v: f32,
    ) -> Hit {
        let (i, [l, h], [y, d]) = self.row_of(p, u);
        let rows = self.rows_around::<S, B>(p, i);
        let (low, high) = (blocks::<N>(&rows[0]), blocks::<N>(&rows[1]));
        // the row at y / d and its mass, both times d: the search does not wait for a division
        let near = d - y;
        let mut row = [[0.0; N]; BLOCK + 1];
        for m in 0..BLOCK + 1 {
            for b in 0..N {
                row[m][b] = near * low[m][b] + y * high[m][b];
            }
        }
        // masses of rows are known before their nodes are read
        let mass = near * l + y * h;
        let target = 2.0 * v * (mass * self.shape.cells() as u32 as f32);
        let (j, rest) = search(&row, target, B - 2);
        let left = near * rows[0][j] + y * rows[1][j];
        let right = near * rows[0][j + 1] + y * rows[1][j + 1];
        let across = linear_at(left, right, rest);
        let (step, first) = (2.0 / (B - 1) as f64, f64::from(j as u32));
        let [up, down] = across.map(f64::from);
        Hit {
            a: (f64::from(i as u32) + f64::from(y / d)) * self.step_a,
            side: Ratio {
                num: (first * step - 1.0) * down + step * up,
                den: down,
            },
            density: lerp(left, right, across[0] / across[1]) / d,
        }
    }

    /// The interval of rows in which the blended marginal reaches `u`, the masses of the rows at its ends, and the place in it.
    /// First by `starts`, then among the rows from there; what is not above `u` is counted, so nothing branches.
    #[inline(always)]
    fn row_of<const S: usize>(&self, p: &Place<S>, u: f32) -> (usize, [f32; 2], [f32; 2]) {
        let (w, n) = (p.blend.weight, starts(self.shape.n_a));
        let (mut passed, mut below) = ([0_u32; BLOCK], [0.0_f32; BLOCK]);
        for block in 0..n / BLOCK {
            let mut sum = [0.0; BLOCK];
            for s in 0..S {
                let list = &self.starts[p.blend.slice[s] * n + BLOCK * block..][..BLOCK];
                for k in 0..BLOCK {
                    sum[k] += w[s] * list[k];
                }
            }
            for k in 0..BLOCK {
                let is = sum[k] <= u;
                passed[k] += u32::from(is);
                below[k] = if is { sum[k] } else { below[k] };
            }
        }
        let first = SPAN * ((passed[0] + passed[1]) + (passed[2] + passed[3])) as usize;
        // they grow with their number
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let below = larger(larger(below[0], below[1]), larger(below[2], below[3]));
        let mut rows = [0.0_f32; SPAN + 1];
        for s in 0..S {
            let at = p.blend.slice[s] * self.shape.n_a + first;
            let list = self.rows[at..].first_chunk().unwrap_or(&[0.0; SPAN + 1]);
            // not up to SPAN inclusive, which would stay a loop of single numbers
            for k in 0..SPAN + 1 {
                rows[k] += w[s] * list[k];
            }
        }
        let last = (self.shape.n_a - 2 - first).min(SPAN - 1);
        let (k, rest) = search::<{ SPAN / BLOCK }>(&blocks(&rows), 2.0 * (u - below), last);
        let (l, h) = (rows[k], rows[k + 1]);
        (first + k, [l, h], linear_at(l, h, rest))
    }

    /// Rows `i` and `i` + 1, slices blended.
    #[inline(always)]
    fn rows_around<const S: usize, const B: usize>(&self, p: &Place<S>, i: usize) -> [[f32; B]; 2] {
        let n = self.shape.slice();
        let (mut low, mut high) = ([0.0; B], [0.0; B]);
        for (slice, factor) in p.blend.slice.iter().zip(p.factor) {
            let at = &self.nodes[slice * n + i * B..][..2 * B];
            for j in 0..B {
                low[j] += factor * decode(at[j]);
            }
            for j in 0..B {
                high[j] += factor * decode(at[B + j]);
            }
        }
        [low, high]
    }
}

/// The nodes of a line of cells in blocks of four cells: node 0 of every block, node 1 and so on; node 4 is node 0 of the
/// next block. The last block may end with a cell, and a node, that does not count.
type Blocks<const N: usize> = [[f32; N]; BLOCK + 1];

#[inline(always)]
fn blocks<const N: usize>(line: &[f32]) -> Blocks<N> {
    let mut nodes = [[0.0; N]; BLOCK + 1];
    for m in 0..BLOCK {
        for b in 0..N {
            nodes[m][b] = line[BLOCK * b + m];
        }
    }
    for b in 0..N - 1 {
        nodes[BLOCK][b] = line[BLOCK * (b + 1)];
    }
    if line.len() > BLOCK * N {
        nodes[BLOCK][N - 1] = line[BLOCK * N];
    }
    nodes
}

/// Entries of `starts` a slice of `n_a` rows has.
fn starts(n_a: usize) -> usize {
    ((n_a - 2) / SPAN).next_multiple_of(BLOCK)
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

/// The point of [0, 1] at which a density linear from `r0` to `r1` has the mass `y` / 2 below it, as numerator and denominator.
/// The quadratic is solved in the form without cancellation. `y` is not below 0, but may be above r0 + r1 by rounding.
#[inline(always)]
pub(crate) fn linear_at(r0: f32, r1: f32, y: f32) -> [f32; 2] {
    let d = r0 + (r0 * r0 + (r1 - r0) * y).max(0.0).sqrt();
    [if y < d { y } else { d }, d]
}

/// The cell in which twice the mass from the start of the line reaches `target`, at most cell `last`. By blocks, then in the
/// block. Sums are kept and the one below the target is read by its number: chosen on the way, it would branch on the
/// outcome, which nothing foretells.
#[inline(always)]
fn search<const N: usize>(nodes: &Blocks<N>, target: f32, last: usize) -> (usize, f32) {
    // masses from the start of a block to its nodes, and of all of it
    let (mut inside, mut whole) = ([[0.0; N]; BLOCK], [0.0; N]);
    for b in 0..N {
        let cell = [
            nodes[0][b] + nodes[1][b],
            nodes[1][b] + nodes[2][b],
            nodes[2][b] + nodes[3][b],
            nodes[3][b] + nodes[4][b],
        ];
        inside[1][b] = cell[0];
        inside[2][b] = cell[0] + cell[1];
        inside[3][b] = inside[2][b] + cell[2];
        whole[b] = inside[2][b] + (cell[2] + cell[3]);
    }
    let mut below = [0.0; N];
    for b in 1..N {
        below[b] = below[b - 1] + whole[b - 1];
    }
    let mut block = 0;
    for b in 1..N {
        block += usize::from(below[b] <= target);
    }
    let block = block.min(last / BLOCK);
    let rest = target - below[block];
    let mut k = 0;
    for m in 1..BLOCK {
        k += usize::from(inside[m][block] <= rest);
    }
    let k = k.min(last - BLOCK * block);
    (BLOCK * block + k, rest - inside[k][block])
}
