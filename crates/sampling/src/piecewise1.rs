//! Tabulated densities in one dimension, sampled by inverting their distribution function.

use crate::ONE_MINUS_EPSILON;
use crate::density_error::{DensityError, check, check_sum};

/// A density on [0, 1) given at equal steps: constant in each of n cells, or linear between n nodes.
///
/// `sample` inverts the distribution function exactly, so it is continuous, monotone and keeps strata;
/// [`Self::invert`] is its inverse. A guide table [Chen1974] makes the search a constant expected number of
/// steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Piecewise1 {
    /// Density at the left and the right end of each cell; equal for constant cells.
    ends: Ends,
    /// Distribution function at the left end of each cell, and 1.
    cdf: Vec<f64>,
    /// Entry k: the last cell that starts at or below k / cells.
    guide: Vec<u32>,
    integral: f64,
}

#[derive(Clone, Debug, PartialEq)]
enum Ends {
    Constant(Vec<f64>),
    Linear(Vec<f64>),
}

impl Piecewise1 {
    /// Cell k of n = `values.len()` covers [k/n, (k+1)/n) with density proportional to `values[k]`.
    ///
    /// # Errors
    /// If there are no values, one is negative or not finite, or all are 0.
    pub fn constant(values: &[f64]) -> Result<Self, DensityError> {
        check(values, 1)?;
        Self::build(values, values.to_vec(), Ends::Constant)
    }

    /// Node k of n = `values.len()` >= 2 lies at k/(n-1); the density is linear between nodes.
    ///
    /// # Errors
    /// If there are fewer than two values, one is negative or not finite, or all are 0.
    pub fn linear(values: &[f64]) -> Result<Self, DensityError> {
        check(values, 2)?;
        let means = values.windows(2).map(|w| 0.5 * w[0] + 0.5 * w[1]);
        Self::build(values, means.collect(), Ends::Linear)
    }

    fn build(
        values: &[f64],
        masses: Vec<f64>,
        ends: impl Fn(Vec<f64>) -> Ends,
    ) -> Result<Self, DensityError> {
        let cells = masses.len();
        let sum = check_sum(masses.iter().sum())?;
        let integral = sum / cells as f64;
        let mut cdf = Vec::with_capacity(cells + 1);
        let mut below = 0.0;
        for mass in masses {
            cdf.push((below / sum).min(1.0));
            below += mass;
        }
        cdf.push(1.0);
        Ok(Self {
            ends: ends(values.iter().map(|v| v / integral).collect()),
            guide: guide(&cdf),
            cdf,
            integral,
        })
    }

    /// How many cells there are; at least 1.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cdf.len() - 1
    }

    /// Integral over [0, 1] of the values as given, before they were normalised.
    #[must_use]
    pub fn integral(&self) -> f64 {
        self.integral
    }

    /// Bytes the tables hold.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let (Ends::Constant(values) | Ends::Linear(values)) = &self.ends;
        size_of_val(&values[..]) + size_of_val(&self.cdf[..]) + size_of_val(&self.guide[..])
    }

    /// The point x in [0, 1) below which lies the probability `u` in [0, 1), and the density there.
    ///
    /// The density is 0 only where `u` falls on the edge of the support of a linear table.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: f64) -> (f64, f64) {
        let cell = self.find(u);
        let (left, right) = self.ends(cell);
        let mass = self.cdf[cell + 1] - self.cdf[cell];
        let part = (u - self.cdf[cell]) / mass;
        let t = invert_linear(left, right, part);
        let x = (cell as f64 + t) / self.cells() as f64;
        (x.min(ONE_MINUS_EPSILON), left + (right - left) * t)
    }

    /// The cell that contains the probability `u`; never one without mass.
    #[inline]
    fn find(&self, u: f64) -> usize {
        let n = self.cells();
        let mut cell = self.guide[((u * n as f64) as usize).min(n - 1)] as usize;
        while cell + 1 < n && self.cdf[cell + 1] <= u {
            cell += 1;
        }
        cell
    }

    /// Density at `x`, 0 outside of [0, 1]; at a jump that of the cell to the right.
    #[inline]
    #[must_use]
    pub fn pdf(&self, x: f64) -> f64 {
        if !(0.0..=1.0).contains(&x) {
            return 0.0;
        }
        let (cell, t) = self.locate(x);
        let (left, right) = self.ends(cell);
        left + (right - left) * t
    }

    /// The probability below `x`: the u that `sample` maps to `x`.
    #[inline]
    #[must_use]
    pub fn invert(&self, x: f64) -> f64 {
        let (cell, t) = self.locate(x.clamp(0.0, 1.0));
        let (left, right) = self.ends(cell);
        let (low, high) = (self.cdf[cell], self.cdf[cell + 1]);
        low + (high - low) * part_of_linear(left, right, t)
    }

    #[inline]
    fn ends(&self, cell: usize) -> (f64, f64) {
        match &self.ends {
            Ends::Constant(values) => (values[cell], values[cell]),
            Ends::Linear(nodes) => (nodes[cell], nodes[cell + 1]),
        }
    }

    #[inline]
    fn locate(&self, x: f64) -> (usize, f64) {
        locate(x, self.cells())
    }
}

