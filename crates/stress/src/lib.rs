//! Numerics at the extremes: every model, table, sampler, light and shape where digits are lost, each against a higher
//! precision, and the bound its error has to keep.
//!
//! [`cases`] lists them; [`run`] makes a table of [`Row`]s, which `gonio stress` prints and the tests of this crate demand
//! to be without a red line. References are f64 for what runs in f32 lanes, and 160 bits for what runs in f64.
//! Registries are iterated: a new model is stressed by being registered.
//!
//! [`timings`] measures what denormal numbers cost. Not here: statistics (the conformance tests of each crate) and any other
//! time (benches).

mod case;
mod cases;
mod grid;
mod real;
mod reference;
mod scenes;
mod tally;
mod timing;

pub use case::{Case, Effort, Row, run};
pub use cases::cases;
pub use tally::Tally;
pub use timing::{Timing, timings};
