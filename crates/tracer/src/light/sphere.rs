//! The sphere, sampled uniformly in the cone it is seen under.

use super::rect::Toward;
use crate::math::{sin_cos, tangents};
use glam::Vec3;
use std::f32::consts::PI;

/// A sphere that shines outward.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SphereLight {
    pub(crate) center: Vec3,
    pub(crate) radius: f32,
}

impl SphereLight {
    /// Distance to the centre and 1 - cos of the half angle; the latter negative from inside.
    ///
    /// 1 - cos = sin^2 / (1 + cos) keeps its digits for spheres however small or far.
    #[inline(always)]
    fn cone(&self, p: Vec3) -> (Vec3, f32, f32) {
        let to = self.center - p;
        let d2 = to.length_squared();
        let sin2 = self.radius * self.radius / d2;
        let cos = (1.0 - sin2).max(0.0).sqrt();
        let less = sin2 / (1.0 + cos);
        (to, d2, if sin2 < 1.0 { less } else { -1.0 })
    }

    /// A direction toward the sphere from `p`.
    #[inline(always)]
    pub(crate) fn sample(&self, p: Vec3, u: f32, v: f32) -> Toward {
        let (to, d2, max) = self.cone(p);
        let less = u * max;
        let cos = 1.0 - less;
        let sin2 = less * (2.0 - less);
        let (sp, cp) = sin_cos(2.0 * PI * v - PI);
        let d = d2.sqrt();
        let axis = to / d;
        let (s, t) = tangents(axis);
        let sin = sin2.max(0.0).sqrt();
        let near = d * cos - (self.radius * self.radius - d2 * sin2).max(0.0).sqrt();
        Toward {
            wi: s * (cp * sin) + t * (sp * sin) + axis * cos,
            distance: near,
            pdf: density(max),
        }
    }

    /// Density of [`Self::sample`] for a direction from `p` that meets the sphere.
    #[inline(always)]
    pub(crate) fn pdf(&self, p: Vec3) -> f32 {
        density(self.cone(p).2)
    }
}

#[inline(always)]
fn density(max: f32) -> f32 {
    if max > 0.0 {
        1.0 / (2.0 * PI * max)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_meet_the_sphere_from_afar_and_from_near() {
        let light = SphereLight {
            center: Vec3::new(1.0, 2.0, 3.0),
            radius: 0.5,
        };
        for distance in [0.5001, 0.51, 1.0, 30.0, 1e4] {
            let p = light.center - Vec3::new(0.48, 0.6, 0.64) * distance;
            for i in 0..64 {
                let s = light.sample(p, (i % 8) as f32 / 8.0, (i / 8) as f32 / 8.0);
                let q = p + s.wi * s.distance;
                let off = ((q - light.center).length() - 0.5).abs();
                // the rounding of p + wi * distance
                assert!(
                    off < 3e-7 * (distance + 4.0),
                    "{off} off the sphere from {distance}"
                );
            }
            let sin = 0.5 / f64::from(distance);
            let cone = 2.0 * std::f64::consts::PI * (sin * sin / (1.0 + (1.0 - sin * sin).sqrt()));
            let error = f64::from(light.pdf(p)) * cone - 1.0;
            // near the surface the angle hangs on d - r, of which f32 keeps few digits
            assert!(
                error.abs() < if distance < 0.6 { 2e-2 } else { 2e-5 },
                "pdf from {distance}: {error}"
            );
        }
        assert!(light.pdf(light.center).abs() == 0.0, "dark from inside");
    }
}
