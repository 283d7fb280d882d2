//! The half vector without normalisation: every ratio the models need, free of cancellation.

use glam::DVec3;

/// Directions lower than this count as below the horizon, so that no fourth power of a cosine underflows
/// and every value stays finite. Far under anything a renderer or an instrument can tell from the horizon.
pub(crate) const MIN_COS: f64 = 1e-60;

/// True when light can go from `wi` to `wo`.
#[inline]
pub(crate) fn above(wi: DVec3, wo: DVec3) -> bool {
    wi.z > MIN_COS && wo.z > MIN_COS
}

/// H = wi + wo.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Half {
    /// H, not of unit length.
    pub(crate) h: DVec3,
    /// |H|^2 = 2 (1 + wi.wo).
    pub(crate) len2: f64,
    /// |wi - wo|^2 = 2 (1 - wi.wo).
    apart2: f64,
}

impl Half {
    /// `None` unless both directions are above the horizon.
    #[inline]
    pub(crate) fn new(wi: DVec3, wo: DVec3) -> Option<Self> {
        above(wi, wo).then(|| {
            let h = wi + wo;
            Self {
                h,
                len2: h.length_squared(),
                apart2: (wi - wo).length_squared(),
            }
        })
    }

    /// tan^2 of the angle between half vector and normal.
    #[inline]
    pub(crate) fn tan2(&self) -> f64 {
        self.tan2_over(1.0, 1.0)
    }

    /// ((h.x/ax)^2 + (h.y/ay)^2) / h.z^2: tan^2 over the squared roughness, elliptically.
    #[inline]
    pub(crate) fn tan2_over(&self, ax: f64, ay: f64) -> f64 {
        let (x, y) = (self.h.x / (ax * self.h.z), self.h.y / (ay * self.h.z));
        x * x + y * y
    }

    /// Cosine between the half vector and either direction: |H| / 2, because |wi| = |wo|.
    #[inline]
    pub(crate) fn cos_d(&self) -> f64 {
        (0.5 * self.len2.sqrt()).min(1.0)
    }

    /// Squared sine of that angle, |wi - wo|^2 / 4: 1 - cos^2 has no digits left near the pole.
    #[inline]
    pub(crate) fn sin2_d(&self) -> f64 {
        (0.25 * self.apart2).min(1.0)
    }
}

/// `wo` mirrored at the microfacet normal `h` (unit).
#[inline]
pub(crate) fn reflect(wo: DVec3, h: DVec3) -> DVec3 {
    2.0 * wo.dot(h) * h - wo
}

/// The unit vector with tan(theta) = sqrt(`tan2`) and azimuth (`cos_phi`, `sin_phi`).
#[inline]
pub(crate) fn from_tan2(tan2: f64, cos_phi: f64, sin_phi: f64) -> DVec3 {
    let z = 1.0 / (1.0 + tan2).sqrt();
    let s = tan2.sqrt() * z;
    DVec3::new(s * cos_phi, s * sin_phi, z)
}
