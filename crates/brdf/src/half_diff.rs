//! Half and difference angles [Rusinkiewicz1998], in the form that keeps its digits everywhere.

use glam::DVec3;

/// Rusinkiewicz' angles of a pair of directions, isotropic part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfDiff {
    /// Polar angle of the half vector, [0, pi/2].
    pub theta_h: f64,
    /// Angle between either direction and the half vector, [0, pi/2].
    pub theta_d: f64,
    /// Azimuth of the difference vector about the half vector, (-pi, pi]; swapping wi and wo adds pi.
    pub phi_d: f64,
}

impl HalfDiff {
    /// The angles of `wi`, `wo` (unit, both above the horizon). No `acos`, no normalisation: h' = wi + wo,
    /// d' = wi - wo, so that each angle keeps its relative precision near 0 and pi/2.
    ///
    /// At theta_h = 0 the azimuth of h is taken as 0; at theta_d = 0, phi_d is 0.
    #[inline]
    #[must_use]
    pub fn new(wi: DVec3, wo: DVec3) -> Self {
        let h = wi + wo;
        let h_xy = h.x.hypot(h.y);
        let (cos_phi_h, sin_phi_h) = if h_xy > 0.0 {
            (h.x / h_xy, h.y / h_xy)
        } else {
            (1.0, 0.0)
        };
        let h_len = h_xy.hypot(h.z);
        let (s, c) = if h_len > 0.0 {
            (h_xy / h_len, h.z / h_len)
        } else {
            (0.0, 1.0)
        };
        // d = wi rotated by -phi_h about z, then by -theta_h about y
        let along = wi.x * cos_phi_h + wi.y * sin_phi_h;
        let d_x = c * along - s * wi.z;
        let d_y = wi.y * cos_phi_h - wi.x * sin_phi_h;
        Self {
            theta_h: h_xy.atan2(h.z),
            theta_d: (wi - wo).length().atan2(h_len),
            phi_d: d_y.atan2(d_x),
        }
    }

    /// A pair (wi, wo) with these angles, the half vector in the plane phi = 0.
    ///
    /// Either may lie below the horizon.
    #[inline]
    #[must_use]
    pub fn directions(self) -> (DVec3, DVec3) {
        let (sh, ch) = self.theta_h.sin_cos();
        let (sd, cd) = self.theta_d.sin_cos();
        let (sp, cp) = self.phi_d.sin_cos();
        let (dx, dy, dz) = (sd * cp, sd * sp, cd);
        let wi = DVec3::new(ch * dx + sh * dz, dy, ch * dz - sh * dx);
        let wo = DVec3::new(sh * dz - ch * dx, -dy, ch * dz + sh * dx);
        (wi, wo)
    }
}

/// The unit vector at polar angle `theta` and azimuth `phi`, radians.
#[inline]
#[must_use]
pub fn direction(theta: f64, phi: f64) -> DVec3 {
    let (s, c) = theta.sin_cos();
    DVec3::new(s * phi.cos(), s * phi.sin(), c)
}
