//! The outcome of a chi-square test, readable in a failed assertion.

use crate::domain::Rect;
use std::fmt;

/// One cell of the domain, or what was not sampled at all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Chart coordinates; `None` for the samples that were declined.
    pub rect: Option<Rect>,
    /// Samples counted.
    pub observed: f64,
    /// Samples the density predicts.
    pub expected: f64,
    /// Quadrature error of `expected`.
    pub uncertainty: f64,
}

impl Cell {
    pub(super) const EMPTY: Self = Self {
        rect: None,
        observed: 0.0,
        expected: 0.0,
        uncertainty: 0.0,
    };

    /// What the cell adds to the statistic; a difference the quadrature can't tell from 0 adds nothing.
    pub(super) fn term(&self) -> f64 {
        let excess = (self.observed - self.expected).abs() - self.uncertainty;
        let excess = if excess < 0.0 { 0.0 } else { excess };
        excess * excess / self.expected.max(1e-9)
    }
}

/// Why a sampler was rejected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The counts contradict the density.
    Distribution,
    /// The density integrates above 1 (or to NaN).
    Integral,
    /// So many samples lie outside of the domain or where the density is 0.
    Stray(usize),
    /// The density is negative or not finite at a sample.
    InvalidDensity {
        /// Where.
        point: [f64; 3],
        /// What it was.
        density: f64,
    },
}

/// The outcome of [`super::test`].
#[derive(Clone, Debug, PartialEq)]
pub struct Chi2Report {
    /// Whether the sampler agrees with its density.
    pub ok: bool,
    /// Why not.
    pub fault: Option<Fault>,
    /// Probability of a statistic at least as large for a correct sampler.
    pub p_value: f64,
    /// The level it was compared with.
    pub level: f64,
    /// Sum of (observed - expected)^2 / expected.
    pub statistic: f64,
    /// Degrees of freedom: pooled cells less one.
    pub dof: usize,
    /// Integral of the density over the domain.
    pub integral: f64,
    /// Fraction of the samples that were declined.
    pub declined: f64,
    /// The cells that add most, largest first.
    pub worst: Vec<Cell>,
}

impl fmt::Display for Chi2Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.fault {
            None => write!(f, "sampler agrees with its density")?,
            Some(fault) => write!(f, "sampler rejected: {fault:?}")?,
        }
        writeln!(
            f,
            "; p = {:.3e} (level {:.3e}), chi2 = {:.2} with {} degrees of freedom, \
             density integrates to {:.6}, declined {:.6}",
            self.p_value, self.level, self.statistic, self.dof, self.integral, self.declined
        )?;
        for cell in &self.worst {
            match cell.rect {
                None => write!(f, "  declined")?,
                Some(r) => write!(
                    f,
                    "  [{:.5}, {:.5}] x [{:.5}, {:.5}]",
                    r.min[0], r.max[0], r.min[1], r.max[1]
                )?,
            }
            writeln!(
                f,
                ": {} samples, {:.2} +- {:.2} expected, adds {:.2}",
                cell.observed,
                cell.expected,
                cell.uncertainty,
                cell.term()
            )?;
        }
        Ok(())
    }
}
