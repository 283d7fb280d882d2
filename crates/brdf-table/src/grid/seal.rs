//! From cells to nodes: padding of missing cells, means on the poles, the wrap of phi_d.

use crate::grid::layout::{Layout, PhiDomain};
use crate::grid::mask::Mask;
use rayon::prelude::*;

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
    /// Completes the nodes and returns the validity of each; one theta_h after the other where they need each other, else
    /// in parallel.
    pub(crate) fn seal(mut self) -> Mask {
        if self.pad_along_theta_d() {
            self.pad_the_rest();
        }
        let mut mask = self.complete_slabs();
        self.complete_pole(&mut mask);
        mask
    }

    /// All nodes but those of the pole of theta_h, and all cells, by theta_h.
    fn slabs(&mut self) -> impl IndexedParallelIterator<Item = (&mut [f32], &mut [Cell])> {
        let nodes = self.layout.slab() * self.channels;
        let cells = self.layout.dims[1] * self.layout.dims[2];
        let slabs = self.nodes.par_chunks_mut(nodes.max(1)).skip(1);
        slabs.zip(self.cells.par_chunks_mut(cells))
    }

    /// Gives every missing cell the value of the nearest cell at smaller theta_d; whether any is still missing.
    fn pad_along_theta_d(&mut self) -> bool {
        let (layout, c) = (self.layout, self.channels);
        let [_, n_d, n_p] = layout.dims;
        self.slabs()
            .map(|(nodes, cells)| {
                for k in n_p..n_d * n_p {
                    if cells[k] == Cell::Missing && cells[k - n_p] != Cell::Missing {
                        let to = layout.node(layout.unravel(k)) - layout.slab();
                        let from = to - layout.row();
                        nodes.copy_within(from * c..(from + 1) * c, to * c);
                        cells[k] = Cell::Filled;
                    }
                }
                cells.contains(&Cell::Missing)
            })
            .reduce(|| false, |a, b| a | b)
    }

    /// Where there is no cell at smaller theta_d: from smaller theta_h; in the first rows, where both are missing, from
    /// larger angles. Zero if no cell has a value.
    fn pad_the_rest(&mut self) {
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
        let (count, c) = (self.layout.cells(), self.channels);
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
                let (from, to) = (self.layout.node(from), self.layout.node(to));
                self.nodes.copy_within(from * c..(from + 1) * c, to * c);
                self.cells[target] = Cell::Filled;
            }
        }
    }

    /// Validity, pole of theta_d and wrap of phi_d of every theta_h that has cells.
    fn complete_slabs(&mut self) -> Mask {
        let (layout, channels) = (self.layout, self.channels);
        let [_, n_d, n_p] = layout.dims;
        let complete = |(h, (nodes, cells)): (usize, (&mut [f32], &mut [Cell]))| {
            let shift = (h + 1) * layout.slab();
            // bits begin in their word, so that masks are put together word by word
            let mut rows = Rows {
                layout,
                channels,
                nodes,
                mask: Mask::zeros(shift % 64 + layout.slab()),
                shift: shift % 64,
            };
            for d in 0..n_d {
                for p in 0..n_p {
                    let node = layout.node([0, d, p]) - layout.slab();
                    (rows.mask).assign(rows.shift + node, cells[d * n_p + p] == Cell::Valid);
                }
            }
            rows.average(layout.row(), 0);
            rows.wrap(n_d + 1);
            (shift / 64, rows.mask)
        };
        let masks: Vec<_> = self.slabs().enumerate().map(complete).collect();
        let mut mask = Mask::zeros(layout.nodes());
        for (first, part) in &masks {
            mask.add_words(*first, part);
        }
        mask
    }

    /// theta_h = 0: means over phi_d of the first cells.
    fn complete_pole(&mut self, mask: &mut Mask) {
        let (layout, row) = (self.layout, self.layout.row());
        let n_d = layout.dims[1];
        let mut rows = Rows {
            layout,
            channels: self.channels,
            nodes: self.nodes,
            mask: std::mem::take(mask),
            shift: 0,
        };
        for d in 0..n_d {
            rows.average(layout.slab() + (d + 1) * row, (d + 1) * row);
        }
        rows.average(layout.slab() + row, 0);
        rows.wrap(n_d + 1);
        *mask = rows.mask;
    }
}

/// Rows of nodes along phi_d, with their validity.
struct Rows<'a> {
    layout: Layout,
    channels: usize,
    nodes: &'a mut [f32],
    mask: Mask,
    /// The bit of the first node.
    shift: usize,
}

impl Rows<'_> {
    /// Fills the row of nodes starting at `to` with the mean of the cells of the row starting at `from`, of the valid ones
    /// if there are any.
    ///
    /// theta_d = 0: all phi_d are one direction pair. theta_h = 0: phi_d has no origin, and an isotropic material can't
    /// depend on it.
    fn average(&mut self, from: usize, to: usize) {
        let (c, shift) = (self.channels, self.shift);
        let inner = from + 1..from + 1 + self.layout.dims[2];
        let any_valid = inner.clone().any(|k| self.mask.get(shift + k));
        for channel in 0..c {
            let (mut sum, mut count) = (0.0, 0_u32);
            for k in inner.clone() {
                if !any_valid || self.mask.get(shift + k) {
                    sum += f64::from(self.nodes[k * c + channel]);
                    count += 1;
                }
            }
            let mean = (sum / f64::from(count)) as f32;
            for k in to..to + self.layout.row() {
                self.nodes[k * c + channel] = mean;
            }
        }
        for k in to..to + self.layout.row() {
            self.mask.assign(shift + k, any_valid);
        }
    }

    /// The outermost nodes of each of the first `rows` rows repeat the cell across the wrap, or the mirrored one.
    fn wrap(&mut self, rows: usize) {
        let (c, row) = (self.channels, self.layout.row());
        let (before, after) = match self.layout.phi {
            PhiDomain::Reciprocal | PhiDomain::Full => (row - 2, 1),
            PhiDomain::Mirror => (1, row - 2),
        };
        for start in (0..rows * row).step_by(row) {
            for (from, to) in [(start + before, start), (start + after, start + row - 1)] {
                self.nodes.copy_within(from * c..(from + 1) * c, to * c);
                let valid = self.mask.get(self.shift + from);
                self.mask.assign(self.shift + to, valid);
            }
        }
    }
}
