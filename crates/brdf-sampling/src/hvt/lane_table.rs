//! Look-ups and inversion in the table for a packet of viewers: fixed numbers of steps, nothing branches on values.

use super::minifloat::decode_low_byte;
use super::options::MAX_B;
use super::table::{SPAN, Table, linear_at};
use crate::lane_math::{F, ZERO};
use brdf::{LANES, Lanes3};

/// Indices, one a lane.
type Index = [u32; LANES];

/// The nodes of a row that one word holds.
const WORD: usize = 4;

/// Where viewers lie between `S` slices.
pub(super) struct Places<const S: usize> {
    slice: [Index; S],
    weight: [F; S],
    /// Factors of the decoded nodes: weight times scale.
    factor: [F; S],
    /// Weight of the cosine lobe.
    pub(super) lobe: F,
}

impl<const S: usize> Places<S> {
    /// The blends of viewers toward `wo` at slice coordinates `tau` in [0, 1].
    #[inline(always)]
    pub(super) fn new(table: &Table, tau: &F, wo: &Lanes3) -> Self {
        let shape = table.shape;
        let last = (shape.n_theta - 2) as u32;
        let mut p = Self {
            slice: [[0; LANES]; S],
            weight: [ZERO; S],
            factor: [ZERO; S],
            lobe: ZERO,
        };
        for k in 0..LANES {
            let x = tau[k] * (last + 1) as f32;
            let low = (x as u32).min(last);
            let t = x - low as f32;
            if S == 2 {
                (p.slice[0][k], p.slice[1][k]) = (low, low + 1);
                (p.weight[0][k], p.weight[1][k]) = (1.0 - t, t);
            } else {
                let [j0, j1, v] = shape.around(wo.x[k], wo.y[k]);
                let at = |j: f32| j as u32 * shape.n_theta as u32 + low;
                for (s, (slice, w)) in [(at(j0), 1.0 - v), (at(j1), v)].into_iter().enumerate() {
                    (p.slice[2 * s][k], p.slice[2 * s + 1][k]) = (slice, slice + 1);
                    (p.weight[2 * s][k], p.weight[2 * s + 1][k]) = (w * (1.0 - t), w * t);
                }
            }
        }
        for s in 0..S {
            let (mut scale, mut lobe) = (ZERO, ZERO);
            for k in 0..LANES {
                let at = p.slice[s][k] as usize;
                (scale[k], lobe[k]) = (table.scale[at], table.lobe[at]);
            }
            for k in 0..LANES {
                p.factor[s][k] = p.weight[s][k] * scale[k];
                p.lobe[k] += p.weight[s][k] * lobe[k];
            }
        }
        p
    }
}

/// The bilinear densities at (a, b) in [0, 1]^2.
#[inline(always)]
pub(super) fn density<const S: usize>(table: &Table, places: &Places<S>, a: &F, b: &F) -> F {
    let (nb, n) = (table.shape.n_b, table.shape.slice());
    let (last_a, last_b) = ((table.shape.n_a - 2) as u32, (nb - 2) as u32);
    let (mut x, mut y, mut node): (F, F, Index) = (ZERO, ZERO, [0; LANES]);
    for k in 0..LANES {
        let (u, v) = (a[k] * (last_a + 1) as f32, b[k] * (last_b + 1) as f32);
        let (i, j) = ((u as u32).min(last_a), (v as u32).min(last_b));
        (x[k], y[k]) = (u - i as f32, v - j as f32);
        node[k] = i * nb as u32 + j;
    }
    let (mut low, mut high) = (ZERO, ZERO);
    for s in 0..S {
        let mut pairs = [[0_u32; LANES]; 2];
        for k in 0..LANES {
            let q = &table.nodes()[places.slice[s][k] as usize * n + node[k] as usize..][..nb + 2];
            let pair = |at: usize| u32::from(u16::from_le_bytes([q[at], q[at + 1]]));
            (pairs[0][k], pairs[1][k]) = (pair(0), pair(nb));
        }
        for k in 0..LANES {
            let along = |q: u32| {
                let (left, right) = (decode_low_byte(q), decode_low_byte(q >> 8));
                left + y[k] * (right - left)
            };
            low[k] += places.factor[s][k] * along(pairs[0][k]);
            high[k] += places.factor[s][k] * along(pairs[1][k]);
        }
    }
    let mut out = ZERO;
    for k in 0..LANES {
        out[k] = low[k] + x[k] * (high[k] - low[k]);
    }
    out
}

/// Points found by inversion, and the density there.
pub(super) struct Hit {
    pub(super) a: F,
    pub(super) b: F,
    pub(super) density: F,
}

