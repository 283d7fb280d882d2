//! How many slices and nodes a half-vector table has, and how its node values are indexed.

use super::slices;
use glam::DVec3;

/// Floats around it are whole.
const LARGE: f32 = 1.5 * (1_u32 << 23) as f32;

/// Node counts of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    /// Slices of the viewer's elevation.
    pub(crate) n_theta: usize,
    /// Slices of its azimuth; 1 for isotropic targets.
    pub(crate) n_phi: usize,
    /// Whether the slices of azimuth go around half a turn, and the other half repeats them.
    pub(crate) half_turn: bool,
    /// Nodes along the radial coordinate a.
    pub(crate) n_a: usize,
    /// Nodes along the azimuth b, a multiple of 8.
    pub(crate) n_b: usize,
}

/// Slices around a viewer, `S` of them: 2, or 4 where azimuths count. Weights are >= 0 and add to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blend<const S: usize> {
    pub(crate) slice: [usize; S],
    pub(crate) weight: [f32; S],
}

impl Shape {
    /// Slices of all viewers.
    pub(crate) fn slices(self) -> usize {
        self.n_theta * self.n_phi
    }

    /// Nodes of one slice.
    pub(crate) fn slice(self) -> usize {
        self.n_a * self.n_b
    }

    /// Nodes of all slices.
    pub(crate) fn nodes(self) -> usize {
        self.slices() * self.slice()
    }

    /// Cells of one slice.
    pub(crate) fn cells(self) -> usize {
        (self.n_a - 1) * (self.n_b - 1)
    }

    /// Integral over the unit square of the hat function of node `(i, j)`.
    pub(crate) fn hat_mass(self, i: usize, j: usize) -> f64 {
        let end = |k: usize, n: usize| if k == 0 || k + 1 == n { 0.5 } else { 1.0 };
        end(i, self.n_a) * end(j, self.n_b) / self.cells() as f64
    }

    /// Integral of the bilinear function with the given node values of one slice.
    pub(crate) fn mass(self, values: &[f64]) -> f64 {
        let rows = values.chunks_exact(self.n_b);
        let row = |row: &[f64]| row.iter().sum::<f64>() - 0.5 * (row[0] + row[self.n_b - 1]);
        let sum: f64 = rows.clone().map(row).sum();
        let [first, last] = [rows.clone().next(), rows.last()].map(|r| r.map_or(0.0, row));
        (sum - 0.5 * (first + last)) / self.cells() as f64
    }

    /// The slices around the viewer `wo` of the given sine. `S` is 2 or 4: without the
    /// azimuth, or with it.
    #[inline(always)]
    pub(crate) fn blend<const S: usize>(self, sin_o: f64, wo: DVec3) -> Blend<S> {
        // whole numbers of 32 bits: others take a branch on the way to f32
        let last = self.n_theta as u32 - 1;
        let x = slices::tau(sin_o as f32, wo.z as f32) * last as f32;
        // rounded near a large number, whose low bits are 0; between two slices either neighbour will do at its own place
        let shifted = (x - 0.5) + LARGE;
        let k = (shifted.to_bits() - LARGE.to_bits()).min(last - 1) as usize;
        let t = x - k as u32 as f32;
        let mut blend = Blend {
            slice: [k; S],
            weight: [0.0; S],
        };
        if S == 2 {
            blend.slice[1] = k + 1;
            (blend.weight[0], blend.weight[1]) = (1.0 - t, t);
            return blend;
        }
        let [j0, j1, v] = self.around(wo.x as f32, wo.y as f32);
        let corners = [(j0, 0, 1.0 - v), (j0, 1, 1.0 - v), (j1, 0, v), (j1, 1, v)];
        for ((slice, weight), (j, up, w)) in
            blend.slice.iter_mut().zip(&mut blend.weight).zip(corners)
        {
            *slice = j as usize * self.n_theta + k + up;
            *weight = w * if up == 1 { t } else { 1.0 - t };
        }
        blend
    }

    /// The slices of azimuth on either side of the direction (x, y), and the weight of the second; numbers of slices
    /// are whole. A direction without azimuth has azimuth 0.
    #[inline(always)]
    pub(crate) fn around(self, x: f32, y: f32) -> [f32; 3] {
        let turns = slices::pseudo_turns(x, y);
        let n = self.n_phi as f32;
        let at = if self.half_turn { 2.0 * turns } else { turns } * n;
        let floor = (at as u32) as f32;
        let v = at - floor;
        // `at` is below 2 n, up to rounding
        let wrap = |j: f32| {
            let j = if j >= n { j - n } else { j };
            if j >= n { j - n } else { j }
        };
        [wrap(floor), wrap(floor + 1.0), v]
    }

    /// Azimuth of slices number `j`, possibly between two, radians.
    pub(crate) fn azimuth(self, j: f64) -> f64 {
        let turns = j / self.n_phi as f64 * if self.half_turn { 0.5 } else { 1.0 };
        // the inverse of pseudo_turns by bisection within its quarter
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let mid = 0.5 * (low + high);
            let (s, c) = (std::f64::consts::TAU * mid).sin_cos();
            if f64::from(slices::pseudo_turns(c as f32, s as f32)) < turns {
                low = mid;
            } else {
                high = mid;
            }
        }
        std::f64::consts::TAU * low
    }
}
