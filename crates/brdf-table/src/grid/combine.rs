//! Linear operations on whole tables: mixing, changing the channels, resampling.

use crate::grid::error::GridError;
use crate::grid::layout::PhiDomain;
use crate::grid::lookup::Interpolation;
use crate::grid::seal::Cell;
use crate::grid::table::HalfDiffTable;
use brdf::Pages;
use rayon::prelude::*;
use spectrum::Basis;

/// The table `sum_k weight_k * table_k`. A cell counts as measured only if it is in every table.
///
/// Any finite weights are taken; whether a mixture with weights that don't sum to 1 keeps energy is
/// the caller's to check.
///
/// # Errors
/// [`GridError::Empty`], [`GridError::Weight`]; [`GridError::GridMismatch`] or [`GridError::BasisMismatch`] if
/// the tables differ in dimensions, phi domain or channels: [`HalfDiffTable::resample`] and
/// [`HalfDiffTable::map_channels`] bring them together.
pub fn mix(parts: &[(&HalfDiffTable, f64)]) -> Result<HalfDiffTable, GridError> {
    let &(first, _) = parts.first().ok_or(GridError::Empty)?;
    for (index, (table, weight)) in parts.iter().enumerate() {
        if !weight.is_finite() {
            return Err(GridError::Weight { index });
        }
        if table.layout() != first.layout() {
            return Err(GridError::GridMismatch {
                index,
                expected: first.layout().describe(),
                found: table.layout().describe(),
            });
        }
        if table.basis() != first.basis() {
            return Err(GridError::BasisMismatch { index });
        }
    }
    let mut nodes = Pages::zeroed(first.nodes().len());
    for (k, node) in nodes.iter_mut().enumerate() {
        let sum: f64 = parts.iter().map(|(t, w)| w * f64::from(t.nodes()[k])).sum();
        *node = sum as f32;
    }
    let valid = |cell| parts.iter().all(|(t, _)| t.is_valid(cell));
    Ok(first.rebuilt(first.basis().clone(), nodes, valid))
}

impl HalfDiffTable {
    /// The same cells in other channels: `new[j] = sum_c matrix[c][j] * old[c]`. The mask stays.
    ///
    /// # Errors
    /// [`GridError::Channels`] if the matrix does not have one row a channel, or a row does not have one
    /// entry a channel of `basis`; [`GridError::Weight`] with the row of an entry that is not finite.
    pub fn map_channels(&self, matrix: &[Vec<f64>], basis: Basis) -> Result<Self, GridError> {
        let check = |expected: usize, found: usize| {
            let equal = expected == found;
            equal
                .then_some(())
                .ok_or(GridError::Channels { expected, found })
        };
        check(self.channels(), matrix.len())?;
        for (index, row) in matrix.iter().enumerate() {
            check(basis.len(), row.len())?;
            if !row.iter().all(|m| m.is_finite()) {
                return Err(GridError::Weight { index });
            }
        }
        let mut nodes = Pages::zeroed(self.layout().nodes() * basis.len());
        let rows = nodes.par_chunks_mut((self.layout().row() * basis.len()).max(1));
        let olds = self
            .nodes()
            .par_chunks((self.layout().row() * self.channels()).max(1));
        rows.zip(olds).for_each(|(row, olds)| {
            let news = row.chunks_exact_mut(basis.len());
            for (new, old) in news.zip(olds.chunks_exact(self.channels())) {
                for (j, new) in new.iter_mut().enumerate() {
                    let parts = old.iter().zip(matrix);
                    let sum: f64 = parts.map(|(v, row)| f64::from(*v) * row[j]).sum();
                    *new = sum as f32;
                }
            }
        });
        Ok(self.rebuilt(basis, nodes, |cell| self.is_valid(cell)))
    }

    /// The table read at the cell centres of another grid. Cells that are read from filled ones are filled.
    #[must_use]
    pub fn resample(&self, dims: [usize; 3], phi: PhiDomain, how: Interpolation) -> Self {
        Self::from_fn(dims, phi, self.basis().clone(), |wi, wo, out| {
            self.eval(wi, wo, how, out)
        })
    }

    /// A table on the same grid from nodes that hold a value everywhere.
    fn rebuilt(&self, basis: Basis, nodes: Pages<f32>, valid: impl Fn([usize; 3]) -> bool) -> Self {
        let mut cells: Vec<Cell> = self
            .cell_indices()
            .map(|cell| {
                if valid(cell) {
                    Cell::Valid
                } else {
                    Cell::Filled
                }
            })
            .collect();
        Self::seal(self.layout(), basis, nodes, &mut cells)
    }
}
