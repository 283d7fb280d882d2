//! A measured file in memory.

use brdf::Measured;
use brdf_formats::Format;
use brdf_table::scattered::FillReport;
use brdf_table::{CellReport, Gridded};
use brdf_table::{RglTable, ThinPlate};
use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

/// A measured file: its reflectance in its own channels, interpolated as asked.
#[derive(Clone)]
pub struct LoadedMeasured {
    /// f_r in the file's channels; answers through the interpolant itself.
    pub measured: Arc<dyn Measured>,
    /// The format it was recognised as.
    pub format: &'static Format,
    /// Where it was found.
    pub path: PathBuf,
    /// Size of the file.
    pub bytes: u64,
    /// What the policies found and did.
    pub detail: Detail,
    pub(super) form: Form,
}

/// What was found in a file and done about it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Detail {
    /// A grid of cells.
    Grid {
        /// Cells in theta_h, theta_d, phi_d.
        dims: [usize; 3],
        /// Cells by verdict.
        cells: CellReport,
    },
    /// Scattered rows, interpolated by thin plates.
    Scattered {
        /// Rows in the file.
        rows: usize,
        /// What was filled, left out and kept.
        fill: Box<FillReport>,
    },
    /// An RGL tensor file, in its own coordinates.
    Rgl {
        /// What its authors wrote about it.
        description: String,
    },
    /// Scattered rows under one of the older schemes.
    Rows {
        /// Rows in the file.
        rows: usize,
        /// Rows with a negative channel.
        negative_rows: usize,
    },
}

/// What rendering can make more of than `dyn Measured`.
#[derive(Clone)]
pub(super) enum Form {
    Grid(Gridded),
    ThinPlate(Arc<ThinPlate>),
    /// With the hash of its file.
    Rgl(Arc<RglTable>, u64),
    /// Only ever asked through `measured`.
    Opaque,
}

impl fmt::Debug for LoadedMeasured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LoadedMeasured")
            .field("path", &self.path)
            .field("format", &self.format.name)
            .field("detail", &self.detail)
            .finish_non_exhaustive()
    }
}
