//! Why a measurement could not be made.

use thiserror::Error;

/// What does not fit together.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// The model has other channels than the file is to have.
    #[error("the file is to have {expected} channels, the reflectance has {found}")]
    Channels {
        /// Channels of the file.
        expected: usize,
        /// Channels of the reflectance.
        found: usize,
    },
    /// Primaries that do not span a colour space, or columns the format has not.
    #[error("{0} can't be columns of an ASTM file")]
    Columns(String),
    /// An impossible instrument.
    #[error("instrument: {name} is {value}, expected {expected}")]
    Instrument {
        /// Which setting.
        name: &'static str,
        /// As given.
        value: f64,
        /// What would do.
        expected: &'static str,
    },
    /// The grid or the values do not fit the format.
    #[error(transparent)]
    Format(#[from] brdf_formats::Error),
}
