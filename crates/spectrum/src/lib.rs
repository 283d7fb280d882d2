//! Wavelengths, sampled spectra, colour spaces and the CIE tables.
//!
//! Goals: one meaning for every list of channels ([`Basis`]), linear conversions between them.
//! Not here: files, BRDFs, tone mapping.

mod basis;
mod rgb_space;
mod samples;

pub use basis::Basis;
pub use rgb_space::{D65_XY, RgbSpace};
pub use samples::{Rgb, Samples};
