//! A virtual gonioreflectometer: samples any reflectance onto the grids real instruments use, with their
//! flaws if asked for, so that everything downstream has fixtures with known truth.
//!
//! - [`measure_merl`]: the half/difference grid of the MERL database, written in its layout.
//! - [`measure_astm`]: the scattered directions of Cornell's gonioreflectometer.
//! - [`Instrument`]: noise, exposure bracketing with a coarse converter, a blind spot. The default is
//!   perfect.
//!
//! The same reflectance, grid, instrument and seed give the same bits, whatever the number of threads.

mod astm;
mod bracketing;
mod columns;
mod error;
mod instrument;
mod merl;

pub use astm::{cornell_directions, measure_astm};
pub use bracketing::Bracketing;
pub use error::MeasureError;
pub use instrument::Instrument;
pub use merl::{MERL_DIMS, measure_merl};
