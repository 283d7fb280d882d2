//! Densities on the unit square, bilinear between nodes, linear between incidences, and the warp that samples
//! them: marginal over rows first, then along the row.

use crate::rgl::image::{Image, Place};
use crate::rgl::slices::Slices;

/// One density an incidence, each with unit integral.
#[derive(Clone, Debug)]
pub(crate) struct Warp {
    /// Node values, scaled so that each grid integrates to 1 in units of its cells.
    density: Image,
    /// Integral along each row up to each column, `[slice][row][col]`.
    conditional: Vec<f64>,
    /// Integral of all rows up to each row, `[slice][row]`.
    marginal: Vec<f64>,
}

impl Warp {
    /// From unnormalised node values. Negative and NaN nodes count as 0; a grid without any mass is uniform.
    pub(crate) fn new(nx: usize, ny: usize, mut data: Vec<f32>) -> Self {
        let mut conditional = Vec::with_capacity(data.len());
        let mut marginal = Vec::with_capacity(data.len() / nx);
        for grid in data.chunks_exact_mut(nx * ny) {
            for v in grid.iter_mut() {
                *v = if v.is_finite() { v.max(0.0) } else { 0.0 };
            }
            if grid.iter().all(|v| *v <= 0.0) {
                grid.fill(1.0);
            }
            let scale = 1.0 / total(grid, nx);
            let (mut below, mut previous) = (0.0, None);
            for row in grid.chunks_exact_mut(nx) {
                for v in row.iter_mut() {
                    *v = (f64::from(*v) * scale) as f32;
                }
                let mut along = 0.0;
                conditional.push(0.0);
                for pair in row.windows(2) {
                    along += 0.5 * (f64::from(pair[0]) + f64::from(pair[1]));
                    conditional.push(along);
                }
                below += previous.map_or(0.0, |p: f64| 0.5 * (p + along));
                marginal.push(below);
                previous = Some(along);
            }
        }
        Self {
            density: Image::new(nx, ny, data),
            conditional,
            marginal,
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        self.density.bytes() + (self.conditional.len() + self.marginal.len()) * size_of::<f64>()
    }

    /// Nodes of a row and rows of a grid.
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.density.nx(), self.density.ny())
    }

    /// Density at each node and the mass along its row up to it, slice by slice, row by row.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = (f32, f64)> {
        let density = self.density.nodes().iter().copied();
        density.zip(self.conditional.iter().copied())
    }

    /// Mass of all rows up to each row, slice by slice.
    pub(crate) fn rows_below(&self) -> &[f64] {
        &self.marginal
    }

    /// Density at `u` per unit area of the square.
    pub(crate) fn pdf(&self, u: [f64; 2], slices: &Slices) -> f64 {
        self.density.blend(slices, 1, 0, self.density.place(u)) * self.cells()
    }

    /// The point whose cumulative coordinates are `u`, and its density.
    pub(crate) fn sample(&self, u: [f64; 2], slices: &Slices) -> ([f64; 2], f64) {
        let (nx, ny) = (self.density.nx(), self.density.ny());
        let row = interval(ny, |row| self.marginal(slices, row) <= u[1]);
        let (r0, r1) = (self.row_mass(slices, row), self.row_mass(slices, row + 1));
        let y = invert_linear(u[1] - self.marginal(slices, row), r0, r1);
        let target = u[0] * (r0 + y * (r1 - r0));
        let along = |col| self.along(slices, row, col, y);
        let col = interval(nx, |col| along(col) <= target);
        let mut at = Place {
            col,
            row,
            x: 0.0,
            y,
        };
        let c0 = self.density.blend(slices, 1, 0, at);
        at.x = 1.0;
        let c1 = self.density.blend(slices, 1, 0, at);
        at.x = invert_linear(target - along(col), c0, c1);
        let point = [
            (col as f64 + at.x) / (nx - 1) as f64,
            (row as f64 + y) / (ny - 1) as f64,
        ];
        (point, self.density.blend(slices, 1, 0, at) * self.cells())
    }

    /// The cumulative coordinates of point `p`, and its density: the inverse of [`Self::sample`].
    pub(crate) fn invert(&self, p: [f64; 2], slices: &Slices) -> ([f64; 2], f64) {
        let at = self.density.place(p);
        let c0 = self.density.blend(slices, 1, 0, Place { x: 0.0, ..at });
        let c1 = self.density.blend(slices, 1, 0, Place { x: 1.0, ..at });
        let (r0, r1) = (
            self.row_mass(slices, at.row),
            self.row_mass(slices, at.row + 1),
        );
        let along = self.along(slices, at.row, at.col, at.y) + at.x * (c0 + 0.5 * at.x * (c1 - c0));
        let row = r0 + at.y * (r1 - r0);
        let below = self.marginal(slices, at.row) + at.y * (r0 + 0.5 * at.y * (r1 - r0));
        let u = if row > 0.0 { along / row } else { p[0] };
        ([u, below], (c0 + at.x * (c1 - c0)) * self.cells())
    }

    fn cells(&self) -> f64 {
        ((self.density.nx() - 1) * (self.density.ny() - 1)) as f64
    }

    fn marginal(&self, slices: &Slices, row: usize) -> f64 {
        sum(slices, |slice| {
            self.marginal[slice * self.density.ny() + row]
        })
    }

    fn row_mass(&self, slices: &Slices, row: usize) -> f64 {
        self.conditional(slices, row, self.density.nx() - 1)
    }

    /// Cumulative mass along the horizontal line at height `y` of `row`, up to `col`.
    fn along(&self, slices: &Slices, row: usize, col: usize, y: f64) -> f64 {
        let (a, b) = (
            self.conditional(slices, row, col),
            self.conditional(slices, row + 1, col),
        );
        a + y * (b - a)
    }

    fn conditional(&self, slices: &Slices, row: usize, col: usize) -> f64 {
        let (nx, ny) = (self.density.nx(), self.density.ny());
        sum(slices, |slice| {
            self.conditional[(slice * ny + row) * nx + col]
        })
    }
}

