//! MERL files to tables and back.

use crate::grid::builder::{CellPolicy, CellReport, TableBuilder};
use crate::grid::error::GridError;
use crate::grid::layout::PhiDomain;
use crate::grid::table::HalfDiffTable;
use brdf_formats::{MERL_SCALE, MerlFile, MerlStream};
use spectrum::{Basis, RgbSpace};
use std::io::Read;

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

/// Values converted at a time.
const CHUNK: usize = 8192;

/// The phi_d range of files in the MERL layout: 360 degrees at one degree (four times as many cells as
/// theta_d, the non-reciprocal variant) is a full turn, anything else [0, pi) with period pi.
fn domain(dims: [usize; 3]) -> PhiDomain {
    if dims[1].checked_mul(4) == Some(dims[2]) {
        PhiDomain::Full
    } else {
        PhiDomain::Reciprocal
    }
}

fn builder(dims: [u32; 3]) -> Result<TableBuilder, GridError> {
    let dims = dims.map(|n| n as usize);
    // the primaries of MERL are documented nowhere; every renderer takes them for its own
    let basis = Basis::Rgb(RgbSpace::srgb());
    TableBuilder::new(dims, domain(dims), basis, MERL_SCALE.to_vec())
}

impl HalfDiffTable {
    /// The table of a MERL file: scaled to f_r, cells judged by `policy`. The channels count as linear sRGB.
    ///
    /// # Errors
    /// [`GridError::Dimensions`] if the table is too large to address.
    pub fn from_merl(file: &MerlFile, policy: CellPolicy) -> Result<(Self, CellReport), GridError> {
        let mut builder = builder(file.dims())?;
        let mut chunk = Vec::with_capacity(CHUNK);
        for channel in 0..3 {
            let mut plane = file.plane(channel);
            loop {
                chunk.clear();
                chunk.extend(plane.by_ref().take(CHUNK));
                if chunk.is_empty() {
                    break;
                }
                builder.push(&chunk)?;
            }
        }
        builder.finish(policy)
    }

    /// [`Self::from_merl`] while the file is being read: nothing but the table is ever held.
    ///
    /// # Errors
    /// As [`Self::from_merl`], and [`GridError::File`] for what the stream reports.
    pub fn from_merl_stream<R: Read>(
        mut stream: MerlStream<R>,
        policy: CellPolicy,
    ) -> Result<(Self, CellReport), GridError> {
        let mut builder = builder(stream.dims())?;
        while let Some(chunk) = stream.next_chunk()? {
            builder.push(chunk)?;
        }
        builder.finish(policy)
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
