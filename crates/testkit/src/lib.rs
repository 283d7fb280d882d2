//! For tests only: statistical tests of samplers, quadrature, tolerances and where the data lies.
//!
//! Goals: one chi-square test that a wrong sampler can't pass ([`chi2::test`]), tests of means
//! ([`z_test`], [`t_test`]), quadrature to check densities and energy against ([`integrate`]).
//! Everything is told by closures on plain arrays; all seeds are fixed, so a test that passes once
//! passes always.
//! The statistics the product uses too stand in crate `sampling`; what is here drives them with random numbers that
//! depend on nothing they test.
//! Not here: reflectance, samplers, files.

pub mod chi2;
mod close;
mod data;
mod mean;
mod rng;

pub use close::{assert_close, assert_relative, relative_error};
pub use data::{data_dir, data_dir_or_skip, read_data};
pub use mean::{MeanTest, t_test, within_standard_errors, z_test};
pub use rng::Rng;
pub use sampling::{Domain, domain, integrate, sidak, significant, special};
