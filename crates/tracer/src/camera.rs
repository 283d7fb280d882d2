//! The pinhole camera.

use glam::{DVec3, Vec3};

/// A pinhole camera, given by where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole.
    pub eye: DVec3,
    /// What lies in the middle of the picture.
    pub target: DVec3,
    /// A direction that points up in the picture; not along the line of sight.
    pub up: DVec3,
    /// Angle between the lower and the upper edge of the picture, degrees, in (0, 180).
    pub vertical_fov_deg: f64,
}

/// The camera with the vectors that pixels multiply.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rays {
    pub(crate) eye: Vec3,
    /// Toward the upper left corner of the picture, at unit distance along the line of sight.
    corner: Vec3,
    /// From one pixel to the next, to the right and down.
    dx: Vec3,
    dy: Vec3,
}

impl Camera {
    /// Why the camera can't be used, if it can't.
    pub(crate) fn check(&self) -> Result<(), &'static str> {
        let forward = self.target - self.eye;
        let finite = self.eye.is_finite() && self.target.is_finite() && self.up.is_finite();
        let across = forward
            .normalize_or_zero()
            .cross(self.up.normalize_or_zero());
        let fov = self.vertical_fov_deg > 0.0 && self.vertical_fov_deg < 180.0;
        if !finite {
            Err("eye, target and up must be finite")
        } else if forward == DVec3::ZERO {
            Err("eye and target must differ")
        } else if across.length() < 1e-9 {
            Err("up must not lie along the line of sight")
        } else if !fov {
            Err("vertical field of view must lie in (0, 180) degrees")
        } else {
            Ok(())
        }
    }

    /// The vectors for a picture of `width` x `height` square pixels.
    pub(crate) fn rays(&self, width: u32, height: u32) -> Rays {
        let forward = (self.target - self.eye).normalize();
        let right = forward.cross(self.up).normalize();
        let up = right.cross(forward);
        let half = (self.vertical_fov_deg.to_radians() * 0.5).tan();
        let (w, h) = (f64::from(width), f64::from(height));
        let corner = forward + up * half - right * (half * w / h);
        Rays {
            eye: self.eye.as_vec3(),
            corner: corner.as_vec3(),
            dx: (right * (2.0 * half / h)).as_vec3(),
            dy: (-up * (2.0 * half / h)).as_vec3(),
        }
    }
}

impl Rays {
    /// The unit direction through the picture at (x, y), in pixels from the upper left corner.
    #[inline(always)]
    pub(crate) fn direction(&self, x: f32, y: f32) -> Vec3 {
        (self.corner + self.dx * x + self.dy * y).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn middle_and_edges_point_where_they_should() {
        let camera = Camera {
            eye: DVec3::new(0.0, 2.2, 6.5),
            target: DVec3::new(0.0, 1.0, 0.0),
            up: DVec3::Y,
            vertical_fov_deg: 35.0,
        };
        let rays = camera.rays(640, 480);
        let middle = (camera.target - camera.eye).normalize().as_vec3();
        assert!(
            (rays.direction(320.0, 240.0) - middle).length() < 1e-6,
            "middle"
        );
        let top = rays.direction(320.0, 0.0).dot(middle).acos().to_degrees();
        assert!(
            (top - 17.5).abs() < 1e-3,
            "upper edge at half the field of view: {top}"
        );
        assert!(rays.direction(600.0, 240.0).x > 0.0, "x runs to the right");
        assert!(
            rays.direction(320.0, 10.0).y > rays.direction(320.0, 400.0).y,
            "y runs down"
        );
    }
}
