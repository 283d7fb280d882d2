//! The list of all cases.

mod models;

use crate::case::Case;

/// Every case, group by group.
#[must_use]
pub fn cases() -> Vec<Case> {
    models::cases()
}
