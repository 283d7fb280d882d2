//! What a measured file is, found out without interpolating it.

use super::colour::{ColourMeaning, Recolouring};
use super::loaded::{Detail, LoadedMeasured};
use brdf_formats::Format;
use brdf_table::SampleCloud;
use spectrum::Basis;
use std::path::PathBuf;

/// What a measured file is and holds.
#[derive(Clone, Debug)]
pub struct Identity {
    /// Where it was found.
    pub path: PathBuf,
    /// The format it was recognised as.
    pub format: &'static Format,
    /// Size of the file.
    pub bytes: u64,
    /// What its channels mean.
    pub basis: Basis,
    /// Who says so, and by which factor numbers become f_r.
    pub colour: ColourMeaning,
    /// Whether swapping light and viewer changes nothing, by its layout.
    pub reciprocal: bool,
    /// Cells or rows; [`Detail::Rows`] for all scattered measurements.
    pub detail: Detail,
}

impl Identity {
    pub(super) fn of(loaded: LoadedMeasured) -> Self {
        Self {
            basis: loaded.measured.basis().clone(),
            reciprocal: loaded.measured.symmetry().reciprocal,
            path: loaded.path,
            format: loaded.format,
            bytes: loaded.bytes,
            colour: loaded.colour,
            detail: loaded.detail,
        }
    }

    pub(super) fn of_rows(
        format: &'static Format,
        bytes: u64,
        cloud: &SampleCloud,
        recolouring: Recolouring,
    ) -> Self {
        Self {
            path: PathBuf::new(),
            format,
            bytes,
            basis: recolouring.basis,
            colour: recolouring.meaning,
            reciprocal: false,
            detail: Detail::Rows {
                rows: cloud.len(),
                negative_values: cloud.negatives().iter().sum(),
            },
        }
    }

    /// One line for everything that was found missing, negative or left out; see [`Detail::notes`].
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.detail.notes()
    }
}
