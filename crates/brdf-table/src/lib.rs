//! Tables of measured reflectance: interpolate, repair, combine.

pub mod grid;
pub mod rgl;
pub mod scattered;

pub use grid::{
    BinnedGrid, CellPolicy, CellReport, GridError, Gridded, GriddedN, HalfDiffTable, HeroGrid,
    Interpolation, MerlLoss, PhiDomain, directional_albedo, mix,
};
pub use rgl::{RglN, RglTable};
pub use scattered::{
    BeyondPolicy, CloudError, DeadRows, GapPolicy, KdNearest, LayerMode, LayeredTable,
    NegativePolicy, Policies, Resampled, SampleCloud, ThinPlate, resample,
};
