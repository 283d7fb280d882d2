//! What rejection must know about one slice: the integral of f cos, and how far it rises above the proposal.

use crate::chart::{Chart, ChartPoint};
use glam::DVec2;

/// Radial scale of the quadrature chart: resolves lobes down to a thousandth of a radian.
const R0: f64 = 2e-4;
/// Coarsest and finest radial cell counts; half as many across.
const COARSE: usize = 128;
const FINE: usize = 512;
/// Two levels that agree this well end the doubling.
const TOLERANCE: f64 = 1e-5;
/// Below this change the error is of second order, and extrapolation helps.
const SMOOTH: f64 = 1e-3;
/// Highest cells from which the maximum is climbed to.
const CLIMBERS: usize = 24;
/// Step halvings of a climb: 2^-24 of a cell.
const HALVINGS: usize = 24;

/// Integral over the hemisphere and largest value of `g / proposal`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SliceMeasure {
    pub(crate) integral: f64,
    pub(crate) max_ratio: f64,
}

/// Integrates `g` (f cos at a chart point) and climbs to the maximum of `g / proposal`, for one viewer elevation.
///
/// Midpoint rule on the half-vector chart, doubled until two levels agree, then extrapolated. The maximum is
/// refined from the highest cells by a pattern search, so it does not stop at the grid.
pub(crate) fn measure(
    sin_o: f64,
    cos_o: f64,
    g: &impl Fn(&ChartPoint) -> f64,
    proposal: &impl Fn(&ChartPoint) -> f64,
) -> SliceMeasure {
    let chart = Chart::new(sin_o, cos_o, R0);
    let ratio = |ab: DVec2| {
        let p = chart.forward(ab);
        g(&p) / proposal(&p)
    };
    let mut level = Level::new(COARSE, &chart, g, proposal);
    let mut integral = level.integral;
    while level.n < FINE && level.integral > 0.0 {
        let finer = Level::new(2 * level.n, &chart, g, proposal);
        let change = (finer.integral / level.integral - 1.0).abs();
        integral = finer.integral;
        if change < SMOOTH {
            integral += (finer.integral - level.integral) / 3.0;
        }
        level = finer;
        if change < TOLERANCE {
            break;
        }
    }
    let step = 0.5 / level.n as f64;
    let max_ratio = level
        .best
        .iter()
        .map(|&(value, ab)| climb(ratio, ab, value, step))
        .fold(0.0, f64::max);
    SliceMeasure {
        integral: integral.max(0.0),
        max_ratio,
    }
}

/// One resolution of the quadrature and its highest points.
struct Level {
    n: usize,
    integral: f64,
    /// The highest ratios, ascending.
    best: Vec<(f64, DVec2)>,
}

impl Level {
    fn new(
        n: usize,
        chart: &Chart,
        g: &impl Fn(&ChartPoint) -> f64,
        proposal: &impl Fn(&ChartPoint) -> f64,
    ) -> Self {
        let m = n / 2;
        let (mut sum, mut best) = (0.0, Vec::with_capacity(CLIMBERS + 1));
        for i in 0..n {
            for j in 0..m {
                // a = 1 - x^2 takes away the square-root end at the rim
                let x = (i as f64 + 0.5) / n as f64;
                let ab = DVec2::new(1.0 - x * x, (j as f64 + 0.5) / m as f64);
                let p = chart.forward(ab);
                let value = g(&p);
                sum += 2.0 * x * value * p.jacobian();
                keep_highest(&mut best, (value / proposal(&p), ab));
            }
        }
        Self {
            n,
            integral: sum / (n * m) as f64,
            best,
        }
    }
}

/// Inserts `item` into the ascending list of the [`CLIMBERS`] highest.
fn keep_highest(best: &mut Vec<(f64, DVec2)>, item: (f64, DVec2)) {
    if best.len() == CLIMBERS && item.0 <= best[0].0 {
        return;
    }
    let at = best.partition_point(|b| b.0 < item.0);
    best.insert(at, item);
    if best.len() > CLIMBERS {
        best.remove(0);
    }
}

/// Pattern search [HookeJeeves1961]: steps along both axes, halved when none of them rises. What rose is tried once more from where it
/// led, twice as far each time: ridges that lie across both axes would else be climbed in steps of their own width.
fn climb(ratio: impl Fn(DVec2) -> f64, mut at: DVec2, mut value: f64, mut step: f64) -> f64 {
    let inside = |p: DVec2| p.clamp(DVec2::ZERO, DVec2::ONE);
    let mut halvings = 0;
    while halvings < HALVINGS {
        let start = at;
        for axis in [DVec2::X, DVec2::Y] {
            for d in [step, -step] {
                let p = inside(at + d * axis);
                let v = ratio(p);
                if v > value {
                    (value, at) = (v, p);
                    break;
                }
            }
        }
        let mut stride = at - start;
        if stride == DVec2::ZERO {
            step *= 0.5;
            halvings += 1;
            continue;
        }
        loop {
            let p = inside(at + stride);
            let v = ratio(p);
            if v <= value || p == at {
                break;
            }
            (value, at) = (v, p);
            stride *= 2.0;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::{climb, measure};
    use glam::DVec2;
    use std::cell::Cell;
    use std::f64::consts::PI;

    #[test]
    fn a_ridge_across_both_axes_is_climbed_in_strides() {
        // a ten-thousandth wide and half the square long
        let calls = Cell::new(0);
        let ridge = |p: DVec2| {
            calls.set(calls.get() + 1);
            let (across, along) = ((p.x - p.y) / 1e-4, (p.x + p.y - 1.0) / 0.5);
            (-across * across - along * along).exp()
        };
        let start = DVec2::new(0.2, 0.20003);
        let found = climb(ridge, start, ridge(start), 1e-3);
        assert!(found > 0.999, "{found}");
        assert!(calls.get() < 5000, "{} calls", calls.get());
    }

    #[test]
    fn lambert_has_known_integral_and_maximum() {
        for theta in [0.0_f64, 0.7, 1.4, 1.56] {
            let m = measure(theta.sin(), theta.cos(), &|p| p.wi.z, &|_| 1.0 / (2.0 * PI));
            assert!(
                (m.integral / PI - 1.0).abs() < 3e-5,
                "{theta}: {}",
                m.integral
            );
            assert!(
                (m.max_ratio / (2.0 * PI) - 1.0).abs() < 1e-6,
                "{theta}: {}",
                m.max_ratio
            );
        }
    }

    #[test]
    fn a_narrow_peak_between_grid_points_is_found() {
        // width 1e-3 about the mirror direction of 40 degrees, off the grid's axis
        let theta = 0.7_f64;
        let peak = brdf::direction(theta - 1e-4, PI + 2e-4);
        let m = measure(
            theta.sin(),
            theta.cos(),
            &|p| (-(p.wi - peak).length_squared() / 1e-6).exp(),
            &|_| 1.0,
        );
        assert!((m.max_ratio - 1.0).abs() < 1e-6, "maximum {}", m.max_ratio);
        // int exp(-r^2/w^2) = pi w^2, flat to w^2
        assert!(
            (m.integral / (PI * 1e-6) - 1.0).abs() < 1e-4,
            "integral {}",
            m.integral
        );
    }
}
