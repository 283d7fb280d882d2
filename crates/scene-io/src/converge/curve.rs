//! From runs to a curve: errors with intervals, its slope, the time to a target, all with their own errors.

use super::reference::Reference;
use sampling::{Line, jackknife, student_quantile};

/// Confidence of every interval.
pub const CONFIDENCE: f64 = 0.95;
/// A point enters fits if its squared error is known better than this, relatively: beyond it the logarithm is no
/// longer about normal.
const RESOLVED: f64 = 0.5;
/// Points of a curve nearest to the target through which its local line goes.
const NEAR: usize = 4;

/// All runs of a method after the same number of samples.
#[derive(Clone, Debug)]
pub struct Level {
    /// Samples a pixel.
    pub spp: u32,
    /// Seconds by the clock, a run.
    pub seconds: Vec<f64>,
    /// Seconds of processor time, a run.
    pub cpu_seconds: Vec<f64>,
    /// Mean squared distance from the reference, a run.
    pub distances: Vec<f64>,
}

/// One point of a curve.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Samples a pixel.
    pub spp: u32,
    /// Seconds by the clock of one run, mean over runs.
    pub seconds: f64,
    /// Seconds of processor time of one run, mean over runs.
    pub cpu_seconds: f64,
    /// Relative RMSE of one run, the reference's own error taken off; NaN where that leaves nothing.
    pub rel_rmse: f64,
    /// Interval of `rel_rmse`.
    pub ci: [f64; 2],
    /// Whether the error is known well enough for fits.
    pub resolved: bool,
}

/// A number with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

/// A method's error against time.
#[derive(Clone, Debug)]
pub struct Curve {
    /// By time.
    pub points: Vec<Point>,
    /// d ln(error) / d ln(seconds), by weighted least squares over all resolved points.
    pub slope: Option<Known>,
    /// The same against samples a pixel: what theory speaks of, without the costs of starting.
    pub slope_spp: Option<Known>,
    /// The fitted line of `slope`: ln(error) over ln(seconds).
    pub line: Option<Line>,
    levels: Vec<Level>,
}

/// When a curve reaches a target.
#[derive(Clone, Copy, Debug)]
pub struct Reached {
    /// ln(seconds).
    pub ln_seconds: Known,
    /// Whether the target lies outside of the points, on the line continued.
    pub extrapolated: bool,
}

/// Mean over the runs, or all but one.
fn mean(values: &[f64], without: Option<usize>) -> f64 {
    let kept = (values.iter().enumerate()).filter(|(k, _)| Some(*k) != without);
    let (sum, n) = kept.fold((0.0, 0.0), |(s, n), (_, v)| (s + v, n + 1.0));
    sum / n
}

/// Squared error of one run of a level (mean over the runs but one) and the standard error of that over all runs.
fn squared_error(level: &Level, without: Option<usize>, reference: &Reference) -> [f64; 2] {
    let n = level.distances.len() as f64;
    let all = mean(&level.distances, None);
    let spread: f64 = level.distances.iter().map(|d| (d - all).powi(2)).sum();
    let own = spread / (n * (n - 1.0));
    [
        mean(&level.distances, without) - reference.mse,
        (own + reference.mse_error.powi(2)).sqrt(),
    ]
}

fn point(level: &Level, reference: &Reference) -> Point {
    let [square, error] = squared_error(level, None, reference);
    let relative = (square / reference.mean_square).sqrt();
    let runs = u32::try_from(level.distances.len()).unwrap_or(u32::MAX);
    let t = student_quantile(CONFIDENCE, runs.saturating_sub(1));
    let spread = error / square;
    let resolved = square > 0.0 && spread < RESOLVED;
    let ci = if resolved {
        // in the logarithm, which can't leave the positive numbers
        let half = 0.5 * t * spread;
        [relative * (-half).exp(), relative * half.exp()]
    } else {
        let high = (square.max(0.0) + t * error) / reference.mean_square;
        [0.0, high.sqrt()]
    };
    Point {
        spp: level.spp,
        seconds: mean(&level.seconds, None),
        cpu_seconds: mean(&level.cpu_seconds, None),
        rel_rmse: relative,
        ci,
        resolved,
    }
}