/// The cell of `cells` that contains `x` in [0, 1], and where in it, [0, 1].
#[inline]
pub(crate) fn locate(x: f64, cells: usize) -> (usize, f64) {
    let scaled = x * cells as f64;
    let cell = (scaled as usize).min(cells - 1);
    (cell, scaled - cell as f64)
}

/// The t in [0, 1] below which lies the fraction `part` of a density linear from `left` to `right`.
///
/// The form 2 y / (l + sqrt(l^2 + 2 (r - l) y)) has no cancellation and no special case for l = r.
#[inline]
pub(crate) fn invert_linear(left: f64, right: f64, part: f64) -> f64 {
    let y = part * (left + right);
    let root = (left * left + (right - left) * y).max(0.0).sqrt();
    let below = left + root;
    if below > 0.0 {
        (y / below).min(1.0)
    } else {
        0.0
    }
}

/// The fraction of a density linear from `left` to `right` that lies below t in [0, 1].
#[inline]
pub(crate) fn part_of_linear(left: f64, right: f64, t: f64) -> f64 {
    let sum = left + right;
    if sum > 0.0 {
        t * (2.0 * left + (right - left) * t) / sum
    } else {
        t
    }
}

/// For each k the last cell that starts at or below k / cells.
fn guide(cdf: &[f64]) -> Vec<u32> {
    let n = cdf.len() - 1;
    let mut cell = 0;
    (0..n)
        .map(|k| {
            let u = k as f64 / n as f64;
            while cell + 1 < n && cdf[cell + 1] <= u {
                cell += 1;
            }
            cell as u32
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::{assert_close, assert_relative};

    fn examples() -> Vec<Piecewise1> {
        let bumpy: Vec<f64> = (0..40).map(|k| f64::from(k * k % 11)).collect();
        let wide: Vec<f64> = (0..33).map(|k| 10_f64.powi(k - 16)).collect();
        vec![
            Piecewise1::constant(&[3.0]).unwrap(),
            Piecewise1::constant(&[0.0, 1.0, 0.0, 5.0, 0.0]).unwrap(),
            Piecewise1::constant(&bumpy).unwrap(),
            Piecewise1::linear(&[0.0, 1.0]).unwrap(),
            Piecewise1::linear(&[1.0, 0.0, 0.0, 2.0]).unwrap(),
            Piecewise1::linear(&bumpy).unwrap(),
            Piecewise1::linear(&wide).unwrap(),
            Piecewise1::constant(&wide).unwrap(),
        ]
    }

    #[test]
    fn sampling_and_inverting_are_inverse() {
        for (which, p) in examples().iter().enumerate() {
            for k in 0..1000 {
                let u = f64::from(k) / 1000.0;
                let (x, pdf) = p.sample(u);
                assert!((0.0..1.0).contains(&x), "{which}: {x}");
                assert!(pdf > 0.0 || k == 0, "{which}: density {pdf} at {x}");
                // rounding of x moves u by pdf * epsilon; the spread example has densities up to 30
                assert_close(p.invert(x), u, 1e-13 * (1.0 + pdf), "round trip");
            }
        }
    }

    #[test]
    fn density_is_the_slope_of_the_distribution() {
        for p in examples() {
            for k in 1..400 {
                // midpoints of a fine grid, away from cell borders
                let (x, h) = ((f64::from(k) + 0.37) / 401.0, 1e-6);
                let slope = (p.invert(x + h) - p.invert(x - h)) / (2.0 * h);
                assert_close(slope, p.pdf(x), 1e-4 * (1.0 + p.pdf(x)), "slope");
            }
        }
    }

    #[test]
    fn integral_is_that_of_the_values() {
        assert_relative(
            Piecewise1::constant(&[1.0, 3.0]).unwrap().integral(),
            2.0,
            1e-15,
            "c",
        );
        assert_relative(
            Piecewise1::linear(&[1.0, 3.0, 3.0]).unwrap().integral(),
            2.5,
            1e-15,
            "l",
        );
    }

    #[test]
    fn zero_cells_are_never_sampled() {
        let p = Piecewise1::constant(&[0.0, 1.0, 0.0, 0.0, 1.0, 0.0]).unwrap();
        for u in [0.0, 0.25, 0.5, 0.75, ONE_MINUS_EPSILON] {
            let (x, pdf) = p.sample(u);
            assert!(pdf > 0.0, "u {u} gives {x}");
        }
    }

    #[test]
    fn refuses_what_is_no_density() {
        assert!(matches!(
            Piecewise1::constant(&[]),
            Err(DensityError::Size { .. })
        ));
        assert!(matches!(
            Piecewise1::linear(&[1.0]),
            Err(DensityError::Size { .. })
        ));
        assert!(matches!(
            Piecewise1::constant(&[1.0, -1.0]),
            Err(DensityError::Value { index: 1, .. })
        ));
        assert!(matches!(
            Piecewise1::constant(&[0.0, 0.0]),
            Err(DensityError::Sum(_))
        ));
        assert!(matches!(
            Piecewise1::constant(&[1e308; 9]),
            Err(DensityError::Sum(_))
        ));
    }
}
