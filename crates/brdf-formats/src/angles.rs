//! The four angles that start each row of a text file, in radians.

use crate::error::{Error, Place};
use std::f64::consts::PI;

/// Room for printed angles: pi rounded up at three decimals is 3.142.
const SLACK: f64 = 1e-3;

/// Refuses finite angles that can't be radians. `names` are the columns' names in the file.
pub(crate) fn check(row: &[f64], names: &[String], place: Place) -> Result<(), Error> {
    let limits = [PI, 2.0 * PI, PI, 2.0 * PI];
    for ((angle, name), limit) in row.iter().zip(names).zip(limits) {
        if angle.abs() > limit + SLACK {
            let expected = format!("an angle in radians, at most {limit:.4}");
            let found = format!("{angle}, which looks like degrees");
            return Err(Error::invalid(place, name, expected, found));
        }
    }
    Ok(())
}
