//! A fit from start to end: many starts on few data, the best few on more, the best one on all.

use brdf::Brdf;
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::time::Instant;

use crate::FitError;
use crate::confidence::{Z95, covariance};
use crate::family::{Family, Part};
use crate::levenberg::{Limits, descend};
use crate::metric::Metric;
use crate::problem::{Integrals, Point, Problem};
use crate::samples::Samples;

/// Pairs the many starts see, the best of them see, and the best one sees before all data.
const STAGES: [usize; 3] = [1 << 12, 1 << 14, 1 << 16];
/// How many starts reach the second stage.
const SECOND: usize = 3;

const FIRST_LIMITS: Limits = Limits {
    iterations: 12,
    tolerance: 1e-3,
};
const SECOND_LIMITS: Limits = Limits {
    iterations: 30,
    tolerance: 1e-6,
};
/// On more data the minimum moves by a standard error of the smaller set: a few Gauss-Newton steps reach it.
const THIRD_LIMITS: Limits = Limits {
    iterations: 8,
    tolerance: 1e-10,
};
const LAST_LIMITS: Limits = Limits {
    iterations: 3,
    tolerance: 1e-7,
};

/// A fitted number with its 95 % confidence interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Name in the model's text.
    pub name: String,
    /// Channel of a weight; `None` for a parameter of the shape.
    pub channel: Option<usize>,
    /// The value.
    pub value: f64,
    /// The interval; NaN where the value is held at a bound or the data say nothing about it.
    pub ci: (f64, f64),
}

/// A fitted model.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The family.
    pub name: String,
    /// The metric of [`Self::error`].
    pub metric: Metric,
    /// The error over all data; see [`Metric`].
    pub error: f64,
    /// Parameters of the shape, then weights by name and channel.
    pub estimates: Vec<Estimate>,
    /// The model as a sum of texts.
    pub parts: Vec<Part>,
    /// The shape.
    pub shape: Vec<f64>,
    /// Weights per channel.
    pub weights: Vec<Vec<f64>>,
    /// Time taken.
    pub seconds: f64,
}

/// The data of several fits: all of them, and the subsets the early stages see.
#[derive(Clone, Debug)]
pub struct FitData {
    metric: Metric,
    all: Samples,
    stages: Vec<Samples>,
}

impl FitData {
    /// Draws the subsets.
    #[must_use]
    pub fn new(all: Samples, metric: Metric) -> Self {
        let stages = STAGES.map(|count| all.subset(metric, count)).into();
        Self {
            metric,
            all,
            stages,
        }
    }

    /// The data.
    #[must_use]
    pub fn samples(&self) -> &Samples {
        &self.all
    }

    /// The metric the subsets were drawn for.
    #[must_use]
    pub fn metric(&self) -> Metric {
        self.metric
    }
}

/// Fits one family to the data.
///
/// The same data give the same bits, whatever the number of threads.
///
/// # Errors
/// If there are too few data or nothing but zeros.
pub fn fit(family: &dyn Family, data: &FitData) -> Result<Fit, FitError> {
    let start = Instant::now();
    let on = |samples| Problem {
        family,
        metric: data.metric,
        samples,
    };
    let all = on(&data.all);
    data.all.check(all.unknowns())?;
    let best = search(&on, data).ok_or_else(|| FitError::NoStart {
        model: family.name().into(),
    })?;
    let restart = all.solve(&best.u, Some(&best.weights));
    let (point, normal) = descend(&all, restart, LAST_LIMITS);
    let normal = normal.unwrap_or_else(|| all.normal(&point));
    let covariance = covariance(&all, &point, &normal);
    let seconds = start.elapsed().as_secs_f64();
    Ok(report(&all, &point, &covariance, seconds))
}

/// Fits several families to the same data, in parallel; `done` is told of each as it ends, from any thread.
pub fn fit_all(
    families: &[Box<dyn Family>],
    data: &FitData,
    done: &(dyn Fn(&str, &Result<Fit, FitError>) + Sync),
) -> Vec<Result<Fit, FitError>> {
    (families.par_iter())
        .map(|family| {
            let result = fit(&**family, data);
            done(family.name(), &result);
            result
        })
        .collect()
}

