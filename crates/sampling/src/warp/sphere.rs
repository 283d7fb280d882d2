//! The whole sphere.

use super::{at_depth, depth, turn, unit};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Directions uniform over the sphere; u.x tells the depth below the pole, u.y the azimuth.
#[inline]
#[must_use]
pub fn uniform_sphere(u: DVec2) -> DVec3 {
    at_depth(2.0 * u.x, u.y)
}

/// 1 / (4 pi) per steradian.
#[inline]
#[must_use]
pub fn uniform_sphere_pdf() -> f64 {
    0.25 / PI
}

/// The u that [`uniform_sphere`] maps to `w`.
#[inline]
#[must_use]
pub fn uniform_sphere_inverse(w: DVec3) -> DVec2 {
    unit(DVec2::new(0.5 * depth(w), turn(w)))
}
