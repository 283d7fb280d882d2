//! The table: cells over (theta_h, theta_d, phi_d), their meaning and their validity.

use crate::grid::error::GridError;
use crate::grid::layout::{Layout, PhiDomain};
use crate::grid::mask::Mask;
use crate::grid::seal::{Cell, Unsealed};
use brdf::{HalfDiff, Pages, Status, Symmetry};
use glam::DVec3;
use rayon::prelude::*;
use spectrum::Basis;

/// Isotropic reflectance on a regular grid of half and difference angles [Rusinkiewicz1998; Matusik2003].
///
/// Axes: theta_h in [0, pi/2], denser toward 0 (cell = n sqrt(theta_h / (pi/2))); theta_d in [0, pi/2],
/// uniform; phi_d uniform over the range of its [`PhiDomain`]. Values are f_r in 1/sr in single precision, in huge pages,
/// given at cell centres. One bit a cell tells measurements from filled values; it survives every operation.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfDiffTable {
    layout: Layout,
    basis: Basis,
    nodes: Pages<f32>,
    mask: Mask,
}

impl HalfDiffTable {
    /// Evaluates `f(wi, wo, out)` at every cell centre, in parallel. Returns when all cells are done.
    ///
    /// Cells where `f` returns [`Status::Filled`] keep their value and count as not measured. Cells
    /// whose centre has a direction at or below the horizon, and cells with NaN or infinite values, are not
    /// measured either, and padded from their neighbours. Dimensions of 0 are taken as 1.
    pub fn from_fn(
        dims: [usize; 3],
        phi: PhiDomain,
        basis: Basis,
        f: impl Fn(DVec3, DVec3, &mut [f64]) -> Status + Sync,
    ) -> Self {
        let layout = Layout {
            dims: dims.map(|n| n.max(1)),
            phi,
        };
        let channels = basis.len();
        let mut nodes = Pages::zeroed(layout.nodes() * channels);
        let mut cells = vec![Cell::Missing; layout.cells()];
        let [_, n_d, n_p] = layout.dims;
        let slabs = nodes
            .par_chunks_mut((layout.slab() * channels).max(1))
            .skip(1);
        let planes = cells.par_chunks_mut(n_d * n_p);
        slabs
            .zip(planes)
            .enumerate()
            .for_each(|(h, (slab, plane))| {
                let mut out = vec![0.0; channels];
                for d in 0..n_d {
                    for p in 0..n_p {
                        let (wi, wo) = layout.centre([h, d, p]).directions();
                        if wi.z <= 0.0 || wo.z <= 0.0 {
                            continue;
                        }
                        out.fill(0.0);
                        let status = f(wi, wo, &mut out);
                        let at = layout.node([0, d, p]) - layout.slab();
                        let node = &mut slab[at * channels..(at + 1) * channels];
                        plane[d * n_p + p] = store(node, &out, status);
                    }
                }
            });
        Self::seal(layout, basis, nodes, &mut cells)
    }

    /// Completes nodes whose cells are in place.
    pub(crate) fn seal(
        layout: Layout,
        basis: Basis,
        mut nodes: Pages<f32>,
        cells: &mut [Cell],
    ) -> Self {
        let mask = Unsealed {
            layout,
            channels: basis.len(),
            nodes: &mut nodes,
            cells,
        }
        .seal();
        Self {
            layout,
            basis,
            nodes,
            mask,
        }
    }

    /// Cells along theta_h, theta_d and phi_d.
    #[must_use]
    pub fn dims(&self) -> [usize; 3] {
        self.layout.dims
    }

    /// What the phi_d axis covers.
    #[must_use]
    pub fn phi_domain(&self) -> PhiDomain {
        self.layout.phi
    }

    /// What the channels mean.
    #[must_use]
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// How many channels a cell has.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.basis.len()
    }

    /// Isotropic always; reciprocal if phi_d has period pi.
    #[must_use]
    pub fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: true,
            reciprocal: self.layout.phi == PhiDomain::Reciprocal,
        }
    }

    /// Half and difference angles at the centre of cell `[h, d, p]`.
    #[must_use]
    pub fn centre(&self, cell: [usize; 3]) -> HalfDiff {
        self.layout.centre(cell)
    }

    /// The channels of cell `[h, d, p]`, f_r in 1/sr. Cells that were not measured hold their padding.
    ///
    /// # Errors
    /// [`GridError::Dimensions`] if there is no such cell.
    pub fn value(&self, cell: [usize; 3]) -> Result<&[f32], GridError> {
        self.check(cell)?;
        Ok(self.node_values(self.layout.node(cell)))
    }

    /// Whether cell `[h, d, p]` was measured; false outside the table.
    #[must_use]
    pub fn is_valid(&self, cell: [usize; 3]) -> bool {
        self.check(cell).is_ok() && self.mask.get(self.layout.node(cell))
    }

    /// How many cells were measured.
    #[must_use]
    pub fn valid_cells(&self) -> usize {
        self.cell_indices()
            .filter(|&cell| self.is_valid(cell))
            .count()
    }

    /// Every `[h, d, p]`, phi_d fastest.
    pub fn cell_indices(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [n_h, n_d, n_p] = self.layout.dims;
        (0..n_h).flat_map(move |h| (0..n_d).flat_map(move |d| (0..n_p).map(move |p| [h, d, p])))
    }

    /// Bytes held by values and mask.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.nodes.len() * size_of::<f32>() + self.mask.bytes()
    }

    fn check(&self, cell: [usize; 3]) -> Result<(), GridError> {
        let inside = cell.iter().zip(self.layout.dims).all(|(&k, n)| k < n);
        inside.then_some(()).ok_or(GridError::Dimensions(cell))
    }

    pub(crate) fn layout(&self) -> Layout {
        self.layout
    }

    pub(crate) fn mask(&self) -> &Mask {
        &self.mask
    }

    pub(crate) fn nodes(&self) -> &[f32] {
        &self.nodes
    }

    pub(crate) fn node_values(&self, node: usize) -> &[f32] {
        let c = self.channels();
        &self.nodes[node * c..(node + 1) * c]
    }
}

/// Puts `values` into a node if all are finite in single precision, and tells what the cell has become.
pub(crate) fn store(node: &mut [f32], values: &[f64], status: Status) -> Cell {
    if !values.iter().all(|v| (*v as f32).is_finite()) {
        return Cell::Missing;
    }
    for (n, v) in node.iter_mut().zip(values) {
        *n = *v as f32;
    }
    if status == Status::Filled {
        Cell::Filled
    } else {
        Cell::Valid
    }
}
