//! Quadrature over hemispheres and the other [`Domain`]s.

use crate::domain::{Domain, Rect};
use std::f64::consts::PI;

/// The integral of `f` over the hemisphere z > 0, per solid angle, by `n` Gauss-Legendre nodes in z times
/// 2n equal steps of azimuth.
///
/// Exact to rounding for polynomials in the direction up to degree 2n - 1; use [`adaptive`] for
/// narrow lobes.
pub fn hemisphere(f: impl Fn([f64; 3]) -> f64, n: usize) -> f64 {
    let steps = 2 * n;
    let width = 2.0 * PI / steps as f64;
    let mut sum = 0.0;
    for (x, weight) in gauss_legendre(n) {
        let z = 0.5 * (1.0 + x);
        let r = (1.0 - z * z).sqrt();
        // Half a step off the axes: a table whose cells start there is not always hit on its edges.
        let ring: f64 = (0..steps)
            .map(|k| {
                let (s, c) = ((k as f64 + 0.5) * width).sin_cos();
                f([r * c, r * s, z])
            })
            .sum();
        sum += 0.5 * weight * width * ring;
    }
    sum
}

/// Nodes in (-1, 1) and weights of the `n`-point Gauss-Legendre rule, by Newton's method [Press2007, 4.6].
#[must_use]
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let degree = n as f64;
    (0..n)
        .map(|k| {
            let mut x = (PI * (k as f64 + 0.75) / (degree + 0.5)).cos();
            let mut slope = 1.0;
            // Newton from this start converges quadratically; ten steps are far more than enough.
            for _ in 0..10 {
                let (p, previous) = legendre(n, x);
                slope = degree * (x * p - previous) / (x * x - 1.0);
                x -= p / slope;
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// Legendre polynomials of degree n and n - 1 at x.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut p, mut previous) = (1.0, 0.0);
    for j in 0..n {
        let j = j as f64;
        let next = ((2.0 * j + 1.0) * x * p - j * previous) / (j + 1.0);
        previous = p;
        p = next;
    }
    (p, previous)
}

/// An integral and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Estimate {
    /// The integral.
    pub value: f64,
    /// Estimated absolute error.
    pub error: f64,
}

/// The integral of `f` over the whole `domain` to about relative `tolerance`, starting from 8 x 16 pieces.
pub fn adaptive(domain: Domain, f: impl Fn([f64; 3]) -> f64, tolerance: f64) -> Estimate {
    let mut total = Estimate::default();
    let tolerance = Tolerance {
        relative: tolerance,
        absolute: 0.0,
    };
    for piece in grid(domain.chart(), [8, 16]) {
        let e = over_rect(domain, &f, piece, tolerance);
        total.value += e.value;
        total.error += e.error;
    }
    total
}

/// `rect` cut into `n[0]` x `n[1]` equal pieces.
pub(crate) fn grid(rect: Rect, n: [usize; 2]) -> impl Iterator<Item = Rect> {
    let at = move |axis: usize, k: usize| {
        let t = k as f64 / n[axis] as f64;
        rect.min[axis] * (1.0 - t) + rect.max[axis] * t
    };
    (0..n[0] * n[1]).map(move |k| {
        let (i, j) = (k / n[1], k % n[1]);
        Rect {
            min: [at(0, i), at(1, j)],
            max: [at(0, i + 1), at(1, j + 1)],
        }
    })
}

/// Rule evaluations [`over_rect`] may spend on one rectangle before it settles for the error it has.
const BUDGET: usize = 8_000;
/// Halvings done before an estimate is trusted.
const MIN_DEPTH: usize = 2;

/// When refinement may stop: at a change of `relative` times the integral so far, or of `absolute`.
#[derive(Clone, Copy)]
pub(crate) struct Tolerance {
    pub(crate) relative: f64,
    pub(crate) absolute: f64,
}

/// The integral of `f` over a piece of the chart: it is halved along the axis that changes the estimate more,
/// until no halving changes it by more than the tolerance, which shrinks with the pieces.
pub(crate) fn over_rect(
    domain: Domain,
    f: &impl Fn([f64; 3]) -> f64,
    rect: Rect,
    tolerance: Tolerance,
) -> Estimate {
    let first = lobatto(domain, f, &rect);
    let mut stack = vec![(rect, first, 0)];
    let (mut scale, mut spent) = (first.abs(), 1);
    let mut done = Estimate::default();
    while let Some((rect, coarse, depth)) = stack.pop() {
        let splits = [0, 1].map(|axis| {
            let halves = rect.halves(axis);
            let values = halves.map(|half| lobatto(domain, f, &half));
            let fine = values[0] + values[1];
            (halves, values, fine, (fine - coarse).abs())
        });
        spent += 4;
        // Alternating axes on a tie: a function may look constant at first.
        let [along, across] = [&splits[depth % 2], &splits[1 - depth % 2]];
        let (halves, values, fine, change) = if across.3 > along.3 { across } else { along };
        // What the refinement finds raises the scale: a peak missed at first is not refined forever.
        scale = f64::max(scale, done.value.abs() + fine.abs());
        // An edge crosses about 2^(depth/2) pieces, whose errors partly cancel: this keeps their sum bounded.
        let share = (-0.25 * depth as f64).exp2();
        let limit = share * f64::max(tolerance.relative * scale, tolerance.absolute);
        // NaN will not improve, either.
        let unsettled = depth < MIN_DEPTH || *change > limit;
        if !unsettled || spent > BUDGET {
            done.value += fine;
            done.error += change;
        } else {
            stack.extend((0..2).map(|k| (halves[k], values[k], depth + 1)));
        }
    }
    done
}

/// The 4 x 4 Gauss-Lobatto rule on one rectangle. It looks at the borders, too: an edge that runs close to
/// one is not overlooked.
fn lobatto(domain: Domain, f: &impl Fn([f64; 3]) -> f64, rect: &Rect) -> f64 {
    const X: f64 = 0.447_213_595_499_958; // 1 / sqrt(5)
    const NODES: [(f64, f64); 4] = [
        (-1.0, 1.0 / 12.0),
        (-X, 5.0 / 12.0),
        (X, 5.0 / 12.0),
        (1.0, 1.0 / 12.0),
    ];
    let size = rect.size();
    let at = |axis: usize, x: f64| {
        let t = 0.5 * (1.0 + x);
        rect.min[axis] * (1.0 - t) + rect.max[axis] * t
    };
    let mut sum = 0.0;
    for (x, wx) in NODES {
        for (y, wy) in NODES {
            let (p, jacobian) = domain.at([at(0, x), at(1, y)]);
            sum += wx * wy * jacobian * f(p);
        }
    }
    sum * size[0] * size[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::assert_relative;

    #[test]
    fn hemisphere_of_polynomials_is_exact() {
        assert_relative(hemisphere(|_| 1.0, 4), 2.0 * PI, 1e-14, "area");
        assert_relative(hemisphere(|p| p[2], 4), PI, 1e-14, "cosine");
        let f = |p: [f64; 3]| p[0] * p[0] * p[2];
        assert_relative(hemisphere(f, 4), PI / 4.0, 1e-13, "x^2 z");
    }

    #[test]
    fn gauss_legendre_weights_sum_to_two() {
        for n in [1, 2, 5, 64, 200] {
            let sum: f64 = gauss_legendre(n).iter().map(|(_, w)| w).sum();
            assert_relative(sum, 2.0, 1e-13, "sum of weights");
        }
    }

    #[test]
    fn adaptive_finds_a_narrow_lobe() {
        // (n+1)/2pi z^n integrates to 1; n = 10000 is a lobe of 0.6 degrees.
        let n = 10_000.0;
        let lobe = |p: [f64; 3]| (n + 1.0) / (2.0 * PI) * p[2].max(0.0).powf(n);
        let e = adaptive(Domain::Hemisphere, lobe, 1e-6);
        assert_relative(e.value, 1.0, 1e-5, "lobe");
    }

    #[test]
    fn adaptive_meets_an_edge() {
        let step = |p: [f64; 3]| f64::from(u8::from(p[0] + 0.3 * p[1] < 0.5));
        let e = adaptive(Domain::Square, step, 1e-4);
        // area left of x = 0.5 - 0.3 y is 0.5 - 0.15
        assert_relative(e.value, 0.35, 1e-4, "edge");
        assert!(e.error < 1e-3, "{e:?}");
    }
}
