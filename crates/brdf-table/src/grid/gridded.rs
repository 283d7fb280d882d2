//! A table together with the way it is read: what renderers and checks see.

use crate::grid::error::GridError;
use crate::grid::lanes::LaneLayout;
use crate::grid::lookup::Interpolation;
use crate::grid::table::HalfDiffTable;
use brdf::{Brdf, LANES, Lanes3, Measured, Status, Symmetry};
use glam::DVec3;
use spectrum::Basis;
use std::sync::Arc;

/// A table of any number of channels, interpolated.
#[derive(Clone, Debug)]
pub struct Gridded {
    /// The cells.
    pub table: Arc<HalfDiffTable>,
    /// How they are read.
    pub interpolation: Interpolation,
}

impl Measured for Gridded {
    fn basis(&self) -> &Basis {
        self.table.basis()
    }

    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        assert_eq!(out.len(), self.table.channels(), "one output a channel");
        self.table.eval(wi, wo, self.interpolation, out)
    }

    fn symmetry(&self) -> Symmetry {
        self.table.symmetry()
    }

    fn table_bytes(&self) -> usize {
        self.table.bytes()
    }
}

/// A table of exactly `N` channels, interpolated: the same values, and fast for packets of directions.
#[derive(Clone, Debug)]
pub struct GriddedN<const N: usize> {
    table: Arc<HalfDiffTable>,
    interpolation: Interpolation,
    lanes: LaneLayout,
}

impl<const N: usize> GriddedN<N> {
    /// # Errors
    /// [`GridError::Channels`] if the table does not have `N` channels.
    pub fn new(table: Arc<HalfDiffTable>, interpolation: Interpolation) -> Result<Self, GridError> {
        if table.channels() == N {
            Ok(Self {
                lanes: LaneLayout::new(table.layout()),
                table,
                interpolation,
            })
        } else {
            Err(GridError::Channels {
                expected: N,
                found: table.channels(),
            })
        }
    }

    /// The cells.
    #[must_use]
    pub fn table(&self) -> &Arc<HalfDiffTable> {
        &self.table
    }

    /// How they are read.
    #[must_use]
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }
}

impl<const N: usize> Brdf<N> for GriddedN<N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let mut out = [0.0; N];
        self.table.eval(wi, wo, self.interpolation, &mut out);
        out
    }

    fn symmetry(&self) -> Symmetry {
        self.table.symmetry()
    }

    fn table_bytes(&self) -> usize {
        self.table.bytes()
    }

    #[inline(always)]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        self.lanes
            .eval(self.table.nodes(), self.interpolation, wi, wo)
    }
}
