//! Wavelengths, sampled spectra, colour spaces and the CIE tables.
//!
//! Goals: one meaning for every list of channels ([`Basis`]), linear conversions between them, every
//! number with its source.
//! Not here: files, BRDFs, tone mapping.
//!
//! - [`Samples`]: what rendering carries. [`Basis`]: what channels mean, and how one list becomes another.
//! - [`Spectrum`], [`Bins`]: functions of the wavelength, and their means over fixed intervals.
//! - [`Observer`], [`Illuminant`], [`Viewing`]: from spectra to XYZ.
//! - [`RgbSpace`], [`bradford`]: from XYZ to RGB and between whites.
//! - [`LinearUplift`]: from RGB to spectra.
//! - [`lab_from_xyz`], [`ciede2000`]: how different two colours look.

mod adaptation;
mod basis;
mod bins;
mod ciede2000;
mod generated;
mod illuminant;
mod lab;
mod linear_uplift;
pub mod matrix;
mod observer;
mod rgb_space;
mod samples;
mod spectral;
mod transfer;
mod tristimulus;

pub use adaptation::bradford;
pub use basis::{Basis, table_srgb_from_xyz};
pub use bins::{Bins, BinsError};
pub use ciede2000::ciede2000;
pub use illuminant::{Illuminant, IlluminantError, planck};
pub use lab::{lab_from_xyz, xyz_from_lab};
pub use linear_uplift::LinearUplift;
pub use matrix::Matrix3;
pub use observer::Observer;
pub use rgb_space::{
    D65_XY, LINEAR_SRGB_FROM_XYZ, LUMINANCE_SRGB, RgbSpace, XYZ_FROM_LINEAR_SRGB,
    linear_srgb_from_xyz, xyz_of_xy,
};
pub use samples::{Rgb, Samples};
pub use spectral::{Outside, Spectrum, SpectrumError};
pub use transfer::{srgb_decode, srgb_encode};
pub use tristimulus::{Viewing, white_xyz};
