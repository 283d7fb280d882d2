//! The unit disk.

use super::unit;
use glam::DVec2;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_4};

/// Points uniform on the unit disk, squares mapped to rings [Shirley1997].
#[inline]
#[must_use]
pub fn concentric_disk(u: DVec2) -> DVec2 {
    let p = 2.0 * u - DVec2::ONE;
    if p == DVec2::ZERO {
        return p;
    }
    if p.x.abs() > p.y.abs() {
        let (s, c) = (FRAC_PI_4 * p.y / p.x).sin_cos();
        p.x * DVec2::new(c, s)
    } else {
        let (s, c) = (FRAC_PI_4 * p.x / p.y).sin_cos();
        p.y * DVec2::new(s, c)
    }
}

/// 1 / pi per unit area.
#[inline]
#[must_use]
pub fn concentric_disk_pdf() -> f64 {
    FRAC_1_PI
}

/// The u that [`concentric_disk`] maps to `p`.
#[inline]
#[must_use]
pub fn concentric_disk_inverse(p: DVec2) -> DVec2 {
    let r = p.length();
    let square = if p.x.abs() > p.y.abs() {
        let a = r.copysign(p.x);
        DVec2::new(a, a * (p.y / p.x).atan() / FRAC_PI_4)
    } else if r > 0.0 {
        let b = r.copysign(p.y);
        DVec2::new(b * (p.x / p.y).atan() / FRAC_PI_4, b)
    } else {
        DVec2::ZERO
    };
    unit(0.5 * (square + DVec2::ONE))
}
