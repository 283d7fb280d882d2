//! From cells to nodes: padding of missing cells, means on the poles, the wrap of phi_d.

use crate::grid::layout::{Layout, PhiDomain};
use crate::grid::mask::Mask;

/// What is known of a cell before it is sealed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cell {
    /// No value at all: padded from its neighbours.
    Missing,
    /// A value made by somebody's policy; kept, but not a measurement.
    Filled,
    /// A measurement.
    Valid,
}

/// Nodes of a table whose cells are known and whose padding is not yet.
pub(crate) struct Unsealed<'a> {
    pub(crate) layout: Layout,
    pub(crate) channels: usize,
    /// Nodes interleaved by channel; cells already in place.
    pub(crate) nodes: &'a mut [f32],
    /// One entry a cell, file order.
    pub(crate) cells: &'a mut [Cell],
}

impl Unsealed<'_> {
    /// Completes the nodes and returns the validity of each.
    pub(crate) fn seal(mut self) -> Mask {
        let mut mask = Mask::zeros(self.layout.nodes());
        let [n_h, n_d, n_p] = self.layout.dims;
        for h in 0..n_h {
            for d in 0..n_d {
                for p in 0..n_p {
                    let valid = self.cells[self.layout.cell([h, d, p])] == Cell::Valid;
                    mask.assign(self.layout.node([h, d, p]), valid);
                }
            }
        }
        self.pad_missing();
        self.average_poles(&mut mask);
        self.wrap_azimuth(&mut mask);
        mask
    }

    fn copy(&mut self, from: usize, to: usize) {
        let c = self.channels;
        self.nodes.copy_within(from * c..from * c + c, to * c);
    }

    /// Gives every missing cell the value of the nearest cell at smaller theta_d; where there is none, at
    /// smaller theta_h; in the first rows, where both are missing, at larger angles. Zero if no cell has a value.
    fn pad_missing(&mut self) {
        self.sweep(1, true);
        self.sweep(0, true);
        self.sweep(1, false);
        self.sweep(0, false);
        let c = self.channels;
        for k in 0..self.layout.cells() {
            if self.cells[k] == Cell::Missing {
                let node = self.layout.node(self.layout.unravel(k));
                self.nodes[node * c..(node + 1) * c].fill(0.0);
            }
        }
    }

    /// Copies along one axis, from each cell to its missing neighbour at larger (or smaller) angles.
    fn sweep(&mut self, axis: usize, upward: bool) {
        let count = self.layout.cells();
        for k in 0..count {
            let target = if upward { k } else { count - 1 - k };
            if self.cells[target] != Cell::Missing {
                continue;
            }
            let to = self.layout.unravel(target);
            let mut from = to;
            let inside = if upward {
                from[axis] = from[axis].wrapping_sub(1);
                to[axis] > 0
            } else {
                from[axis] += 1;
                from[axis] < self.layout.dims[axis]
            };
            if inside && self.cells[self.layout.cell(from)] != Cell::Missing {
                self.copy(self.layout.node(from), self.layout.node(to));
                self.cells[target] = Cell::Filled;
            }
        }
    }

    /// theta_d = 0: all phi_d are one direction pair. theta_h = 0: phi_d has no origin, and an isotropic
    /// material can't depend on it. Both poles hold the mean over phi_d, of the valid cells if there are any.
    fn average_poles(&mut self, mask: &mut Mask) {
        let [n_h, n_d, _] = self.layout.dims;
        let (slab, row) = (self.layout.slab(), self.layout.row());
        for h in 0..n_h {
            self.average_row((h + 1) * slab + row, (h + 1) * slab, mask);
        }
        for d in 0..n_d {
            self.average_row(slab + (d + 1) * row, (d + 1) * row, mask);
        }
        self.average_row(slab + row, 0, mask);
    }

    /// Fills the row of nodes starting at `to` with the mean of the cells of the row starting at `from`.
    fn average_row(&mut self, from: usize, to: usize, mask: &mut Mask) {
        let c = self.channels;
        let inner = from + 1..from + 1 + self.layout.dims[2];
        let any_valid = inner.clone().any(|k| mask.get(k));
        for channel in 0..c {
            let (mut sum, mut count) = (0.0, 0_u32);
            for k in inner.clone().filter(|&k| !any_valid || mask.get(k)) {
                sum += f64::from(self.nodes[k * c + channel]);
                count += 1;
            }
            let mean = (sum / f64::from(count)) as f32;
            for k in to..to + self.layout.row() {
                self.nodes[k * c + channel] = mean;
            }
        }
        for k in to..to + self.layout.row() {
            mask.assign(k, any_valid);
        }
    }

    /// The outermost nodes of each row of azimuths repeat the cell across the wrap, or the mirrored one.
    fn wrap_azimuth(&mut self, mask: &mut Mask) {
        let row = self.layout.row();
        let (before, after) = match self.layout.phi {
            PhiDomain::Reciprocal | PhiDomain::Full => (row - 2, 1),
            PhiDomain::Mirror => (1, row - 2),
        };
        for start in (0..self.layout.nodes()).step_by(row) {
            self.copy(start + before, start);
            self.copy(start + after, start + row - 1);
            mask.assign(start, mask.get(start + before));
            mask.assign(start + row - 1, mask.get(start + after));
        }
    }
}
