//! Triangles, in barycentric coordinates.

use super::unit;
use glam::{DVec2, DVec3};

/// Barycentric coordinates uniform over a triangle [Turk1990]; density 1 / area.
#[inline]
#[must_use]
pub fn triangle(u: DVec2) -> DVec3 {
    let s = u.x.sqrt();
    let third = u.y * s;
    DVec3::new(1.0 - s, s - third, third)
}

/// The u that [`triangle`] maps to the barycentric coordinates `b`.
#[inline]
#[must_use]
pub fn triangle_inverse(b: DVec3) -> DVec2 {
    let s = b.y + b.z;
    if s > 0.0 {
        unit(DVec2::new(s * s, b.z / s))
    } else {
        DVec2::ZERO
    }
}
