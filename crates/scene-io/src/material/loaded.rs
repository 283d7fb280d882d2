//! A measured file in memory.

use super::colour::ColourMeaning;
use brdf::Measured;
use brdf_formats::Format;
use brdf_table::scattered::FillReport;
use brdf_table::{CellReport, Gridded, HalfDiffTable, Policies, RglTable, ThinPlate};
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
    /// Who says what the channels mean, and by which factor numbers become f_r.
    pub colour: ColourMeaning,
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
        /// Negative values over all rows and channels.
        negative_values: usize,
    },
}

/// What rendering can make more of than `dyn Measured`.
#[derive(Clone)]
pub(super) enum Form {
    Grid(Gridded),
    /// With the hash of file and policies.
    ThinPlate(Arc<ThinPlate>, u64),
    /// With the hash of its file.
    Rgl(Arc<RglTable>, u64),
    /// Only ever asked through `measured`; with the hash of file and choices.
    Opaque(u64),
}

impl Detail {
    /// What the policies found and did, one line each; nothing where there was nothing to do.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        match self {
            Self::Grid { cells, .. } => {
                let missing = cells.cells - cells.measured;
                if missing > 0 {
                    notes.push(format!(
                        "{missing} of {} cells were not measured and are filled",
                        cells.cells
                    ));
                }
                if cells.clamped_channels > 0 {
                    notes.push(format!(
                        "{} negative values became 0",
                        cells.clamped_channels
                    ));
                }
            }
            Self::Scattered { rows, fill } => fill_notes(*rows, fill, &mut notes),
            Self::Rgl { .. } => {}
            Self::Rows {
                rows,
                negative_values,
            } => notes.push(format!("{rows} rows, {negative_values} negative values")),
        }
        notes
    }
}

fn fill_notes(rows: usize, fill: &FillReport, notes: &mut Vec<String>) {
    let negatives: usize = fill.negatives.iter().sum();
    notes.push(format!("{rows} rows, {negatives} negative values"));
    let Policies {
        negative,
        beyond,
        gap,
        dead,
    } = fill.policies;
    notes.push(format!(
        "policies: negatives {negative:?}, gap {gap:?}, beyond {beyond:?}, dead rows {dead:?}"
    ));
    if !fill.isolated.is_empty() {
        notes.push(format!(
            "{} rows contradict all their neighbours and answer at their own angles only",
            fill.isolated.len()
        ));
    }
    if fill.merged > 0 {
        notes.push(format!(
            "{} rows are averaged with others at the same angles",
            fill.merged
        ));
    }
    if fill.below_horizon > 0 {
        notes.push(format!(
            "{} rows at or below the horizon are left out",
            fill.below_horizon
        ));
    }
    notes.push(format!(
        "beyond the rows {:.0} % of the rise is kept, largest albedo {:.3}",
        100.0 * fill.growth,
        fill.albedo_beyond
    ));
}

impl LoadedMeasured {
    /// What the policies found and did; see [`Detail::notes`].
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.detail.notes()
    }

    /// The table itself, if the file is one.
    #[must_use]
    pub fn table(&self) -> Option<&Arc<HalfDiffTable>> {
        match &self.form {
            Form::Grid(grid) => Some(&grid.table),
            _ => None,
        }
    }
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
