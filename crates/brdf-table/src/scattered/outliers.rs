//! Rows without signal: the detector was in the shadow of something, and reads almost nothing.

use crate::scattered::chart::{Point, distance2};
use crate::scattered::cloud::SampleCloud;
use crate::scattered::log_ratio::LogRatio;

/// Neighbours a row is held against.
const NEIGHBOURS: usize = 8;

/// How much darker than its neighbours a row must be.
///
/// In Cornell's garnet red and krylon blue the dead rows (theta_i 80, theta_o 79, 5 to 25 degrees beside the mirror
/// plane) are at least 27 times darker than the median of their neighbours, and all others at most 1.6 times.
const FACTOR: f64 = 8.0;

/// Which rows are dead: far darker than the median of their neighbours, in a bright neighbourhood.
pub(crate) fn dead_rows(cloud: &SampleCloud, points: &[Point], code: &LogRatio) -> Vec<bool> {
    let sizes: Vec<f64> = (0..cloud.len())
        .map(|r| code.size(cloud.values(r)))
        .collect();
    if sizes.len() <= 2 * NEIGHBOURS {
        return vec![false; sizes.len()];
    }
    let typical = median(&mut sizes.clone());
    let mut near: Vec<(f64, usize)> = Vec::with_capacity(points.len());
    let is_dead = |row: usize| {
        near.clear();
        let others = points.iter().enumerate().filter(|&(k, _)| k != row);
        near.extend(others.map(|(k, &p)| (distance2(p, points[row]), k)));
        near.select_nth_unstable_by(NEIGHBOURS, |a, b| a.0.total_cmp(&b.0));
        let mut around: Vec<f64> = near[..NEIGHBOURS].iter().map(|&(_, k)| sizes[k]).collect();
        let around = median(&mut around);
        around > typical && sizes[row] * FACTOR < around
    };
    (0..sizes.len()).map(is_dead).collect()
}

fn median(x: &mut [f64]) -> f64 {
    let middle = x.len() / 2;
    *x.select_nth_unstable_by(middle, f64::total_cmp).1
}