impl Curve {
    pub(super) fn new(levels: Vec<Level>, reference: &Reference) -> Self {
        let points: Vec<Point> = levels.iter().map(|l| point(l, reference)).collect();
        let mut curve = Self {
            points,
            slope: None,
            slope_spp: None,
            line: None,
            levels,
        };
        let all = vec![true; curve.points.len()];
        curve.line = curve.fit(reference, None, &all, &seconds);
        curve.slope =
            curve.known(|without| Some(curve.fit(reference, without, &all, &seconds)?.slope));
        curve.slope_spp = curve.known(|without| {
            let spp = |level: &Level, _: Option<usize>| f64::from(level.spp);
            Some(curve.fit(reference, without, &all, &spp)?.slope)
        });
        curve
    }

    /// A number made of all runs, and its error from leaving one out.
    fn known(&self, of: impl Fn(Option<usize>) -> Option<f64>) -> Option<Known> {
        let runs = self.levels.first()?.distances.len();
        Some(Known {
            value: of(None)?,
            error: jackknife(runs, |k| of(Some(k)))?,
        })
    }

    /// The line through the chosen resolved points, ln(error) over ln(x), all runs or without one.
    fn fit(
        &self,
        reference: &Reference,
        without: Option<usize>,
        chosen: &[bool],
        x: &dyn Fn(&Level, Option<usize>) -> f64,
    ) -> Option<Line> {
        let usable = self.levels.iter().zip(&self.points).zip(chosen);
        let points: Vec<[f64; 3]> = usable
            .filter(|((_, p), chosen)| p.resolved && **chosen)
            .map(|((level, _), _)| {
                let [square, error] = squared_error(level, without, reference);
                let y = 0.5 * (square / reference.mean_square).ln();
                [x(level, without).ln(), y, 0.5 * error / square]
            })
            .collect();
        Line::fit(&points)
    }

    /// When this method's error is `target`: on the line through the nearest resolved points.
    #[must_use]
    pub fn reaches(&self, target: f64, reference: &Reference) -> Option<Reached> {
        let away = |p: &Point| (p.rel_rmse / target).ln().abs();
        let mut order: Vec<usize> = (0..self.points.len())
            .filter(|k| self.points[*k].resolved)
            .collect();
        let errors = || order.iter().map(|k| self.points[*k].rel_rmse);
        let (low, high) = (
            errors().fold(f64::INFINITY, f64::min),
            errors().fold(0.0, f64::max),
        );
        order.sort_by(|a, b| away(&self.points[*a]).total_cmp(&away(&self.points[*b])));
        let mut chosen = vec![false; self.points.len()];
        order.iter().take(NEAR).for_each(|k| chosen[*k] = true);
        let ln_seconds = self.known(|without| {
            let line = self.fit(reference, without, &chosen, &seconds)?;
            // a curve that does not fall reaches nothing
            let at = (line.slope < 0.0).then(|| line.solve(target.ln()))?;
            at.is_finite().then_some(at)
        })?;
        Some(Reached {
            ln_seconds,
            extrapolated: !(low..=high).contains(&target),
        })
    }

    /// The smallest resolved error.
    #[must_use]
    pub fn least_error(&self) -> Option<f64> {
        let resolved = self.points.iter().filter(|p| p.resolved);
        resolved.map(|p| p.rel_rmse).min_by(f64::total_cmp)
    }

    /// How many independent runs there are.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.levels.first().map_or(0, |l| l.distances.len())
    }
}

fn seconds(level: &Level, without: Option<usize>) -> f64 {
    mean(&level.seconds, without)
}
