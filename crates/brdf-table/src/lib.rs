//! Tables of measured reflectance: interpolate, repair, combine.

pub mod grid;
pub mod scattered;

pub use grid::{
    CellPolicy, CellReport, GridError, Gridded, GriddedN, HalfDiffTable, Interpolation, PhiDomain,
    TableBuilder, directional_albedo, mix,
};
pub use scattered::{
    BeyondPolicy, CloudError, DeadRows, GapPolicy, KdNearest, LayerMode, LayeredTable,
    NegativePolicy, Policies, Resampled, SampleCloud, ThinPlate, resample,
};
