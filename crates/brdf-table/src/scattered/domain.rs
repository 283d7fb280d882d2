//! Where a cloud of samples has something to say.

use crate::scattered::cloud::{Geometry, SAME_ANGLE, SampleCloud};
use brdf::HalfDiff;

/// The region the rows of a cloud surround, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// Smallest and largest angle of incidence.
    pub theta_i: [f64; 2],
    /// Smallest and largest angle toward the viewer.
    pub theta_o: [f64; 2],
    /// Smallest angle between the two directions: the detector hides the light within it.
    pub retro: f64,
}

/// On which side of the domain a pair lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    Inside,
    /// In the hole around the incident direction, or steeper than the steepest rows.
    Gap,
    /// More grazing than the most grazing rows.
    Beyond,
}

impl Domain {
    /// Of the rows of `cloud`.
    #[must_use]
    pub fn new(cloud: &SampleCloud) -> Self {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let grow = |r: [f64; 2], x: f64| [r[0].min(x), r[1].max(x)];
        let start = Self {
            theta_i: none,
            theta_o: none,
            retro: f64::INFINITY,
        };
        cloud.geometry().iter().fold(start, |d, g| Self {
            theta_i: grow(d.theta_i, g.theta_i),
            theta_o: grow(d.theta_o, g.theta_o),
            retro: d.retro.min(2.0 * g.half_diff().theta_d),
        })
    }

    /// Whether measured rows surround the pair.
    #[must_use]
    pub fn contains(&self, geometry: Geometry) -> bool {
        self.place(geometry, geometry.half_diff()) == Place::Inside
    }

    pub(crate) fn place(&self, g: Geometry, half_diff: HalfDiff) -> Place {
        let above = |x: f64, r: [f64; 2]| x > r[1] + SAME_ANGLE;
        let below = |x: f64, r: [f64; 2]| x < r[0] - SAME_ANGLE;
        if above(g.theta_i, self.theta_i) || above(g.theta_o, self.theta_o) {
            Place::Beyond
        } else if below(g.theta_i, self.theta_i)
            || below(g.theta_o, self.theta_o)
            || 2.0 * half_diff.theta_d < self.retro - SAME_ANGLE
        {
            Place::Gap
        } else {
            Place::Inside
        }
    }

    /// The most grazing pair within the limits on the path of constant theta_h and phi_d.
    ///
    /// wi.z = R cos(theta_d + delta) and wo.z = R cos(theta_d - delta) with
    /// R e^(i delta) = cos theta_h + i sin theta_h cos phi_d. Where even theta_d = 0 lies beyond, theta_h is
    /// cut to the limit, to which the path tends.
    pub(crate) fn edge(&self, at: HalfDiff) -> HalfDiff {
        let (sin_h, cos_h) = at.theta_h.sin_cos();
        let tilt = sin_h * at.phi_d.cos();
        let (length, delta) = (cos_h.hypot(tilt), tilt.atan2(cos_h));
        let reach = |limit: f64| (limit.cos() / length).min(1.0).acos();
        let theta_d = (reach(self.theta_i[1]) - delta)
            .min(reach(self.theta_o[1]) + delta)
            .clamp(0.0, at.theta_d);
        let theta_h = at.theta_h.min(self.theta_i[1].min(self.theta_o[1]));
        HalfDiff {
            theta_h,
            theta_d,
            phi_d: at.phi_d,
        }
    }
}
