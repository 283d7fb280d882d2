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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// The smallest turn between two azimuths.
    fn turn(a: f64, b: f64) -> f64 {
        (a - b + PI).rem_euclid(2.0 * PI) - PI
    }

    proptest! {
        #[test]
        fn angles_and_directions_are_inverse(h in 1e-6..1.5, d in 1e-6..1.5, p in -3.1..3.1_f64) {
            let angles = HalfDiff { theta_h: h, theta_d: d, phi_d: p };
            let (wi, wo) = angles.directions();
            let back = HalfDiff::new(wi, wo);
            // a direction carries 1e-16, which an angle of 1e-6 sees as 1e-10 of itself; phi_d as 1e-16/(h d)
            prop_assert!((back.theta_h - h).abs() < 1e-14 && (back.theta_d - d).abs() < 1e-14, "{back:?}");
            prop_assert!(turn(back.phi_d, p).abs() < 1e-14 / (h * d).min(1.0) + 1e-13, "{back:?}");
        }

        #[test]
        fn swapping_adds_pi(ti in 0.01..1.5, to in 0.01..1.5, p in -3.0..3.0_f64) {
            let (wi, wo) = (direction(ti, 0.3), direction(to, 0.3 + p));
            let (a, b) = (HalfDiff::new(wi, wo), HalfDiff::new(wo, wi));
            prop_assert!((a.theta_h - b.theta_h).abs() < 1e-14 && (a.theta_d - b.theta_d).abs() < 1e-14, "{a:?} {b:?}");
            prop_assume!(a.theta_d > 1e-3 && a.theta_h > 1e-3);
            prop_assert!(turn(a.phi_d, b.phi_d + PI).abs() < 1e-9, "{a:?} {b:?}");
        }
    }

    #[test]
    fn poles_and_horizon_are_finite() {
        let z = DVec3::Z;
        assert_eq!(
            HalfDiff::new(z, z),
            HalfDiff {
                theta_h: 0.0,
                theta_d: 0.0,
                phi_d: 0.0
            }
        );
        let x = DVec3::X;
        let opposite = HalfDiff::new(x, -x);
        assert!(
            (opposite.theta_d - FRAC_PI_2).abs() < 1e-15 && opposite.phi_d.is_finite(),
            "{opposite:?}"
        );
        let grazing = HalfDiff::new(
            direction(FRAC_PI_2 - 1e-9, 0.0),
            direction(FRAC_PI_2 - 1e-9, PI),
        );
        assert!(grazing.theta_h.abs() < 1e-6, "mirror pair: {grazing:?}");
    }

    #[test]
    fn small_angles_keep_their_digits() {
        // acos would return 0 or 2e-8 here
        let near = HalfDiff::new(direction(1e-9, 0.0), direction(3e-9, 0.0));
        assert!((near.theta_h / 2e-9 - 1.0).abs() < 1e-12, "{near:?}");
        assert!((near.theta_d / 1e-9 - 1.0).abs() < 1e-7, "{near:?}");
    }
}
