//! Look-ups and inversion in the table for a packet of viewers: fixed numbers of steps, nothing branches on values.

use super::minifloat::decode_low_byte;
use super::options::MAX_B;
use super::table::{Table, linear};
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
    let (row, fraction) = row_of(table, places, u);
    let rows = Rows::new(table, places, &row);
    let nb = table.shape.n_b;
    let (mut x, mut target) = (ZERO, ZERO);
    for k in 0..LANES {
        let [low, high] = [rows.mass[0][k], rows.mass[1][k]];
        x[k] = linear(low, high, fraction[k]);
        target[k] = v[k] * (low + x[k] * (high - low));
    }
    // columns whose mass, with all before them, is not above the target lie before the point
    let (mut at, mut below, mut column) = (ZERO, ZERO, [0_u32; LANES]);
    for j in 1..nb - 1 {
        for k in 0..LANES {
            at[k] += 0.5 * (rows.at(j - 1, x[k], k) + rows.at(j, x[k], k));
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
        let part = (target[k] - below[k]) / (0.5 * (left[k] + right[k]));
        let y = linear(left[k], right[k], part.clamp(0.0, 1.0));
        hit.a[k] = (row[k] as f32 + x[k]) * scale_a;
        hit.b[k] = (column[k] as f32 + y) * scale_b;
        hit.density[k] = left[k] + y * (right[k] - left[k]);
    }
    hit
}

/// The interval of rows in which the blended marginal reaches `u`, and the fraction of its mass.
#[inline(always)]
fn row_of<const S: usize>(table: &Table, places: &Places<S>, u: &F) -> (Index, F) {
    let (mut at, mut len) = ([0; LANES], table.shape.n_a - 1);
    while len > 1 {
        let half = len / 2;
        let mass = below(table, places, &at, half);
        for k in 0..LANES {
            at[k] += if mass[k] <= u[k] { half as u32 } else { 0 };
        }
        len -= half;
    }
    let (low, high) = (below(table, places, &at, 0), below(table, places, &at, 1));
    let mut fraction = ZERO;
    for k in 0..LANES {
        fraction[k] = ((u[k] - low[k]) / (high[k] - low[k])).clamp(0.0, 1.0);
    }
    (at, fraction)
}

/// Blended mass below row `at + offset`.
#[inline(always)]
fn below<const S: usize>(table: &Table, places: &Places<S>, at: &Index, offset: usize) -> F {
    let na = table.shape.n_a;
    let mut out = ZERO;
    for s in 0..S {
        let mut mass = ZERO;
        for k in 0..LANES {
            mass[k] = table.below()[places.slice[s][k] as usize * na + at[k] as usize + offset];
        }
        for k in 0..LANES {
            out[k] += places.weight[s][k] * mass[k];
        }
    }
    out
}

/// The two blended rows of nodes around a point, column by column.
struct Rows {
    low: [F; MAX_B],
    high: [F; MAX_B],
    /// Their integrals, in columns.
    mass: [F; 2],
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
            mass: [ZERO; 2],
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
            for j in WORD * group..WORD * (group + 1) {
                // the trapezoid rule: half weights at both ends
                let weight = if j == 0 || j + 1 == nb { 0.5 } else { 1.0 };
                for k in 0..LANES {
                    rows.mass[0][k] += weight * rows.low[j][k];
                    rows.mass[1][k] += weight * rows.high[j][k];
                }
            }
        }
        rows
    }
}
