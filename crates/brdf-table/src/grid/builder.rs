//! Tables from values that arrive channel after channel, as MERL files hold them; one copy, no planes kept.

use crate::grid::error::GridError;
use crate::grid::layout::{Layout, PhiDomain};
use crate::grid::mask::Mask;
use crate::grid::seal::Cell;
use crate::grid::table::HalfDiffTable;
use spectrum::Basis;

/// What a negative channel means. NaN and infinite channels always make their cell "not measured".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum CellPolicy {
    /// One negative channel makes the whole cell "not measured" (`dj_brdf`, ALTA).
    #[default]
    AnyNegative,
    /// A negative channel reads 0, the others stay (pbrt, libbsdf); not measured if all are negative.
    PerChannel,
    /// Negative channels are kept as they are; not measured if all are negative.
    AllNegative,
}

/// What a policy found and did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct CellReport {
    /// Cells of the table.
    pub cells: usize,
    /// Cells taken as measured.
    pub measured: usize,
    /// Cells in which every channel is negative: the file's own "not measured".
    pub all_negative: usize,
    /// Cells in which some channels are negative and some are not.
    pub partly_negative: usize,
    /// Cells with a NaN or infinite channel.
    pub not_finite: usize,
    /// Channels of measured cells that were set to 0.
    pub clamped_channels: usize,
}

/// Takes values in file order - all cells of the first channel, then the second - and makes a table.
#[derive(Debug)]
pub struct TableBuilder {
    layout: Layout,
    basis: Basis,
    /// Multiplies every value of a channel.
    scales: Vec<f64>,
    nodes: Vec<f32>,
    pushed: usize,
    next: [usize; 3],
    any_negative: Mask,
    any_other: Mask,
    not_finite: Mask,
}

impl TableBuilder {
    /// An empty table; value v of channel c becomes `scales[c] * v`, f_r in 1/sr.
    ///
    /// # Errors
    /// [`GridError::Dimensions`] for sizes of 0 or beyond memory; [`GridError::Channels`] if there is not
    /// one scale a channel.
    pub fn new(
        dims: [usize; 3],
        phi: PhiDomain,
        basis: Basis,
        scales: Vec<f64>,
    ) -> Result<Self, GridError> {
        let channels = basis.len();
        if scales.len() != channels {
            return Err(GridError::Channels {
                expected: channels,
                found: scales.len(),
            });
        }
        let layout = Layout::checked(dims, phi, channels).ok_or(GridError::Dimensions(dims))?;
        Ok(Self {
            layout,
            basis,
            scales,
            nodes: vec![0.0; layout.nodes() * channels],
            pushed: 0,
            next: [0; 3],
            any_negative: Mask::zeros(layout.cells()),
            any_other: Mask::zeros(layout.cells()),
            not_finite: Mask::zeros(layout.cells()),
        })
    }

    /// The next values in file order, any number of them.
    ///
    /// # Errors
    /// [`GridError::ValueCount`] if there are more than the table holds.
    pub fn push(&mut self, values: &[f64]) -> Result<(), GridError> {
        let expected = self.layout.cells() * self.basis.len();
        if values.len() > expected - self.pushed {
            return Err(GridError::ValueCount {
                expected,
                found: self.pushed + values.len(),
            });
        }
        let mut rest = values;
        while !rest.is_empty() {
            let run = (self.layout.dims[2] - self.next[2]).min(rest.len());
            let (now, later) = rest.split_at(run);
            self.push_run(now);
            rest = later;
        }
        Ok(())
    }

    /// Values of one channel, within one row of phi_d.
    fn push_run(&mut self, values: &[f64]) {
        let channels = self.basis.len();
        let channel = self.pushed / self.layout.cells();
        let scale = self.scales[channel];
        let cell = self.layout.cell(self.next);
        let node = self.layout.node(self.next);
        let slots = self.nodes[node * channels + channel..]
            .iter_mut()
            .step_by(channels);
        for ((k, v), slot) in values.iter().enumerate().zip(slots) {
            let scaled = (v * scale) as f32;
            if !scaled.is_finite() {
                self.not_finite.set(cell + k);
            } else if scaled < 0.0 {
                self.any_negative.set(cell + k);
            } else {
                self.any_other.set(cell + k);
            }
            *slot = scaled;
        }
        self.pushed += values.len();
        self.advance(values.len());
    }

    fn advance(&mut self, by: usize) {
        let [n_h, n_d, n_p] = self.layout.dims;
        self.next[2] += by;
        if self.next[2] == n_p {
            self.next = [self.next[0], self.next[1] + 1, 0];
        }
        if self.next[1] == n_d {
            self.next = [(self.next[0] + 1) % n_h, 0, 0];
        }
    }

    /// Applies the policy, pads what is not measured, and averages the poles.
    ///
    /// # Errors
    /// [`GridError::ValueCount`] if values are missing.
    pub fn finish(mut self, policy: CellPolicy) -> Result<(HalfDiffTable, CellReport), GridError> {
        let expected = self.layout.cells() * self.basis.len();
        if self.pushed != expected {
            return Err(GridError::ValueCount {
                expected,
                found: self.pushed,
            });
        }
        let mut report = CellReport {
            cells: self.layout.cells(),
            ..CellReport::default()
        };
        let mut cells: Vec<Cell> = Vec::with_capacity(self.layout.cells());
        for k in 0..self.layout.cells() {
            cells.push(self.judge(k, policy, &mut report));
        }
        let table = HalfDiffTable::seal(self.layout, self.basis, self.nodes, &mut cells);
        Ok((table, report))
    }

    fn judge(&mut self, k: usize, policy: CellPolicy, report: &mut CellReport) -> Cell {
        if self.not_finite.get(k) {
            report.not_finite += 1;
            return Cell::Missing;
        }
        let (negative, other) = (self.any_negative.get(k), self.any_other.get(k));
        report.all_negative += usize::from(negative && !other);
        report.partly_negative += usize::from(negative && other);
        if negative && (policy == CellPolicy::AnyNegative || !other) {
            return Cell::Missing;
        }
        report.measured += 1;
        if negative && policy == CellPolicy::PerChannel {
            let channels = self.basis.len();
            let node = self.layout.node(self.layout.unravel(k)) * channels;
            for v in &mut self.nodes[node..node + channels] {
                if *v < 0.0 {
                    *v = 0.0;
                    report.clamped_channels += 1;
                }
            }
        }
        Cell::Valid
    }
}
