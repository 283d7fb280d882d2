//! What can go wrong in a fit.

use thiserror::Error;

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FitError {
    /// Fewer measurements than unknowns.
    #[error("expected at least {expected} measurements above the horizon, found {found}")]
    TooFew {
        /// Usable measurements.
        found: usize,
        /// Unknowns of the model.
        expected: usize,
    },
    /// Data without light.
    #[error("expected positive reflectance, found none")]
    AllZero,
    /// No such family of models.
    #[error("no model `{name}` to fit; those that can be fitted are {known}")]
    UnknownModel {
        /// As typed.
        name: String,
        /// Names, comma separated.
        known: String,
    },
    /// More or fewer lobes than a family has.
    #[error("model `{model}`: expected {expected}, found {found}")]
    Lobes {
        /// The model.
        model: String,
        /// What would do.
        expected: String,
        /// What was asked.
        found: usize,
    },
    /// No start led anywhere.
    #[error("model `{model}`: the error is not finite from any start")]
    NoStart {
        /// The model.
        model: String,
    },
    /// Exports need linear sRGB.
    #[error("expected 3 channels, found {0}")]
    Channels(usize),
    /// A part of a fit that is no model.
    #[error("{0}")]
    Text(String),
}
