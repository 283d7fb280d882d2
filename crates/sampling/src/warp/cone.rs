//! Cones about the z axis, told by 1 - cos of their half angle so that narrow ones keep their digits.

use super::{at_depth, depth, turn, unit};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// 1 - cos(`angle`), radians, without cancellation: 2 sin^2(angle/2).
#[inline]
#[must_use]
pub fn one_minus_cos(angle: f64) -> f64 {
    let s = (0.5 * angle).sin();
    2.0 * s * s
}

/// 1 - cos of the angle in [0, pi/2] whose sine is `sin` (radius over distance of a sphere).
#[inline]
#[must_use]
pub fn one_minus_cos_of_sin(sin: f64) -> f64 {
    let s2 = sin * sin;
    s2 / (1.0 + (1.0 - s2).max(0.0).sqrt())
}

/// Directions uniform within the cone of half angle acos(1 - `max_depth`), 0 < `max_depth` <= 2.
#[inline]
#[must_use]
pub fn cone(u: DVec2, max_depth: f64) -> DVec3 {
    at_depth(u.x * max_depth, u.y)
}

/// 1 / (2 pi (1 - cos)) per steradian inside of the cone.
#[inline]
#[must_use]
pub fn cone_pdf(max_depth: f64) -> f64 {
    1.0 / (TAU * max_depth)
}

/// The u that [`cone`] maps to `w`.
#[inline]
#[must_use]
pub fn cone_inverse(w: DVec3, max_depth: f64) -> DVec2 {
    unit(DVec2::new(depth(w) / max_depth, turn(w)))
}
