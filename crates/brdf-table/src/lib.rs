//! Tables of measured reflectance: interpolate, repair, combine.

pub mod grid;
pub mod rgl;

pub use grid::{
    CellPolicy, CellReport, GridError, Gridded, GriddedN, HalfDiffTable, Interpolation, MerlLoss,
    PhiDomain, TableBuilder, directional_albedo, mix,
};
pub use rgl::{RglN, RglTable};
