//! Look-ups and inversion in the table for a packet of viewers: fixed numbers of steps, nothing branches on values.

use super::minifloat::decode_low_byte;
use super::options::MAX_B;
use super::table::{Table, linear};
use crate::lane_math::{F, ZERO};
use brdf::LANES;

/// Indices, one a lane.
type Index = [u32; LANES];

/// The nodes of a row that one word holds.
const WORD: usize = 4;

/// Where viewers lie between slices.
pub(super) struct Places {
    slice: Index,
    t: F,
    /// Factors of the decoded nodes of either slice: (1 - t) scale_k, t scale_{k+1}.
    factor: [F; 2],
    /// Weight of the cosine lobe.
    pub(super) lobe: F,
}

impl Places {
    /// The blends at slice coordinates in [0, n_theta - 1].
    #[inline(always)]
    pub(super) fn new(table: &Table, x: &F) -> Self {
        let last = (table.shape.n_theta - 2) as u32;
        let (mut slice, mut t) = ([0; LANES], ZERO);
        for k in 0..LANES {
            slice[k] = (x[k] as u32).min(last);
            t[k] = x[k] - slice[k] as f32;
        }
        let (scales, lobes) = (pairs(&table.scale, &slice), pairs(&table.lobe, &slice));
        let (mut factor, mut lobe) = ([ZERO; 2], ZERO);
        for k in 0..LANES {
            factor[0][k] = (1.0 - t[k]) * scales[0][k];
            factor[1][k] = t[k] * scales[1][k];
            lobe[k] = (1.0 - t[k]) * lobes[0][k] + t[k] * lobes[1][k];
        }
        Self {
            slice,
            t,
            factor,
            lobe,
        }
    }
}

/// Neighbours in a list.
#[inline(always)]
fn pairs(list: &[f32], at: &Index) -> [F; 2] {
    let mut out = [ZERO; 2];
    for k in 0..LANES {
        let pair = &list[at[k] as usize..][..2];
        (out[0][k], out[1][k]) = (pair[0], pair[1]);
    }
    out
}

/// The bilinear densities at (a, b) in [0, 1]^2.
#[inline(always)]
pub(super) fn density(table: &Table, places: &Places, a: &F, b: &F) -> F {
    let (nb, n) = (table.shape.n_b, table.shape.slice());
    let (last_a, last_b) = ((table.shape.n_a - 2) as u32, (nb - 2) as u32);
    let (mut x, mut y, mut node): (F, F, Index) = (ZERO, ZERO, [0; LANES]);
    for k in 0..LANES {
        let (u, v) = (a[k] * (last_a + 1) as f32, b[k] * (last_b + 1) as f32);
        let (i, j) = ((u as u32).min(last_a), (v as u32).min(last_b));
        (x[k], y[k]) = (u - i as f32, v - j as f32);
        node[k] = places.slice[k] * n as u32 + i * nb as u32 + j;
    }
    let mut corners = [[0_u32; LANES]; 4];
    for k in 0..LANES {
        let q = &table.nodes()[node[k] as usize..][..n + nb + 2];
        let pair = |at: usize| u32::from(u16::from_le_bytes([q[at], q[at + 1]]));
        corners[0][k] = pair(0);
        corners[1][k] = pair(nb);
        corners[2][k] = pair(n);
        corners[3][k] = pair(n + nb);
    }
    let mut out = ZERO;
    for k in 0..LANES {
        let along = |q: u32| {
            let (left, right) = (decode_low_byte(q), decode_low_byte(q >> 8));
            left + y[k] * (right - left)
        };
        let [f, g] = [places.factor[0][k], places.factor[1][k]];
        let low = f * along(corners[0][k]) + g * along(corners[2][k]);
        let high = f * along(corners[1][k]) + g * along(corners[3][k]);
        out[k] = low + x[k] * (high - low);
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
pub(super) fn invert(table: &Table, places: &Places, u: &F, v: &F) -> Hit {
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
fn row_of(table: &Table, places: &Places, u: &F) -> (Index, F) {
    let na = table.shape.n_a;
    let mut base = [0; LANES];
    for k in 0..LANES {
        base[k] = places.slice[k] * na as u32;
    }
    let (mut at, mut len) = (base, na - 1);
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
        at[k] -= base[k];
        fraction[k] = ((u[k] - low[k]) / (high[k] - low[k])).clamp(0.0, 1.0);
    }
    (at, fraction)
}

/// Blended mass below row `at + offset`; `at` counts the rows of all slices.
#[inline(always)]
fn below(table: &Table, places: &Places, at: &Index, offset: usize) -> F {
    let na = table.shape.n_a;
    let (mut low, mut high, mut out) = (ZERO, ZERO, ZERO);
    for k in 0..LANES {
        let from = &table.below()[at[k] as usize + offset..][..na + 1];
        (low[k], high[k]) = (from[0], from[na]);
    }
    for k in 0..LANES {
        out[k] = low[k] + places.t[k] * (high[k] - low[k]);
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
    fn new(table: &Table, places: &Places, row: &Index) -> Self {
        let (nb, n) = (table.shape.n_b, table.shape.slice());
        let mut rows = Self {
            low: [ZERO; MAX_B],
            high: [ZERO; MAX_B],
            mass: [ZERO; 2],
        };
        for group in 0..nb.div_ceil(WORD) {
            let mut words = [[0_u32; LANES]; 4];
            for k in 0..LANES {
                let node = places.slice[k] as usize * n + row[k] as usize * nb + WORD * group;
                let q = &table.nodes()[node..][..n + nb + WORD];
                let word = |at: usize| u32::from_le_bytes([q[at], q[at + 1], q[at + 2], q[at + 3]]);
                words[0][k] = word(0);
                words[1][k] = word(nb);
                words[2][k] = word(n);
                words[3][k] = word(n + nb);
            }
            for j in WORD * group..(WORD * (group + 1)).min(nb) {
                let shift = 8 * (j % WORD) as u32;
                // the trapezoid rule: half weights at both ends
                let weight = if j == 0 || j + 1 == nb { 0.5 } else { 1.0 };
                for k in 0..LANES {
                    let [f, g] = [places.factor[0][k], places.factor[1][k]];
                    let node = |w: u32| decode_low_byte(w >> shift);
                    let low = f * node(words[0][k]) + g * node(words[2][k]);
                    let high = f * node(words[1][k]) + g * node(words[3][k]);
                    rows.mass[0][k] += weight * low;
                    rows.mass[1][k] += weight * high;
                    rows.low[j][k] = low;
                    rows.high[j][k] = high;
                }
            }
        }
        rows
    }
}
