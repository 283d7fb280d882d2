//! Tables of many bands, packed for rendering.

use crate::grid::error::GridError;
use crate::grid::lanes::LaneLayout;
use crate::grid::lookup::Interpolation;
use crate::grid::node_rows::PackedRows;
use crate::grid::table::HalfDiffTable;
use brdf::{LANES, Lanes3, Symmetry};

/// A table of up to `32 L - 1` channels in `L` cache lines a node: 16 bits a channel with an exponent a node, off by at
/// most 2^-15 of the largest channel there.
///
/// A row of all channels is interpolated in direction, where its values are neighbours in memory.
#[derive(Clone, Debug)]
pub(super) struct BandGrid<const L: usize> {
    rows: PackedRows<L>,
    lanes: LaneLayout,
    interpolation: Interpolation,
    pub(super) symmetry: Symmetry,
}

impl<const L: usize> BandGrid<L> {
    /// # Errors
    /// [`GridError::Channels`] if the channels don't fit.
    pub(super) fn new(
        table: &HalfDiffTable,
        interpolation: Interpolation,
    ) -> Result<Self, GridError> {
        let found = table.channels();
        let rows = PackedRows::new(table.nodes(), found).ok_or(GridError::Channels {
            expected: PackedRows::<L>::CHANNELS,
            found,
        })?;
        Ok(Self {
            rows,
            lanes: LaneLayout::new(table.layout()),
            interpolation,
            symmetry: table.symmetry(),
        })
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.rows.bytes()
    }

    /// The interpolated row of each lane; its last entry means nothing, and nothing does where a direction is not above the horizon.
    #[inline(always)]
    pub(super) fn rows(&self, wi: &Lanes3, wo: &Lanes3) -> [[[f32; 32]; L]; LANES] {
        self.lanes.rows(&self.rows, self.interpolation, wi, wo)
    }
}
