//! Straight lines through points of known error, and errors of whatever is computed from independent runs.

/// y = intercept + slope x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// y at x = 0.
    pub intercept: f64,
    /// dy/dx.
    pub slope: f64,
}

impl Line {
    /// The line of least weighted squares through (x, y, standard error of y) [Press2007, 15.2]; `None` unless two
    /// different x are among them. Points whose error is not positive and finite are left out.
    #[must_use]
    pub fn fit(points: &[[f64; 3]]) -> Option<Self> {
        let usable = || {
            points.iter().filter(|[x, y, error]| {
                x.is_finite() && y.is_finite() && *error > 0.0 && error.is_finite()
            })
        };
        let mean = |of: &dyn Fn(&[f64; 3]) -> f64| {
            let weight = |p: &[f64; 3]| p[2].powi(-2);
            let total: f64 = usable().map(weight).sum();
            usable().map(|p| weight(p) * of(p)).sum::<f64>() / total
        };
        let (x, y) = (mean(&|p| p[0]), mean(&|p| p[1]));
        let spread = mean(&|p| (p[0] - x).powi(2));
        let slope = mean(&|p| (p[0] - x) * (p[1] - y)) / spread;
        slope.is_finite().then_some(Self {
            intercept: y - slope * x,
            slope,
        })
    }

    /// y at `x`.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        self.intercept + self.slope * x
    }

    /// Where the line reaches `y`; not finite for a level line.
    #[must_use]
    pub fn solve(&self, y: f64) -> f64 {
        (y - self.intercept) / self.slope
    }
}

/// Standard error of a number that is computed from `runs` independent runs: `leave_out(k)` computes it without run
/// `k`. The jackknife [Efron1981]: it holds for smooth functions of means, whatever is correlated within a run.
///
/// `None` below two runs, or where a number can't be computed.
pub fn jackknife(runs: usize, leave_out: impl Fn(usize) -> Option<f64>) -> Option<f64> {
    if runs < 2 {
        return None;
    }
    let without: Vec<f64> = (0..runs).map(leave_out).collect::<Option<_>>()?;
    let n = runs as f64;
    let mean = without.iter().sum::<f64>() / n;
    let squares: f64 = without.iter().map(|v| (v - mean).powi(2)).sum();
    Some(((n - 1.0) / n * squares).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::{assert_close, assert_relative};

    #[test]
    fn an_exact_line_is_found_whatever_the_weights() {
        let points: Vec<[f64; 3]> = (0..5)
            .map(|k| {
                let x = f64::from(k);
                [x, 3.0 - 0.5 * x, 0.1 + x]
            })
            .collect();
        let line = Line::fit(&points).unwrap();
        assert_close(line.slope, -0.5, 1e-12, "slope");
        assert_close(line.at(2.0), 2.0, 1e-12, "value");
        assert_close(line.solve(1.0), 4.0, 1e-12, "solved");
    }

    #[test]
    fn heavy_points_decide() {
        // two exact points on y = x and one wild one of no weight
        let line = Line::fit(&[[0.0, 0.0, 1e-3], [1.0, 1.0, 1e-3], [2.0, 50.0, 1e6]]).unwrap();
        assert_close(line.slope, 1.0, 1e-6, "slope");
    }

    #[test]
    fn one_abscissa_is_no_line() {
        assert!(Line::fit(&[[1.0, 2.0, 0.1]]).is_none(), "one point");
        assert!(
            Line::fit(&[[1.0, 2.0, 0.1], [1.0, 3.0, 0.1]]).is_none(),
            "two at one x"
        );
        assert!(
            Line::fit(&[[1.0, 2.0, 0.1], [2.0, 3.0, f64::NAN]]).is_none(),
            "one with an error"
        );
    }

    #[test]
    fn the_jackknife_of_a_mean_is_its_standard_error() {
        let values = [1.0, 4.0, 6.0, 9.0];
        let total: f64 = values.iter().sum();
        let found = jackknife(4, |k| Some((total - values[k]) / 3.0)).unwrap();
        // variance (16 + 1 + 1 + 16) / 3, over 4
        assert_relative(found, (34.0_f64 / 12.0).sqrt(), 1e-12, "standard error");
        assert_eq!(jackknife(1, |_| Some(1.0)), None);
    }
}
