//! Closed-form maps from the unit square, each with its density and its inverse.
//!
//! Points and directions are `glam` vectors in double precision; z is the axis of every lobe. A map takes
//! u in [0, 1)^2, its `_pdf` is the density of the result per its natural measure (solid angle for
//! directions, area for points), its `_inverse` returns u.
//! All maps are continuous but for one seam, so strata of u stay connected.

mod cone;
mod disk;
mod half_vector;
mod hemisphere;
mod sphere;
mod triangle;

pub use cone::{cone, cone_inverse, cone_pdf, one_minus_cos, one_minus_cos_of_sin};
pub use disk::{concentric_disk, concentric_disk_inverse, concentric_disk_pdf};
pub use half_vector::{
    beckmann_half, beckmann_half_inverse, beckmann_half_pdf, blinn_half, blinn_half_inverse,
    blinn_half_pdf, ggx_half, ggx_half_inverse, ggx_half_pdf,
};
pub use hemisphere::{
    cosine_hemisphere, cosine_hemisphere_inverse, cosine_hemisphere_pdf, uniform_hemisphere,
    uniform_hemisphere_inverse, uniform_hemisphere_pdf,
};
pub use sphere::{uniform_sphere, uniform_sphere_inverse, uniform_sphere_pdf};
pub use triangle::{triangle, triangle_inverse};

use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// The unit vector at height 1 - `depth` above the origin and azimuth 2 pi `turn`.
///
/// Telling the depth below the pole instead of z keeps the digits of narrow lobes: r^2 = depth (2 - depth).
#[inline]
fn at_depth(depth: f64, turn: f64) -> DVec3 {
    let r = (depth * (2.0 - depth)).max(0.0).sqrt();
    let (s, c) = (TAU * turn).sin_cos();
    DVec3::new(r * c, r * s, 1.0 - depth)
}

/// 1 - z of a unit vector, without cancellation near the pole.
#[inline]
fn depth(w: DVec3) -> f64 {
    if w.z > 0.0 {
        // At the horizon rounding must not carry it below: callers take ln(1 - depth).
        ((w.x * w.x + w.y * w.y) / (1.0 + w.z)).min(1.0)
    } else {
        1.0 - w.z
    }
}

/// Azimuth as a fraction of a turn, [0, 1).
#[inline]
fn turn(w: DVec3) -> f64 {
    let t = w.y.atan2(w.x) / TAU;
    let t = if t < 0.0 { t + 1.0 } else { t };
    t.min(crate::ONE_MINUS_EPSILON)
}

/// Both coordinates put into [0, 1).
#[inline]
fn unit(u: DVec2) -> DVec2 {
    u.clamp(DVec2::ZERO, DVec2::splat(crate::ONE_MINUS_EPSILON))
}
