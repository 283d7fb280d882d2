//! Reflectance measured at scattered directions, such as Cornell's: a cloud of samples, the ways to
//! interpolate it, and its resampling onto a grid.
//!
//! - [`SampleCloud`]: the rows, checked, folded by bilateral symmetry.
//! - [`ThinPlate`]: the default interpolant. [`LayeredTable`], [`KdNearest`]: the thesis' two.
//! - [`resample`]: onto a [`HalfDiffTable`](crate::HalfDiffTable), with its own error measured.
//! - [`validation`]: which interpolant predicts rows it has not seen.
//!
//! Measured comparison: docs/interpolation.md.

mod chart;
mod cloud;
mod domain;
mod error;
mod factor;
mod kd_nearest;
mod layered;
mod log_ratio;
mod outliers;
mod policy;
mod polyharmonic;
mod reciprocity;
mod resample;
mod rise;
mod thin_plate;
pub mod validation;

pub use cloud::{Geometry, SampleCloud};
pub use domain::Domain;
pub use error::CloudError;
pub use kd_nearest::KdNearest;
pub use layered::{LayerMode, LayeredTable};
pub use policy::{BeyondPolicy, DeadRows, GapPolicy, NegativePolicy, Policies};
pub use reciprocity::{Reciprocity, non_reciprocity};
pub use resample::{DEFAULT_DIMS, Resampled, resample};
pub use thin_plate::{FillReport, ThinPlate};
