//! Random and low-discrepancy points, warps with density and inverse, discrete and tabulated
//! distributions, estimators.
//!
//! Goals: every map from the unit square that ships here comes with its exact density and its inverse; all
//! points are functions of (seed, pixel, index, dimension), so results don't depend on the order of work.
//! Not here: reflectance, lights, images.
//!
//! - [`Rng`] for sequential random numbers; [`Points`] for stateless samples in a renderer.
//! - [`warp`]: closed-form maps. [`Piecewise1`], [`Piecewise2`]: inversion of tables.
//!   [`AliasTable`], [`Rejection`], [`Mixture`]: the other ways to sample.
//! - [`mis`]: weights that combine samplers. [`Welford`], [`Replicates`]: means with their errors.
//!   [`Line`], [`jackknife`]: fits and the errors of derived numbers.
//! - [`chi2`]: whether a sampler agrees with the density it claims; with the quadrature ([`integrate`]), the special
//!   functions ([`special`]) and the levels ([`sidak`]) it rests on.

mod alias;
pub mod chi2;
mod density_error;
pub mod domain;
pub mod integrate;
mod line;
pub mod mis;
mod mixture;
mod piecewise1;
mod piecewise2;
pub mod points;
mod rejection;
mod replicates;
mod rng;
mod significance;
pub mod special;
mod student;
pub mod warp;
mod welford;

pub use alias::AliasTable;
pub use density_error::DensityError;
pub use domain::Domain;
pub use line::{Line, jackknife};
pub use mixture::Mixture;
pub use piecewise1::Piecewise1;
pub use piecewise2::Piecewise2;
pub use points::{PointSet, Points};
pub use rejection::Rejection;
pub use replicates::Replicates;
pub use rng::Rng;
pub use significance::{sidak, significant};
pub use student::student_quantile;
pub use welford::Welford;

/// The largest f64 below 1: where a rounded-up sample is put back into [0, 1).
pub const ONE_MINUS_EPSILON: f64 = 1.0 - f64::EPSILON / 2.0;
