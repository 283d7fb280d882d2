//! What can be wrong with the text of a model.

use thiserror::Error;

/// Why a model text was refused: which part, what was expected, what was found.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// No such model.
    #[error("unknown model `{name}`; known are {known}")]
    UnknownModel {
        /// As typed.
        name: String,
        /// Names, comma separated.
        known: String,
    },
    /// The model has no such parameter.
    #[error("model `{model}` has no parameter `{name}`; it takes {known}")]
    UnknownParameter {
        /// The model.
        model: &'static str,
        /// As typed.
        name: String,
        /// Names, comma separated.
        known: String,
    },
    /// Not of the form `key=value`.
    #[error("model `{model}`: expected `parameter=value`, found `{text}`")]
    NotAPair {
        /// The model.
        model: &'static str,
        /// As typed.
        text: String,
    },
    /// The same parameter twice.
    #[error("model `{model}`: parameter `{name}` is given twice")]
    Repeated {
        /// The model.
        model: &'static str,
        /// The parameter.
        name: String,
    },
    /// A value that is no number.
    #[error("model `{model}`, parameter `{name}`: expected {expected}, found `{text}`")]
    NotANumber {
        /// The model.
        model: &'static str,
        /// The parameter.
        name: String,
        /// What would do.
        expected: String,
        /// As typed.
        text: String,
    },
    /// A number outside the parameter's range.
    #[error("model `{model}`, parameter `{name}`: {value} is outside {min} ... {max}")]
    OutOfRange {
        /// The model.
        model: &'static str,
        /// The parameter.
        name: String,
        /// As given.
        value: f64,
        /// Smallest accepted.
        min: f64,
        /// Largest accepted.
        max: f64,
    },
    /// The wrong number of values.
    #[error("model `{model}`, parameter `{name}`: expected {expected}, found {found} values")]
    WrongCount {
        /// The model.
        model: &'static str,
        /// The parameter.
        name: String,
        /// What would do.
        expected: String,
        /// How many were given.
        found: usize,
    },
    /// Two parameters that exclude each other.
    #[error("model `{model}`: give either `{first}` or `{second}`, not both")]
    Exclusive {
        /// The model.
        model: &'static str,
        /// One of them.
        first: String,
        /// The other.
        second: String,
    },
}
