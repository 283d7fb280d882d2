//! Why a cloud of samples could not be used.

/// Why a cloud of samples could not be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CloudError {
    /// No row is left after the checks.
    #[error(
        "no usable row: expected at least one above the horizon, found {rows} rows, {below} of them at or below it"
    )]
    Empty {
        /// Rows given.
        rows: usize,
        /// Rows at or below the horizon.
        below: usize,
    },
    /// A number that is not finite.
    #[error("row {row}: expected finite numbers, found {found}")]
    NotFinite {
        /// Row, counted from 0.
        row: usize,
        /// The offending number.
        found: f64,
    },
    /// Values and directions do not go together.
    #[error("expected {expected} values ({rows} rows of {channels} channels), found {found}")]
    Shape {
        /// Rows given.
        rows: usize,
        /// Channels of the basis.
        channels: usize,
        /// Their product.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// The file has columns of a kind this crate does not know.
    #[error("the meaning of the value columns is not known to this version")]
    Channels,
    /// The rows coincide or repeat so that no interpolant passes through them.
    #[error("the {rows} rows are too close to each other to be interpolated")]
    Singular {
        /// Rows in the system.
        rows: usize,
    },
    /// More rows than one dense system may have.
    #[error(
        "expected at most {limit} rows for one surface through all of them, found {found}; \
         the layered modes (nearest, linear, squared-lambda) and kd-nearest have no such limit"
    )]
    TooManyRows {
        /// Rows given, after folding.
        found: usize,
        /// Rows allowed.
        limit: usize,
    },
    /// A conversion matrix without one row a native channel.
    #[error("expected one matrix row a channel, {expected}, found {found}")]
    Matrix {
        /// Channels of the interpolant.
        expected: usize,
        /// Rows of the matrix.
        found: usize,
    },
    /// Nothing is left to compare.
    #[error("expected {expected}, found none")]
    NothingToCompare {
        /// What was looked for.
        expected: &'static str,
    },
}
