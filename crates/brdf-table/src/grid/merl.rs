//! MERL files to tables and back.

use crate::grid::cells::{CellPolicy, CellReport};
use crate::grid::error::GridError;
use crate::grid::layout::{Layout, PhiDomain};
use crate::grid::seal::Cell;
use crate::grid::table::HalfDiffTable;
use brdf::Pages;
use brdf_formats::{MERL_SCALE, MerlFile, MerlReader, ReadAt};
use rayon::prelude::*;
use spectrum::{Basis, RgbSpace};

/// What a MERL file can't say about the table it was made from.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct MerlLoss {
    /// Cells that were not measured: their filled values are dropped and -1 is written.
    pub filled_cells: usize,
    /// Negative channels of measured cells, which most readers take for "not measured".
    pub negative_channels: usize,
    /// The primaries are not sRGB; the file has no place for them.
    pub primaries: Option<String>,
    /// Readers that go by the dimensions will take phi_d for another range than it covers.
    pub phi_domain: bool,
}

/// Channels of a MERL file.
const CHANNELS: usize = 3;

/// The phi_d range of files in the MERL layout: 360 degrees at one degree (four times as many cells as
/// theta_d, the non-reciprocal variant) is a full turn, anything else [0, pi) with period pi.
fn domain(dims: [usize; 3]) -> PhiDomain {
    if dims[1].checked_mul(4) == Some(dims[2]) {
        PhiDomain::Full
    } else {
        PhiDomain::Reciprocal
    }
}

impl HalfDiffTable {
    /// The table of a MERL file: scaled to f_r, cells judged by `policy`. The channels count as linear sRGB.
    ///
    /// # Errors
    /// [`GridError::Dimensions`] if the table is too large to address.
    pub fn from_merl(file: &MerlFile, policy: CellPolicy) -> Result<(Self, CellReport), GridError> {
        let bytes = file.as_bytes();
        Self::from_merl_reader(&MerlReader::new(bytes, bytes.len() as u64)?, policy)
    }

    /// [`Self::from_merl`] while the file is being read, on all threads: beside the table each holds the cells of one
    /// theta_h, and nothing else is ever held.
    ///
    /// # Errors
    /// As [`Self::from_merl`], and [`GridError::File`] for what the reader reports.
    pub fn from_merl_reader<S: ReadAt + ?Sized>(
        reader: &MerlReader<'_, S>,
        policy: CellPolicy,
    ) -> Result<(Self, CellReport), GridError> {
        let dims = reader.dims().map(|n| n as usize);
        let layout =
            Layout::checked(dims, domain(dims), CHANNELS).ok_or(GridError::Dimensions(dims))?;
        let mut nodes = Pages::zeroed(layout.nodes() * CHANNELS);
        let mut cells = vec![Cell::Missing; layout.cells()];
        let plane = dims[1] * dims[2];
        let slabs = nodes.par_chunks_mut(layout.slab() * CHANNELS).skip(1);
        let reports = (slabs.zip(cells.par_chunks_mut(plane)).enumerate()).map_init(
            || vec![0.0; CHANNELS * plane],
            |values, (h, (slab, cells))| {
                for (channel, into) in values.chunks_exact_mut(plane).enumerate() {
                    reader.read(channel, (h * plane) as u64, into)?;
                }
                let (slab, _) = slab.as_chunks_mut();
                Ok::<_, GridError>(fill(layout, values, (slab, cells), policy))
            },
        );
        let report = reports.try_reduce(CellReport::default, |a, b| Ok(a.and(b)))?;
        reader.check_end()?;
        // the primaries of MERL are documented nowhere; every renderer takes them for its own
        let basis = Basis::Rgb(RgbSpace::srgb());
        Ok((Self::seal(layout, basis, nodes, &mut cells), report))
    }

    /// The table as a MERL file, -1 in cells that were not measured, and what was lost. A [`PhiDomain::Mirror`]
    /// table is written with its mirrored half, as a full turn.
    ///
    /// # Errors
    /// [`GridError::NotRgb`] for other channels than RGB; [`GridError::File`] for sizes the file can't state.
    pub fn to_merl(&self) -> Result<(MerlFile, MerlLoss), GridError> {
        let Basis::Rgb(space) = self.basis() else {
            return Err(GridError::NotRgb {
                found: self.basis().names().join(","),
            });
        };
        let [n_h, n_d, n_p] = self.dims();
        let mirrored = self.phi_domain() == PhiDomain::Mirror;
        let written = [n_h, n_d, if mirrored { 2 * n_p } else { n_p }];
        let covers = if mirrored {
            PhiDomain::Full
        } else {
            self.phi_domain()
        };
        let mut loss = MerlLoss {
            filled_cells: self.cell_indices().filter(|&c| !self.is_valid(c)).count(),
            negative_channels: self.negative_channels(),
            primaries: (*space != RgbSpace::srgb()).then(|| space.name.clone()),
            phi_domain: domain(written) != covers,
        };
        if mirrored {
            loss.filled_cells *= 2;
            loss.negative_channels *= 2;
        }
        let file = MerlFile::from_fn(
            written.map(|n| u32::try_from(n).unwrap_or(u32::MAX)),
            |c, k| {
                let p = k % written[2];
                let p = if p < n_p { p } else { written[2] - 1 - p };
                let cell = [k / (written[2] * n_d), k / written[2] % n_d, p];
                match self.value(cell) {
                    Ok(v) if self.is_valid(cell) => {
                        f64::from(v[c]) / (MERL_SCALE[c] * space.white_level)
                    }
                    _ => -1.0,
                }
            },
        )?;
        Ok((file, loss))
    }

    fn negative_channels(&self) -> usize {
        self.cell_indices()
            .filter(|&cell| self.is_valid(cell))
            .filter_map(|cell| self.value(cell).ok())
            .map(|v| v.iter().filter(|v| **v < 0.0).count())
            .sum()
    }
}

/// Nodes and cells of one theta_h from its values, plane by plane.
fn fill(
    layout: Layout,
    values: &[f64],
    (slab, cells): (&mut [[f32; CHANNELS]], &mut [Cell]),
    policy: CellPolicy,
) -> CellReport {
    let mut report = CellReport::default();
    let n_p = layout.dims[2];
    let (rgb, plane) = (MERL_SCALE, cells.len());
    for (d, cells) in cells.chunks_exact_mut(n_p).enumerate() {
        let first = layout.node([0, d, 0]) - layout.slab();
        for (p, (cell, node)) in cells.iter_mut().zip(&mut slab[first..]).enumerate() {
            let k = d * n_p + p;
            let mut f = std::array::from_fn(|c| (values[c * plane + k] * rgb[c]) as f32);
            *cell = report.judge(&mut f, policy);
            *node = f;
        }
    }
    report
}
