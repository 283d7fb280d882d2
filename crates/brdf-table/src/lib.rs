//! Tables of measured reflectance: interpolate, repair, combine.

pub mod grid;
pub mod rgl;

pub use grid::{
    CellPolicy, CellReport, GridError, Gridded, GriddedN, HalfDiffTable, Interpolation, PhiDomain,
    TableBuilder, directional_albedo, mix,
};
pub use rgl::{RglError, RglTable};
