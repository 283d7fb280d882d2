//! Fits analytic models to any reflectance.
//!
//! A [`Family`] splits a model into the shape of its lobes and their weights. For every shape the best weights follow
//! from non-negative least squares, so that only the few parameters of the shape are searched for, by
//! Levenberg-Marquardt from many starts: variable projection. [`fit`] returns the error in one of four metrics
//! ([`Metric`]) and every parameter with its 95 % confidence interval; [`Fit::parts`] is the model as text.
//!
//! Files, tables and pictures are unknown here.

mod confidence;
mod error;
pub mod export;
mod families;
mod family;
mod fit;
mod levenberg;
mod metric;
mod nnls;
mod problem;
mod samples;

pub use error::FitError;
pub use families::{families, family};
pub use family::{Family, Lobes, Part, Scale, ShapeParameter, Weight};
pub use fit::{Estimate, Fit, FitData, error_of, fit, fit_all};
pub use metric::{Metric, Sums};
pub use nnls::nnls;
pub use samples::{Pair, Samples};
