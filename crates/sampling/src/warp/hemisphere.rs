//! Uniform and cosine-weighted directions of the hemisphere z > 0.

use super::{at_depth, concentric_disk, concentric_disk_inverse, turn, unit};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, TAU};

/// Directions uniform in solid angle; u.x tells the height (0 at the horizon), u.y the azimuth.
#[inline]
#[must_use]
pub fn uniform_hemisphere(u: DVec2) -> DVec3 {
    at_depth(1.0 - u.x, u.y)
}

/// 1 / (2 pi) per steradian.
#[inline]
#[must_use]
pub fn uniform_hemisphere_pdf() -> f64 {
    1.0 / TAU
}

/// The u that [`uniform_hemisphere`] maps to `w`.
#[inline]
#[must_use]
pub fn uniform_hemisphere_inverse(w: DVec3) -> DVec2 {
    unit(DVec2::new(w.z, turn(w)))
}

/// Directions proportional to the cosine: a point of the disk, lifted [Malley1988].
#[inline]
#[must_use]
pub fn cosine_hemisphere(u: DVec2) -> DVec3 {
    let p = concentric_disk(u);
    p.extend((1.0 - p.length_squared()).max(0.0).sqrt())
}

/// cos / pi per steradian, from the cosine `z`; 0 below the horizon.
#[inline]
#[must_use]
pub fn cosine_hemisphere_pdf(z: f64) -> f64 {
    z.max(0.0) * FRAC_1_PI
}

/// The u that [`cosine_hemisphere`] maps to `w`.
#[inline]
#[must_use]
pub fn cosine_hemisphere_inverse(w: DVec3) -> DVec2 {
    concentric_disk_inverse(w.truncate())
}
