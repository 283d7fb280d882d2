//! Regular tables over Rusinkiewicz' half and difference angles: the MERL layout, generalised.
//!
//! [`HalfDiffTable`] holds the cells, [`Gridded`] and [`GriddedN`] interpolate them.
//! Layout, cell placement and the averaging at the poles: `docs/tables.md`.

mod error;
mod gridded;
mod layout;
mod lookup;
mod mask;
mod seal;
mod table;

pub use error::GridError;
pub use gridded::{Gridded, GriddedN};
pub use layout::PhiDomain;
pub use lookup::Interpolation;
pub use table::HalfDiffTable;
