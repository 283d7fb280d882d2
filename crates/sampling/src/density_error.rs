//! Why a table can't be a density.

use std::fmt;

/// The values given are not a density.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DensityError {
    /// Fewer values than the shape needs, or not rows times columns of them.
    Size {
        /// How many are needed at least, or exactly for a table.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A value is negative or not finite.
    Value {
        /// Its index.
        index: usize,
        /// The value.
        value: f64,
    },
    /// All values are zero, or their sum is beyond f64.
    Sum(f64),
}

impl fmt::Display for DensityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { expected, found } => {
                write!(f, "a density needs {expected} values, found {found}")
            }
            Self::Value { index, value } => {
                write!(
                    f,
                    "density value {index} is {value}, expected a finite number >= 0"
                )
            }
            Self::Sum(sum) => write!(
                f,
                "density values sum to {sum}, expected a positive finite sum"
            ),
        }
    }
}

impl std::error::Error for DensityError {}

/// The values, if there are at least `least` and each is a finite number >= 0.
pub(crate) fn check(values: &[f64], least: usize) -> Result<(), DensityError> {
    if values.len() < least {
        return Err(DensityError::Size {
            expected: least,
            found: values.len(),
        });
    }
    let bad = |(_, v): &(usize, &f64)| !v.is_finite() || **v < 0.0;
    match values.iter().enumerate().find(bad) {
        Some((index, value)) => Err(DensityError::Value {
            index,
            value: *value,
        }),
        None => Ok(()),
    }
}

/// `sum`, if it can be divided by.
pub(crate) fn check_sum(sum: f64) -> Result<f64, DensityError> {
    // A subnormal sum has lost its digits, and its inverse overflows.
    if sum.is_normal() && sum > 0.0 {
        Ok(sum)
    } else {
        Err(DensityError::Sum(sum))
    }
}
