//! The maxima and integrals of a [`crate::Rejection`], as plain numbers to be stored.

use crate::known_grid::KnownGrid;

/// What proposals are drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proposal {
    /// Uniform over the hemisphere, as the thesis does.
    Uniform,
    /// In proportion to cos theta_i.
    Cosine,
}

/// Per slice of the viewer direction: a bound on f cos / proposal, and the integral of f cos.
///
/// Slice `k` has elevation k % n_theta and azimuth k / n_theta. Computing it takes 10^4 to 10^5 evaluations a
/// slice; files keep it.
#[derive(Clone, Debug, PartialEq)]
pub struct RejectionCache {
    /// Slices from theta_o = 0 to the horizon.
    pub n_theta: usize,
    /// Slices around; 1 for isotropic targets.
    pub n_phi: usize,
    /// Which proposal the maxima belong to.
    pub proposal: Proposal,
    /// Bound of f cos / proposal density, per slice, in sr; >= 0.
    pub maxima: Vec<f64>,
    /// Integral of f cos over the hemisphere (directional albedo), per slice; >= 0.
    pub integrals: Vec<f64>,
}

/// Why a stored cache cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CacheError {
    /// Fewer than two elevations or no azimuth.
    TooFewSlices,
    /// The lists do not have n_theta * n_phi entries.
    Length {
        /// n_theta * n_phi.
        expected: usize,
        /// The length of the shorter list.
        found: usize,
    },
    /// An entry is negative or not finite, or an integral exceeds its bound.
    Value {
        /// The slice.
        slice: usize,
    },
}

impl std::fmt::Display for CacheError {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::TooFewSlices => write!(out, "a rejection cache needs at least 2 x 1 slices"),
            Self::Length { expected, found } => {
                write!(
                    out,
                    "a rejection cache of {expected} slices has {found} entries"
                )
            }
            Self::Value { slice } => write!(
                out,
                "slice {slice} of the rejection cache: expected 0 <= integral <= maximum, both finite"
            ),
        }
    }
}

impl std::error::Error for CacheError {}

impl RejectionCache {
    /// Checks what a file brought.
    ///
    /// # Errors
    /// [`CacheError`] says what is wrong first.
    pub fn check(&self) -> Result<(), CacheError> {
        if self.n_theta < 2 || self.n_phi < 1 {
            return Err(CacheError::TooFewSlices);
        }
        let expected = self.n_theta.saturating_mul(self.n_phi);
        let found = self.maxima.len().min(self.integrals.len());
        if self.maxima.len() != expected || self.integrals.len() != expected {
            return Err(CacheError::Length { expected, found });
        }
        let bad = |(m, a): (&f64, &f64)| !(m.is_finite() && *a >= 0.0 && a <= m);
        match self.maxima.iter().zip(&self.integrals).position(bad) {
            Some(slice) => Err(CacheError::Value { slice }),
            None => Ok(()),
        }
    }

    pub(crate) fn grid(&self) -> KnownGrid {
        KnownGrid::new(self.n_theta, self.n_phi)
    }
}
