//! Pearson's chi-square test of a direction sampler against its density.
//!
//! A pilot run of the sampler cuts the domain into cells that follow its density, so narrow lobes are
//! resolved; fresh samples are then counted per cell and compared with the integral of the density over
//! each. The pilot only chooses the cells, so the test is exact whatever it found.
//! What the sampler declines (`None`) is a cell of its own, expected as often as the density falls short
//! of 1: a lost or doubled factor shows there.

mod cells;
mod report;

use crate::domain::Domain;
use crate::integrate::{Estimate, Tolerance, over_rect};
use crate::significance::sidak;
use crate::special::chi2_tail;
use cells::Cells;
pub use report::{Cell, Chi2Report, Fault};

/// What to test and how hard.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Where the samples lie.
    pub domain: Domain,
    /// Samples counted; a quarter more is drawn for the pilot.
    pub samples: usize,
    /// Probability of rejecting a correct sampler, over all `tests` together.
    pub level: f64,
    /// How many chi-square tests share `level` [Sidak1967].
    pub tests: usize,
}

impl Default for Config {
    /// 100 000 samples over the hemisphere, level 0.01, one test.
    fn default() -> Self {
        Self {
            domain: Domain::Hemisphere,
            samples: 100_000,
            level: 0.01,
            tests: 1,
        }
    }
}

/// Relative accuracy of the integral of the density over one cell. It may add at most samples x 1e-8
/// to the statistic, whose own spread is sqrt(2 x cells).
const CELL_TOLERANCE: f64 = 1e-4;

/// Absolute accuracy of the expectation of one cell, in samples: far below its spread of 2 and more.
const CELL_SAMPLES: f64 = 0.01;

/// By how much a density may integrate above 1 before it is refused, beyond its quadrature error.
const EXCESS: f64 = 2e-3;

/// Fraction of samples that may have density 0 or lie outside: rounding at the edge of the support.
const STRAY: f64 = 2e-5;

/// Compares `sample` (`None`: nothing sampled) with the density `pdf` it claims, per the measure of the
/// domain.
///
/// The report is the verdict: whoever asserts its `ok` takes the report as the message. `sample` brings its own
/// random numbers.
pub fn test(
    config: &Config,
    mut sample: impl FnMut() -> Option<[f64; 3]>,
    pdf: impl Fn([f64; 3]) -> f64,
) -> Chi2Report {
    let domain = config.domain;
    let pilot: Vec<[f64; 2]> = (0..config.samples / 4)
        .filter_map(|_| sample())
        .map(|p| domain.to_chart(p))
        .collect();
    let mut cells = Cells::build(domain, pilot);
    let tolerance = Tolerance {
        relative: CELL_TOLERANCE,
        absolute: CELL_SAMPLES / config.samples as f64,
    };
    let integrals: Vec<Estimate> = cells
        .rects()
        .iter()
        .map(|rect| over_rect(domain, &pdf, *rect, tolerance))
        .collect();
    let count = count(config, &mut cells, sample, &pdf);
    judge(config, &cells, &integrals, &count)
}

/// What counting found beside the cells.
struct Count {
    declined: usize,
    stray: usize,
    bad_pdf: Option<([f64; 3], f64)>,
}

fn count(
    config: &Config,
    cells: &mut Cells,
    mut sample: impl FnMut() -> Option<[f64; 3]>,
    pdf: impl Fn([f64; 3]) -> f64,
) -> Count {
    let mut count = Count {
        declined: 0,
        stray: 0,
        bad_pdf: None,
    };
    for _ in 0..config.samples {
        let Some(p) = sample() else {
            count.declined += 1;
            continue;
        };
        let density = pdf(p);
        if !density.is_finite() || density < 0.0 {
            count.bad_pdf = Some((p, density));
        }
        if density == 0.0 || !config.domain.contains(p) {
            count.stray += 1;
        }
        cells.add(config.domain.to_chart(p));
    }
    count
}

fn judge(config: &Config, cells: &Cells, integrals: &[Estimate], count: &Count) -> Chi2Report {
    let n = config.samples as f64;
    let integral: f64 = integrals.iter().map(|e| e.value).sum();
    let error = integrals
        .iter()
        .map(|e| e.error.powi(2))
        .sum::<f64>()
        .sqrt();
    let mut table: Vec<Cell> = cells
        .rects()
        .iter()
        .zip(cells.counts())
        .zip(integrals)
        .map(|((rect, observed), e)| Cell {
            rect: Some(*rect),
            observed: *observed as f64,
            expected: n * e.value,
            uncertainty: n * e.error,
        })
        .collect();
    table.push(Cell {
        rect: None,
        observed: count.declined as f64,
        expected: n * (1.0 - integral).max(0.0),
        uncertainty: n * error,
    });
    let pooled = pool(&table);
    let statistic = pooled.iter().map(Cell::term).sum();
    let dof = pooled.len().saturating_sub(1);
    let p_value = if dof == 0 {
        1.0
    } else {
        chi2_tail(statistic, dof as f64)
    };
    let level = sidak(config.level, config.tests);
    let fault = fault(integral, error, n, count).or_else(|| {
        // A NaN statistic is a rejection, too.
        let agrees = p_value >= level;
        (!agrees).then_some(Fault::Distribution)
    });
    table.sort_by(|a, b| b.term().total_cmp(&a.term()));
    table.truncate(8);
    Chi2Report {
        ok: fault.is_none(),
        fault,
        p_value,
        level,
        statistic,
        dof,
        integral,
        declined: count.declined as f64 / n,
        worst: table,
    }
}

fn fault(integral: f64, error: f64, n: f64, count: &Count) -> Option<Fault> {
    if let Some((point, density)) = count.bad_pdf {
        return Some(Fault::InvalidDensity { point, density });
    }
    if count.stray as f64 > STRAY * n {
        return Some(Fault::Stray(count.stray));
    }
    let sound = integral <= 1.0 + EXCESS + error;
    (!sound).then_some(Fault::Integral)
}

/// Joins cells, rarest first, until each group expects at least 5 samples, as the chi-square
/// approximation asks [Cochran1954]. The grouping depends on the expectation alone.
fn pool(table: &[Cell]) -> Vec<Cell> {
    let mut sorted = table.to_vec();
    sorted.sort_by(|a, b| a.expected.total_cmp(&b.expected));
    let mut groups = Vec::new();
    let mut group = Cell::EMPTY;
    for cell in sorted {
        group.observed += cell.observed;
        group.expected += cell.expected;
        group.uncertainty = group.uncertainty.hypot(cell.uncertainty);
        if group.expected >= 5.0 {
            groups.push(std::mem::replace(&mut group, Cell::EMPTY));
        }
    }
    // Only if nothing at all is expected: then what was observed has nowhere to go but against it.
    if groups.is_empty() {
        groups.push(group);
    }
    groups
}
