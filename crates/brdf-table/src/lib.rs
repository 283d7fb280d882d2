//! Tables of measured reflectance: interpolate, repair, combine.

pub mod grid;

pub use grid::{GridError, Gridded, GriddedN, HalfDiffTable, Interpolation, PhiDomain};
