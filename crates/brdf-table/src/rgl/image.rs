//! Bilinear grids over the unit square, blended over incidences.

use crate::rgl::slices::Slices;

/// Grids of `ny` rows of `nx` nodes; the outermost nodes lie on the edges of the unit square.
#[derive(Clone, Debug)]
pub(crate) struct Image {
    nx: usize,
    ny: usize,
    data: Vec<f32>,
}

/// A cell of the grid and the place in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) col: usize,
    pub(crate) row: usize,
    pub(crate) x: f64,
    pub(crate) y: f64,
}

impl Image {
    /// `data` is a whole number of grids, x fastest; both sizes are at least 2.
    pub(crate) fn new(nx: usize, ny: usize, data: Vec<f32>) -> Self {
        Self { nx, ny, data }
    }

    #[inline(always)]
    pub(crate) fn nx(&self) -> usize {
        self.nx
    }

    #[inline(always)]
    pub(crate) fn ny(&self) -> usize {
        self.ny
    }

    pub(crate) fn bytes(&self) -> usize {
        self.data.len() * size_of::<f32>()
    }

    /// Where `u` in the unit square lies.
    pub(crate) fn place(&self, u: [f64; 2]) -> Place {
        let split = |u: f64, n: usize| {
            let position = u.clamp(0.0, 1.0) * (n - 1) as f64;
            let whole = (position as usize).min(n - 2);
            (whole, position - whole as f64)
        };
        let ((col, x), (row, y)) = (split(u[0], self.nx), split(u[1], self.ny));
        Place { col, row, x, y }
    }

    /// All nodes, grid by grid, row by row.
    pub(crate) fn nodes(&self) -> &[f32] {
        &self.data
    }

    /// Node `[row, col]` of grid `slice`.
    pub(crate) fn node(&self, slice: usize, row: usize, col: usize) -> f64 {
        f64::from(self.data[(slice * self.ny + row) * self.nx + col])
    }

    /// The four nodes from `[row, col]` on of the first grid, row by row.
    #[inline(always)]
    pub(crate) fn cell(&self, row: usize, col: usize) -> [[f32; 2]; 2] {
        let pair = |row: usize| {
            let start = row * self.nx + col;
            let nodes = &self.data[start..start + 2];
            [nodes[0], nodes[1]]
        };
        [pair(row), pair(row + 1)]
    }

    /// Grid `slice` at a place.
    pub(crate) fn eval(&self, slice: usize, at: Place) -> f64 {
        let row = |row| {
            let (a, b) = (
                self.node(slice, row, at.col),
                self.node(slice, row, at.col + 1),
            );
            a + at.x * (b - a)
        };
        let (low, high) = (row(at.row), row(at.row + 1));
        low + at.y * (high - low)
    }

    /// Weighted sum over incidences; each incidence holds `stride` grids, of which this is number `k`.
    pub(crate) fn blend(&self, slices: &Slices, stride: usize, k: usize, at: Place) -> f64 {
        slices
            .iter()
            .filter(|(_, w)| *w > 0.0)
            .map(|(slice, w)| w * self.eval(slice * stride + k, at))
            .sum()
    }
}
