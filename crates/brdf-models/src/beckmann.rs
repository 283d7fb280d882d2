//! Beckmann's distribution of facets [BeckmannSpizzichino1963] and V-shaped grooves made of them [TorranceSparrow1967].

use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, PI};

use crate::half::{Half, from_tan2, reflect};

/// G/(4 ci co) of V-shaped grooves: the part of both beams that the opposite flank leaves, finite at the horizon.
///
/// G = min(1, 2 hz ci/h.wo, 2 hz co/h.wo), and hz/(h.wo) = 2 H.z/|H|^2.
#[inline]
pub(crate) fn grooves(half: &Half, wi: DVec3, wo: DVec3) -> f64 {
    let groove = half.h.z / (half.len2 * wi.z.max(wo.z));
    groove.min(0.25 / (wi.z * wo.z))
}

/// Grooves whose facets have Beckmann's distribution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cavities {
    /// Root mean square slope times sqrt 2, > 0.
    pub(crate) m: f64,
}

impl Cavities {
    /// Beckmann's distribution of normals D(h), 1/sr.
    #[inline]
    pub(crate) fn ndf(&self, half: &Half) -> f64 {
        let tan2 = half.tan2();
        let e = (-tan2 / (self.m * self.m)).exp();
        // at grazing half vectors tan^2 may overflow: the exponential has won long before
        if e > 0.0 {
            let sec2 = 1.0 + tan2;
            e * sec2 * sec2 * FRAC_1_PI / (self.m * self.m)
        } else {
            0.0
        }
    }

    /// A direction mirrored at a facet that the viewer sees [HeitzDEon2014]; it may lie below the horizon.
    pub(crate) fn sample(&self, wo: DVec3, u: DVec2) -> DVec3 {
        let tan2 = -self.m * self.m * (-u.x).ln_1p();
        let sin_o = wo.x.hypot(wo.y);
        let (cx, cy) = if sin_o > 0.0 {
            (wo.x / sin_o, wo.y / sin_o)
        } else {
            (1.0, 0.0)
        };
        // azimuth from the viewer's; the sign from the half of the interval u.y is in
        let s = 2.0 * u.y - 1.0;
        let phi = visible_azimuth(tan2.sqrt() * sin_o / wo.z, s.abs());
        let (sin_phi, cos_phi) = phi.copysign(s).sin_cos();
        let h = from_tan2(
            tan2,
            cx * cos_phi - cy * sin_phi,
            cy * cos_phi + cx * sin_phi,
        );
        reflect(wo, h)
    }

    /// Density of [`Self::sample`], 1/sr; both directions are above the horizon.
    #[inline]
    pub(crate) fn pdf(&self, half: &Half, wo: DVec3) -> f64 {
        // G1 D (h.wo) / co, over 4 (h.wo)
        self.ndf(half) * (half.h.z / half.len2).min(0.25 / wo.z)
    }
}

/// Azimuth in [0, pi] with density clamp(1 + t cos phi, 0, 2) / pi: which facets of a groove the viewer
/// sees, t = tan(theta_o) tan(theta_h).
///
/// Where both flanks are visible the distribution is phi + t sin phi = y, Kepler's equation; Newton's
/// method on it, kept inside its bracket.
fn visible_azimuth(t: f64, u: f64) -> f64 {
    let y = PI * u;
    // for t > 1 one flank hides the other below phi_0 = acos(1/t), and the density is 2 there
    let (phi_0, shift) = if t > 1.0 {
        let phi_0 = (1.0 / t).acos();
        (phi_0, ((t - 1.0) * (t + 1.0)).sqrt() - phi_0)
    } else {
        (0.0, 0.0)
    };
    if y < 2.0 * phi_0 {
        return 0.5 * y;
    }
    let target = y + shift;
    let (mut lo, mut hi) = (phi_0, PI - phi_0);
    let mut phi = (phi_0 + (y - 2.0 * phi_0) / (1.0 + t.min(1.0))).clamp(lo, hi);
    for _ in 0..60 {
        let (sin, cos) = phi.sin_cos();
        let error = phi + t * sin - target;
        if error.abs() <= 4.0 * f64::EPSILON * (target + t) {
            break;
        }
        if error > 0.0 {
            hi = phi;
        } else {
            lo = phi;
        }
        let step = phi - error / (1.0 + t * cos);
        phi = if step > lo && step < hi {
            step
        } else {
            0.5 * (lo + hi)
        };
    }
    phi
}

#[cfg(test)]
mod tests {
    use super::visible_azimuth;
    use std::f64::consts::PI;

    #[test]
    fn azimuth_inverts_its_distribution() {
        for t in [0.0, 1e-9, 0.3, 1.0 - 1e-12, 1.0, 1.5, 40.0, 1e6] {
            for k in 0..=200 {
                let u = f64::from(k) / 200.0;
                let phi = visible_azimuth(t, u);
                let phi_0 = if t > 1.0 { (1.0_f64 / t).acos() } else { 0.0 };
                let cdf = if phi < phi_0 {
                    2.0 * phi
                } else if t > 1.0 {
                    2.0 * phi_0 + phi - phi_0 + t * (phi.sin() - phi_0.sin())
                } else {
                    phi + t * phi.sin()
                };
                // rounding of t sin phi
                assert!(
                    (cdf / PI - u).abs() < 1e-14 * (1.0 + t),
                    "t {t} u {u} phi {phi} cdf {}",
                    cdf / PI
                );
            }
        }
    }
}
