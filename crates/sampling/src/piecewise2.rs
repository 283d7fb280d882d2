//! Tabulated densities in two dimensions: a marginal over the rows, a conditional within each.

use crate::density_error::{DensityError, check};
use crate::piecewise1::{invert_linear, locate, part_of_linear};
use crate::{ONE_MINUS_EPSILON, Piecewise1};
use glam::DVec2;

/// A density on the unit square given on a regular grid: constant in cells, or bilinear between nodes.
///
/// Rows run along x, y tells the row. `sample` inverts exactly, first y from u.y by the marginal, then x
/// from u.x by the conditional; it is continuous in y for bilinear tables and keeps strata.
#[derive(Clone, Debug, PartialEq)]
pub struct Piecewise2 {
    shape: Shape,
    /// Values in a row.
    width: usize,
    /// Density at cells or nodes, row-major.
    values: Vec<f64>,
    /// For each row, the integral of `values` up to each cell border along x; row-major, cells + 1 a row.
    sums: Vec<f64>,
    marginal: Piecewise1,
    /// Of the values as given.
    integral: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Constant,
    Bilinear,
}

impl Piecewise2 {
    /// `width` cells a row, `values` row by row; cell (i, j) covers [i/width, (i+1)/width) x [j/rows, ..).
    ///
    /// # Errors
    /// If the values don't fill rows, one is negative or not finite, or all are 0.
    pub fn constant(width: usize, values: &[f64]) -> Result<Self, DensityError> {
        Self::build(Shape::Constant, width, values)
    }

    /// `width` >= 2 nodes a row, at least 2 rows; node (i, j) lies at (i/(width-1), j/(rows-1)).
    ///
    /// # Errors
    /// If the values don't fill rows, one is negative or not finite, or all are 0.
    pub fn bilinear(width: usize, values: &[f64]) -> Result<Self, DensityError> {
        Self::build(Shape::Bilinear, width, values)
    }

    fn build(shape: Shape, width: usize, values: &[f64]) -> Result<Self, DensityError> {
        let least = if shape == Shape::Constant { 1 } else { 2 };
        let width = width.max(least);
        check(values, least * width)?;
        if !values.len().is_multiple_of(width) {
            return Err(DensityError::Size {
                expected: values.len().next_multiple_of(width),
                found: values.len(),
            });
        }
        let unit = power_of_two(values);
        let values: Vec<f64> = values.iter().map(|v| v / unit).collect();
        let totals: Vec<f64> = values.chunks(width).map(|row| total(shape, row)).collect();
        let marginal = match shape {
            Shape::Constant => Piecewise1::constant(&totals)?,
            Shape::Bilinear => Piecewise1::linear(&totals)?,
        };
        let integral = marginal.integral();
        let values: Vec<f64> = values.iter().map(|v| v / integral).collect();
        let sums = values
            .chunks(width)
            .flat_map(|row| sums(shape, row))
            .collect();
        Ok(Self {
            shape,
            width,
            values,
            sums,
            marginal,
            integral: integral * unit,
        })
    }

    /// Cells along x and y.
    #[must_use]
    pub fn cells(&self) -> [usize; 2] {
        let x = match self.shape {
            Shape::Constant => self.width,
            Shape::Bilinear => self.width - 1,
        };
        [x, self.marginal.cells()]
    }

    /// Integral over the unit square of the values as given, before they were normalised.
    #[must_use]
    pub fn integral(&self) -> f64 {
        self.integral
    }

