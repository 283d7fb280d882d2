//! RGL's adaptively parametrised measurements [Dupuy2018]: evaluation, density and the file's own sampling.

mod image;
mod lane_warp;
mod lanes;
mod slices;
mod table;
mod warp;

pub use table::{RglN, RglTable};
