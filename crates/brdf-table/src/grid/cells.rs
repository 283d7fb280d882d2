//! What the values of a cell mean.

use crate::grid::seal::Cell;

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

impl CellReport {
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            cells: self.cells + other.cells,
            measured: self.measured + other.measured,
            all_negative: self.all_negative + other.all_negative,
            partly_negative: self.partly_negative + other.partly_negative,
            not_finite: self.not_finite + other.not_finite,
            clamped_channels: self.clamped_channels + other.clamped_channels,
        }
    }

    /// Counts a cell of these values, f_r, and says what it is under `policy`; what the policy reads as 0 becomes 0.
    pub(crate) fn judge<const N: usize>(
        &mut self,
        values: &mut [f32; N],
        policy: CellPolicy,
    ) -> Cell {
        self.cells += 1;
        let mut negatives = 0;
        for v in values.iter() {
            if !v.is_finite() {
                self.not_finite += 1;
                return Cell::Missing;
            }
            negatives += usize::from(*v < 0.0);
        }
        if negatives > 0 {
            let all = negatives == N;
            self.all_negative += usize::from(all);
            self.partly_negative += usize::from(!all);
            if all || policy == CellPolicy::AnyNegative {
                return Cell::Missing;
            }
            if policy == CellPolicy::PerChannel {
                self.clamped_channels += negatives;
                for v in values {
                    *v = if *v < 0.0 { 0.0 } else { *v };
                }
            }
        }
        self.measured += 1;
        Cell::Valid
    }
}