    /// Bytes the tables hold.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.values[..]) + size_of_val(&self.sums[..]) + self.marginal.bytes()
    }

    /// The point that `u` in [0, 1)^2 selects, in [0, 1)^2, and the density there.
    ///
    /// The density is 0 only where `u` falls on the edge of the support of a bilinear table.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: DVec2) -> (DVec2, f64) {
        let (y, _) = self.marginal.sample(u.y);
        let row = self.row(y);
        let n = self.cells()[0];
        // The row's own sum, not the marginal's: the two differ by rounding, and u.x must stay inside.
        let target = u.x * row.sum(n);
        let mut cell = partition_point(n, |k| row.sum(k + 1) <= target).min(n - 1);
        // u.x just below 1 may round up to the sum: the last cell with mass is meant.
        while cell > 0 && row.sum(cell + 1) <= row.sum(cell) {
            cell -= 1;
        }
        let (left, right) = row.ends(cell);
        let (low, high) = (row.sum(cell), row.sum(cell + 1));
        // On the very edge of the support a row may have no mass: its density there is 0.
        let part = if high > low {
            ((target - low) / (high - low)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let t = invert_linear(left, right, part);
        let x = ((cell as f64 + t) / n as f64).min(ONE_MINUS_EPSILON);
        (DVec2::new(x, y), left + (right - left) * t)
    }

    /// Density at `p`, 0 outside of the square.
    #[inline]
    #[must_use]
    pub fn pdf(&self, p: DVec2) -> f64 {
        let inside = |v| (0.0..=1.0).contains(&v);
        if !inside(p.x) || !inside(p.y) {
            return 0.0;
        }
        let (cell, t) = locate(p.x, self.cells()[0]);
        let (left, right) = self.row(p.y).ends(cell);
        left + (right - left) * t
    }

    /// The u that `sample` maps to `p`.
    #[inline]
    #[must_use]
    pub fn invert(&self, p: DVec2) -> DVec2 {
        let p = p.clamp(DVec2::ZERO, DVec2::ONE);
        let n = self.cells()[0];
        let row = self.row(p.y);
        let (cell, t) = locate(p.x, n);
        let (left, right) = row.ends(cell);
        let (low, high) = (row.sum(cell), row.sum(cell + 1));
        let below = low + (high - low) * part_of_linear(left, right, t);
        let total = row.sum(n);
        let x = if total > 0.0 { below / total } else { p.x };
        DVec2::new(x, self.marginal.invert(p.y))
    }

    /// The conditional at height `y`.
    #[inline]
    fn row(&self, y: f64) -> Row<'_> {
        let (j, t) = locate(y, self.marginal.cells());
        let borders = self.cells()[0] + 1;
        let values = |j: usize| &self.values[j * self.width..(j + 1) * self.width];
        let sums = |j: usize| &self.sums[j * borders..(j + 1) * borders];
        match self.shape {
            Shape::Constant => Row {
                shape: self.shape,
                values: [values(j), values(j)],
                sums: [sums(j), sums(j)],
                t: 0.0,
            },
            Shape::Bilinear => Row {
                shape: self.shape,
                values: [values(j), values(j + 1)],
                sums: [sums(j), sums(j + 1)],
                t,
            },
        }
    }
}

/// A row between two rows of the table.
struct Row<'a> {
    shape: Shape,
    values: [&'a [f64]; 2],
    sums: [&'a [f64]; 2],
    t: f64,
}

impl Row<'_> {
    #[inline]
    fn mix(&self, [a, b]: [f64; 2]) -> f64 {
        (1.0 - self.t) * a + self.t * b
    }

    /// Integral of the row up to cell border `k`.
    #[inline]
    fn sum(&self, k: usize) -> f64 {
        self.mix(self.sums.map(|s| s[k]))
    }

    /// Density at both ends of a cell.
    #[inline]
    fn ends(&self, cell: usize) -> (f64, f64) {
        let left = self.mix(self.values.map(|v| v[cell]));
        match self.shape {
            Shape::Constant => (left, left),
            Shape::Bilinear => (left, self.mix(self.values.map(|v| v[cell + 1]))),
        }
    }
}

/// The power of two next to the largest value: dividing by it rounds nothing, and sums of values that are all close to
/// the ends of f64 neither lose their digits nor overflow. 1 for values that are all 0.
fn power_of_two(values: &[f64]) -> f64 {
    let most = values.iter().fold(0.0_f64, |m, &v| m.max(v));
    if most > 0.0 {
        // the exponents of f64, but for those whose inverse it has not
        most.log2().floor().clamp(-1022.0, 1022.0).exp2()
    } else {
        1.0
    }
}

/// Masses of the cells of a row, up to the cell width.
fn masses(shape: Shape, row: &[f64]) -> Box<dyn Iterator<Item = f64> + '_> {
    match shape {
        Shape::Constant => Box::new(row.iter().copied()),
        Shape::Bilinear => Box::new(row.windows(2).map(|w| 0.5 * w[0] + 0.5 * w[1])),
    }
}

/// Integral of a row over x in [0, 1].
fn total(shape: Shape, row: &[f64]) -> f64 {
    let cells = masses(shape, row).count();
    masses(shape, row).sum::<f64>() / cells as f64
}

