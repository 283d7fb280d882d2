//! A case: a function at its extremes with a reference, and the bound its error must keep.

use crate::tally::Tally;
use rayon::prelude::*;
use std::time::Instant;

/// How fine the grids are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// A part of every grid, ends included: what every test run affords.
    Quick,
    /// Between the two, by the geometric mean: what a slow test affords without optimisation.
    Finer,
    /// All of it.
    Full,
}

impl Effort {
    /// `full` of everything, or `quick` where there is no time. Counts and steps through lists alike.
    #[must_use]
    pub const fn pick(self, quick: usize, full: usize) -> usize {
        match self {
            Self::Quick => quick,
            Self::Finer => (quick * full).isqrt(),
            Self::Full => full,
        }
    }
}

/// Compares a function with its reference over a grid.
type Run = Box<dyn Fn(Effort, &mut Tally) + Send + Sync>;

/// A function, its grid and reference, and what error is allowed.
pub struct Case {
    /// Group/subject/quantity.
    pub name: String,
    /// Largest relative error allowed.
    pub bound: f64,
    /// Why that much.
    pub reason: &'static str,
    run: Run,
}

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Case({}, {:e})", self.name, self.bound)
    }
}

/// The outcome of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the case.
    pub case: String,
    /// What was seen.
    pub tally: Tally,
    /// Largest relative error allowed.
    pub bound: f64,
    /// Why that much.
    pub reason: &'static str,
    /// How long it took.
    pub seconds: f64,
}

impl Row {
    /// Within the bound, and nothing infinite, negative or not a number; and the grid was not empty.
    #[must_use]
    pub fn ok(&self) -> bool {
        let t = &self.tally;
        t.worst <= self.bound && t.nan + t.inf + t.negative == 0 && t.count > 0
    }
}

impl Case {
    /// A case from what runs it.
    pub fn new(
        name: impl Into<String>,
        bound: f64,
        reason: &'static str,
        run: impl Fn(Effort, &mut Tally) + Send + Sync + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            bound,
            reason,
            run: Box::new(run),
        }
    }

    /// Runs the case.
    #[must_use]
    pub fn row(&self, effort: Effort) -> Row {
        let mut tally = Tally::default();
        let start = Instant::now();
        (self.run)(effort, &mut tally);
        Row {
            case: self.name.clone(),
            tally,
            bound: self.bound,
            reason: self.reason,
            seconds: start.elapsed().as_secs_f64(),
        }
    }
}

/// Runs the cases whose name contains `pattern`, in parallel; rows in the order of the cases.
#[must_use]
pub fn run(cases: &[Case], pattern: &str, effort: Effort) -> Vec<Row> {
    cases
        .par_iter()
        .with_max_len(1)
        .filter(|case| case.name.contains(pattern))
        .map(|case| case.row(effort))
        .collect()
}
