//! Regular tables over Rusinkiewicz' half and difference angles: the MERL layout, generalised.
//!
//! [`HalfDiffTable`] holds the cells, judged by a named [`CellPolicy`]; [`Gridded`] and [`GriddedN`] interpolate them, [`BinnedGrid`] and [`HeroGrid`] those of
//! many bands; [`mix`] adds tables.
//! Layout, cell placement and the averaging at the poles: `docs/tables.md`.

mod albedo;
mod band_grid;
mod binned;
mod cells;
mod combine;
mod error;
pub(crate) mod fast_math;
mod gridded;
mod hero;
mod lanes;
mod layout;
mod lookup;
mod mask;
mod merl;
mod node_rows;
mod seal;
mod table;

pub use albedo::directional_albedo;
pub use binned::BinnedGrid;
pub use cells::{CellPolicy, CellReport};
pub use combine::mix;
pub use error::GridError;
pub use gridded::{Gridded, GriddedN};
pub use hero::HeroGrid;
pub use layout::PhiDomain;
pub use lookup::Interpolation;
pub use merl::MerlLoss;
pub use table::HalfDiffTable;