/// Integrals of a row up to each cell border.
fn sums(shape: Shape, row: &[f64]) -> Vec<f64> {
    let cells = masses(shape, row).count() as f64;
    let mut below = 0.0;
    let mut sums = vec![0.0];
    sums.extend(masses(shape, row).map(|m| {
        below += m;
        below / cells
    }));
    sums
}

/// The first of 0..n that fails the monotone `predicate`, or n.
#[inline]
fn partition_point(n: usize, predicate: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut size) = (0, n);
    while size > 0 {
        let half = size / 2;
        if predicate(low + half) {
            low += half + 1;
            size -= half + 1;
        } else {
            size = half;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::chi2::{Config, test};
    use testkit::{Domain, assert_close, assert_relative};

    fn values(n: usize) -> Vec<f64> {
        (0..n)
            .map(|k| (k * k % 13) as f64 + if k % 5 == 0 { 40.0 } else { 0.0 })
            .collect()
    }

    fn examples() -> Vec<Piecewise2> {
        vec![
            Piecewise2::constant(1, &[2.0]).unwrap(),
            Piecewise2::constant(3, &[0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0]).unwrap(),
            Piecewise2::constant(7, &values(35)).unwrap(),
            Piecewise2::bilinear(2, &[0.0, 1.0, 0.0, 0.0]).unwrap(),
            Piecewise2::bilinear(9, &values(54)).unwrap(),
        ]
    }

    #[test]
    fn chi_square_accepts_every_table() {
        let examples = examples();
        for (which, table) in examples.iter().enumerate() {
            let config = Config {
                domain: Domain::Square,
                tests: examples.len(),
                ..Config::default()
            };
            let sample = |r: &mut testkit::Rng| {
                let (p, _) = table.sample(DVec2::from(r.uniform2()));
                Some([p.x, p.y, 0.0])
            };
            let report = test(&config, sample, |p| table.pdf(DVec2::new(p[0], p[1])));
            assert!(report.ok, "table {which}: {report}");
        }
    }

    #[test]
    fn chi_square_rejects_exchanged_axes() {
        let table = Piecewise2::bilinear(9, &values(54)).unwrap();
        let config = Config {
            domain: Domain::Square,
            ..Config::default()
        };
        let sample = |r: &mut testkit::Rng| {
            let (p, _) = table.sample(DVec2::from(r.uniform2()));
            Some([p.y, p.x, 0.0])
        };
        let report = test(&config, sample, |p| table.pdf(DVec2::new(p[0], p[1])));
        assert!(!report.ok, "{report}");
    }

    #[test]
    fn sampling_and_inverting_are_inverse() {
        for (which, table) in examples().iter().enumerate() {
            for k in 0..2500_u32 {
                let u = DVec2::new(f64::from(k % 50) / 50.0, f64::from(k / 50) / 50.0);
                let (p, pdf) = table.sample(u);
                assert!(
                    p.max_element() < 1.0 && p.min_element() >= 0.0,
                    "{which}: {p}"
                );
                assert_close(pdf, table.pdf(p), 1e-9 * (1.0 + pdf), "density");
                // On the edge of the support, where rows have no mass, x says nothing.
                if pdf > 1e-6 {
                    let back = table.invert(p);
                    let error = (back - u).abs().max_element();
                    assert_close(error, 0.0, 1e-12 * (1.0 + pdf), "round trip");
                }
            }
        }
    }

    #[test]
    fn integral_is_that_of_the_values() {
        let c = Piecewise2::constant(2, &[1.0, 2.0, 3.0, 6.0]).unwrap();
        assert_relative(c.integral(), 3.0, 1e-15, "constant");
        let b = Piecewise2::bilinear(2, &[1.0, 2.0, 3.0, 6.0]).unwrap();
        assert_relative(b.integral(), 3.0, 1e-15, "bilinear");
    }

    #[test]
    fn refuses_what_is_no_table() {
        assert!(Piecewise2::constant(3, &[1.0; 7]).is_err());
        assert!(Piecewise2::constant(0, &[]).is_err());
        assert!(Piecewise2::bilinear(5, &[1.0; 5]).is_err());
        assert!(Piecewise2::bilinear(2, &[0.0; 4]).is_err());
    }
}
