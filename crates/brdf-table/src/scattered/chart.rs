//! Coordinates in which a glossy lobe stands still while the light moves.

use crate::scattered::cloud::Geometry;
use brdf::HalfDiff;

/// A point of the chart.
pub(crate) type Point = [f64; 3];

/// Width in radians of the region around the mirror direction that is drawn apart.
const LOBE: f64 = 0.2;

/// (1.5 ln(1 + theta_h / 0.2), theta_d, (theta_i - theta_o) / 4).
///
/// One-to-one up to bilateral symmetry: theta_h and theta_d give cos theta_i + cos theta_o, the third
/// coordinate their difference, and these the azimuth. Theta_h is stretched near 0, where glossy lobes change
/// fastest, and the third coordinate, which carries what is not reciprocal, is shortened; the three constants
/// were chosen by leaving rings out of both Cornell RGB files (docs/interpolation.md).
#[inline]
pub(crate) fn point(geometry: Geometry, half_diff: HalfDiff) -> Point {
    [
        1.5 * (half_diff.theta_h / LOBE).ln_1p(),
        half_diff.theta_d,
        (geometry.theta_i - geometry.theta_o) / 4.0,
    ]
}

/// [`point`] of a row.
pub(crate) fn of_row(geometry: Geometry) -> Point {
    point(geometry, geometry.half_diff())
}

/// Squared distance.
#[inline]
pub(crate) fn distance2(a: Point, b: Point) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// The index of the nearest of `points`, 0 if there is none.
pub(crate) fn nearest(points: &[Point], to: Point) -> usize {
    let better = |best: (usize, f64), (i, &p): (usize, &Point)| {
        let d = distance2(p, to);
        if d < best.1 { (i, d) } else { best }
    };
    points.iter().enumerate().fold((0, f64::INFINITY), better).0
}