fn sum(slices: &Slices, value: impl Fn(usize) -> f64) -> f64 {
    slices
        .iter()
        .filter(|(_, w)| *w > 0.0)
        .map(|&(slice, w)| w * value(slice))
        .sum()
}

/// Integral of a bilinear grid in units of its cells.
fn total(grid: &[f32], nx: usize) -> f64 {
    let rows: Vec<f64> = grid
        .chunks_exact(nx)
        .map(|row| {
            row.windows(2)
                .map(|p| 0.5 * (f64::from(p[0]) + f64::from(p[1])))
                .sum()
        })
        .collect();
    rows.windows(2).map(|p| 0.5 * (p[0] + p[1])).sum()
}

/// The last of `0..n - 1` for which `below` holds (0 if none does); `below` holds up to some point, then no more.
fn interval(n: usize, below: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, n - 1);
    while high - low > 1 {
        let middle = usize::midpoint(low, high);
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// t in [0, 1] with a t + (b - a) t^2 / 2 = mass, in the form that does not cancel.
fn invert_linear(mass: f64, a: f64, b: f64) -> f64 {
    let root = (a * a + 2.0 * (b - a) * mass).max(0.0).sqrt();
    if a + root > 0.0 {
        (2.0 * mass / (a + root)).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::Warp;

    const SLICES: [(usize, f64); 4] = [(0, 0.3), (1, 0.7), (0, 0.0), (1, 0.0)];

    fn warp() -> Warp {
        let data = (0..2 * 5 * 7)
            .map(|k| ((k * 37 + 11) % 23) as f32 * if k % 5 == 0 { 0.0 } else { 1.0 });
        Warp::new(7, 5, data.collect())
    }

    #[test]
    fn invert_undoes_sample_and_agrees_on_the_density() {
        let warp = warp();
        for k in 0..400 {
            let u = [
                (f64::from(k) + 0.5) / 400.0,
                (f64::from(k) * 0.618_033_988_75).fract(),
            ];
            let (p, pdf) = warp.sample(u, &SLICES);
            let (back, again) = warp.invert(p, &SLICES);
            assert!(
                (back[0] - u[0]).abs() < 1e-9 && (back[1] - u[1]).abs() < 1e-9,
                "{u:?} -> {p:?} -> {back:?}"
            );
            assert!(
                (pdf - again).abs() < 1e-9 * pdf.max(1.0),
                "density {pdf} and {again}"
            );
            assert!(
                (pdf - warp.pdf(p, &SLICES)).abs() < 1e-9 * pdf.max(1.0),
                "density {pdf}"
            );
        }
    }

    #[test]
    fn density_integrates_to_one() {
        let (warp, n) = (warp(), 600);
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let u = [
                    (f64::from(i) + 0.5) / f64::from(n),
                    (f64::from(j) + 0.5) / f64::from(n),
                ];
                sum += warp.pdf(u, &SLICES);
            }
        }
        // midpoints are exact on bilinear cells, and 600 is a multiple of 6 and of 4 cells
        assert!((sum / f64::from(n * n) - 1.0).abs() < 1e-6, "{sum}");
    }
}
