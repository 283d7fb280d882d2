//! How many slices and nodes a half-vector table has, and how its node values are indexed.

/// Node counts of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    /// Slices of the viewer's elevation.
    pub(crate) n_theta: usize,
    /// Nodes along the radial coordinate a.
    pub(crate) n_a: usize,
    /// Nodes along the azimuth b.
    pub(crate) n_b: usize,
}

impl Shape {
    /// Nodes of one slice.
    pub(crate) fn slice(self) -> usize {
        self.n_a * self.n_b
    }

    /// Nodes of all slices.
    pub(crate) fn nodes(self) -> usize {
        self.n_theta * self.slice()
    }

    /// Cells of one slice.
    pub(crate) fn cells(self) -> usize {
        (self.n_a - 1) * (self.n_b - 1)
    }

    /// Integral over the unit square of the hat function of node `(i, j)`.
    pub(crate) fn hat_mass(self, i: usize, j: usize) -> f64 {
        let end = |k: usize, n: usize| if k == 0 || k + 1 == n { 0.5 } else { 1.0 };
        end(i, self.n_a) * end(j, self.n_b) / self.cells() as f64
    }

    /// Integral of the bilinear function with the given node values of one slice.
    pub(crate) fn mass(self, values: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (i, row) in values.chunks_exact(self.n_b).enumerate() {
            for (j, v) in row.iter().enumerate() {
                sum += v * self.hat_mass(i, j);
            }
        }
        sum
    }
}
