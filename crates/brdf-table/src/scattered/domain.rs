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

    /// The pair on the edge that is reached by shrinking theta_h and theta_d by one factor, at constant phi_d.
    ///
    /// With c = cos phi_d, 2 wi.z = (1 + c) cos(theta_h + theta_d) + (1 - c) cos(theta_h - theta_d), and wo.z the
    /// same with -c: both rise as the angles shrink, so that the edge is met once, at an angle that does not vanish,
    /// and depends continuously on the pair. The pair itself where it lies within.
    pub(crate) fn edge(&self, at: HalfDiff) -> HalfDiff {
        let (sum, difference) = (at.theta_h + at.theta_d, at.theta_h - at.theta_d);
        let c = at.phi_d.cos();
        let least = [self.theta_i[1].cos(), self.theta_o[1].cos()];
        // how far above its limit the lower of the two directions is
        let margin = |t: f64| {
            let (a, b) = ((t * sum).cos(), (t * difference).cos());
            let (common, part) = (0.5 * (a + b), 0.5 * c * (a - b));
            (common + part - least[0]).min(common - part - least[1])
        };
        let mut bracket = [(0.0, margin(0.0)), (1.0, margin(1.0))];
        if bracket[1].1 >= 0.0 {
            return at;
        }
        let t = root(&mut bracket, margin);
        HalfDiff {
            theta_h: t * at.theta_h,
            theta_d: t * at.theta_d,
            phi_d: at.phi_d,
        }
    }
}

/// Where the falling `f` crosses 0 between the two ends (x, f(x)): regula falsi by the Illinois rule, which halves the
/// weight of an end that stays.
fn root([low, high]: &mut [(f64, f64); 2], f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 60;
    for _ in 0..STEPS {
        if high.0 - low.0 < 1e-14 || low.1 <= 0.0 {
            break;
        }
        let x = (low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1)).clamp(low.0, high.0);
        let y = f(x);
        if y.abs() < 1e-14 {
            return x;
        }
        if y > 0.0 {
            *low = (x, y);
            high.1 *= 0.5;
        } else {
            *high = (x, y);
            low.1 *= 0.5;
        }
    }
    low.0
}