/// The points whose marginal mass is `u` of a and whose conditional mass fraction is `v` of b; `u` in [0, 1 - lobe).
#[inline(always)]
pub(super) fn invert<const S: usize>(table: &Table, places: &Places<S>, u: &F, v: &F) -> Hit {
    let (row, x, mass) = row_of(table, places, u);
    let rows = Rows::new(table, places, &row);
    let nb = table.shape.n_b;
    let (mut target, unit) = (ZERO, 2.0 * table.shape.cells() as f32);
    for k in 0..LANES {
        target[k] = v[k] * (mass[k] * unit);
    }
    // columns whose mass, with all before them, is not above the target lie before the point
    let (mut at, mut below, mut column) = (ZERO, ZERO, [0_u32; LANES]);
    for j in 1..nb - 1 {
        for k in 0..LANES {
            at[k] += rows.at(j - 1, x[k], k) + rows.at(j, x[k], k);
            let passed = at[k] <= target[k];
            column[k] += u32::from(passed);
            below[k] = below[k].max(if passed { at[k] } else { 0.0 });
        }
    }
    let (mut left, mut right) = (ZERO, ZERO);
    for k in 0..LANES {
        let j = (column[k] as usize).min(MAX_B - 2);
        (left[k], right[k]) = (rows.at(j, x[k], k), rows.at(j + 1, x[k], k));
    }
    let mut hit = Hit {
        a: ZERO,
        b: ZERO,
        density: ZERO,
    };
    let (scale_a, scale_b) = (1.0 / (table.shape.n_a - 1) as f32, 1.0 / (nb - 1) as f32);
    for k in 0..LANES {
        let [y, d] = linear_at(left[k], right[k], target[k] - below[k]);
        let y = y / d;
        hit.a[k] = (row[k] as f32 + x[k]) * scale_a;
        hit.b[k] = (column[k] as f32 + y) * scale_b;
        hit.density[k] = left[k] + y * (right[k] - left[k]);
    }
    hit
}

/// The interval of rows in which the blended marginal reaches `u`, the place in it, and the mass of a row there: as
/// the scalar form finds it.
#[inline(always)]
fn row_of<const S: usize>(table: &Table, places: &Places<S>, u: &F) -> (Index, F, F) {
    let (starts, n) = table.starts();
    let (mut first, mut below) = ([0_u32; LANES], ZERO);
    for block in 0..(table.shape.n_a - 2) / SPAN {
        let mass = blended(places, starts, n, &[block as u32; LANES]);
        for k in 0..LANES {
            let passed = mass[k] <= u[k];
            first[k] += if passed { SPAN as u32 } else { 0 };
            below[k] = below[k].max(if passed { mass[k] } else { 0.0 });
        }
    }
    let mut rows = [ZERO; SPAN + 1];
    for (o, row) in rows.iter_mut().enumerate() {
        let at = first.map(|f| f + o as u32);
        *row = blended(places, table.rows(), table.shape.n_a, &at);
    }
    let (mut target, mut at, mut under, mut cell) = (ZERO, ZERO, ZERO, [0_u32; LANES]);
    for k in 0..LANES {
        target[k] = 2.0 * (u[k] - below[k]);
    }
    let last = table.shape.n_a as u32 - 2;
    for o in 0..SPAN - 1 {
        for k in 0..LANES {
            at[k] += rows[o][k] + rows[o + 1][k];
            let passed = at[k] <= target[k] && first[k] + (o as u32) < last;
            cell[k] += u32::from(passed);
            under[k] = under[k].max(if passed { at[k] } else { 0.0 });
        }
    }
    let (mut low, mut high) = (ZERO, ZERO);
    for k in 0..LANES {
        let j = (cell[k] as usize).min(SPAN - 1);
        (low[k], high[k]) = (rows[j][k], rows[j + 1][k]);
    }
    let (mut x, mut mass) = (ZERO, ZERO);
    for k in 0..LANES {
        let [y, d] = linear_at(low[k], high[k], target[k] - under[k]);
        x[k] = y / d;
        mass[k] = low[k] + x[k] * (high[k] - low[k]);
        first[k] += cell[k];
    }
    (first, x, mass)
}

/// Entries number `at` of lists with `n` entries a slice, blended.
#[inline(always)]
fn blended<const S: usize>(places: &Places<S>, lists: &[f32], n: usize, at: &Index) -> F {
    let mut out = ZERO;
    for s in 0..S {
        let mut value = ZERO;
        for k in 0..LANES {
            value[k] = lists[places.slice[s][k] as usize * n + at[k] as usize];
        }
        for k in 0..LANES {
            out[k] += places.weight[s][k] * value[k];
        }
    }
    out
}

/// The two blended rows of nodes around a point, column by column.
struct Rows {
    low: [F; MAX_B],
    high: [F; MAX_B],
}

impl Rows {
    /// Node `j` of the row at `x` between the two, in lane `k`.
    #[inline(always)]
    fn at(&self, j: usize, x: f32, k: usize) -> f32 {
        self.low[j][k] + x * (self.high[j][k] - self.low[j][k])
    }

    #[inline(always)]
    fn new<const S: usize>(table: &Table, places: &Places<S>, row: &Index) -> Self {
        let (nb, n) = (table.shape.n_b, table.shape.slice());
        let mut rows = Self {
            low: [ZERO; MAX_B],
            high: [ZERO; MAX_B],
        };
        for group in 0..nb / WORD {
            for s in 0..S {
                let mut words = [[0_u32; LANES]; 2];
                for k in 0..LANES {
                    let node =
                        places.slice[s][k] as usize * n + row[k] as usize * nb + WORD * group;
                    let q = &table.nodes()[node..][..nb + WORD];
                    let word =
                        |at: usize| u32::from_le_bytes([q[at], q[at + 1], q[at + 2], q[at + 3]]);
                    (words[0][k], words[1][k]) = (word(0), word(nb));
                }
                for j in WORD * group..WORD * (group + 1) {
                    let shift = 8 * (j % WORD) as u32;
                    for k in 0..LANES {
                        let f = places.factor[s][k];
                        rows.low[j][k] += f * decode_low_byte(words[0][k] >> shift);
                        rows.high[j][k] += f * decode_low_byte(words[1][k] >> shift);
                    }
                }
            }
        }
        rows
    }
}