/// The stages before the last.
fn search<'a>(
    on: &(impl Fn(&'a Samples) -> Problem<'a> + Sync),
    data: &'a FitData,
) -> Option<Point> {
    let first = on(&data.stages[0]);
    let mut found: Vec<Point> = starts(first.family)
        .into_par_iter()
        .map(|u| descend(&first, first.solve(&u, None), FIRST_LIMITS).0)
        .collect();
    found.retain(|p| p.cost.is_finite());
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let second = on(&data.stages[1]);
    let mut better: Vec<Point> = distinct(found, SECOND)
        .into_par_iter()
        .map(|p| descend(&second, second.solve(&p.u, Some(&p.weights)), SECOND_LIMITS).0)
        .collect();
    better.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let best = better.into_iter().next()?;
    let third = on(&data.stages[2]);
    let start = third.solve(&best.u, Some(&best.weights));
    Some(descend(&third, start, THIRD_LIMITS).0)
}

/// The first `count` points that are not where an earlier one is already.
fn distinct(points: Vec<Point>, count: usize) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    for point in points {
        let known = |k: &Point| k.u.iter().zip(&point.u).all(|(a, b)| (a - b).abs() < 0.05);
        if kept.len() < count && !kept.iter().any(known) {
            kept.push(point);
        }
    }
    kept
}

/// Largest number of starts: beyond, every combination of starts of single parameters is thinned evenly.
const MAX_STARTS: usize = 16;

/// (sqrt 5 - 1) / 2.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// Combinations of the starts of all parameters, in the iteration's variables.
fn starts(family: &dyn Family) -> Vec<Vec<f64>> {
    let mut all = vec![Vec::new()];
    for parameter in family.shape() {
        all = all
            .into_iter()
            .flat_map(|head: Vec<f64>| {
                parameter.starts.iter().map(move |x| {
                    let mut u = head.clone();
                    u.push(parameter.scale.to_variable(*x));
                    u
                })
            })
            .collect();
    }
    let n = all.len();
    if n <= MAX_STARTS {
        return all;
    }
    // multiples of the golden ratio: evenly spread, and in step with no axis
    (0..MAX_STARTS)
        .map(|k| {
            let at = ((k as f64 + 0.5) * GOLDEN).fract() * n as f64;
            all[(at as usize).min(n - 1)].clone()
        })
        .collect()
}

/// Error, parameters and intervals at the end of a fit.
fn report(problem: &Problem<'_>, point: &Point, covariance: &DMatrix<f64>, seconds: f64) -> Fit {
    let family = problem.family;
    let shape = problem.shape_at(&point.u);
    let deviation = |k: usize| covariance[(k, k)].sqrt();
    let mut estimates: Vec<Estimate> = (family.shape().iter().enumerate())
        .map(|(j, parameter)| {
            // the interval of the variable, brought back: it stays inside the range of the parameter
            let reach = Z95 * deviation(j);
            let end = |u: f64| parameter.scale.to_parameter(u);
            Estimate {
                name: parameter.name.clone(),
                channel: None,
                value: shape[j],
                ci: (end(point.u[j] - reach), end(point.u[j] + reach)),
            }
        })
        .collect();
    let n = family.weights().len();
    for (j, weight) in family.weights().iter().enumerate() {
        for (c, weights) in point.weights.iter().enumerate() {
            let reach = Z95 * deviation(shape.len() + c * n + j);
            estimates.push(Estimate {
                name: weight.name.clone(),
                channel: Some(c),
                value: weights[j],
                ci: (weights[j] - reach, weights[j] + reach),
            });
        }
    }
    Fit {
        name: family.name().into(),
        metric: problem.metric,
        error: problem.metric.error(&problem.sums(point)),
        estimates,
        parts: family.parts(&shape, &point.weights),
        shape,
        weights: point.weights.clone(),
        seconds,
    }
}

/// The error of any reflectance on the data, such as one with published parameters.
pub fn error_of<const N: usize>(model: &dyn Brdf<N>, samples: &Samples, metric: Metric) -> f64 {
    let rows: Vec<_> = samples.iter().collect();
    let blocks: Vec<Integrals> = rows
        .par_chunks(1024)
        .map(|rows| {
            let mut sums = Integrals::new(samples.channels());
            for (pair, values) in rows {
                let m = model.eval(pair.wi, pair.wo);
                let w = pair.weight * metric.measure(pair.wi.z, pair.wo.z);
                for (c, (y, m)) in values.iter().zip(m).enumerate() {
                    sums.add(metric, c, (w, pair.wi.z), (*y, m));
                }
            }
            sums
        })
        .collect();
    metric.error(&Integrals::total(&blocks))
}
