//! What can be wrong with a request to build or combine tables.

use thiserror::Error;

/// Why a half-difference table could not be built, combined or converted.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GridError {
    /// A dimension is zero, or the product does not fit in memory.
    #[error("table dimensions {0:?}: each must be at least 1 and the table must fit in memory")]
    Dimensions([usize; 3]),
    /// The table has another number of channels than is asked of it.
    #[error("channels: expected {expected}, found {found}")]
    Channels {
        /// What the caller needs.
        expected: usize,
        /// What the table has.
        found: usize,
    },
    /// Tables on different grids can't be combined cell by cell.
    #[error("table {index}: grid {found} differs from {expected} of table 0; resample it first")]
    GridMismatch {
        /// Position in the caller's list.
        index: usize,
        /// Grid of the first table.
        expected: String,
        /// Grid of this one.
        found: String,
    },
    /// Channels of different meaning can't be added.
    #[error(
        "table {index}: its channels mean something else than those of table 0; map them first"
    )]
    BasisMismatch {
        /// Position in the caller's list.
        index: usize,
    },
    /// Nothing to combine.
    #[error("no table given")]
    Empty,
    /// A weight or matrix entry is NaN or infinite.
    #[error("weight {index} is not finite")]
    Weight {
        /// Position in the caller's list.
        index: usize,
    },
    /// The target stores RGB only.
    #[error("channels: expected R,G,B, found {found}")]
    NotRgb {
        /// Names of the channels.
        found: String,
    },
    /// The file can't be read or written.
    #[error(transparent)]
    File(#[from] brdf_formats::Error),
}
