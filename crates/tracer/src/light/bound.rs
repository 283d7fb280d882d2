//! What a group of lights can send out: a ball around them, a cone around their normals, and how strong they are.

use crate::math::F;
use brdf::{LANES, Lanes3};
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// A bound on lights whose lobes are cosines about normals, or even all around.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bound {
    low: Vec3,
    high: Vec3,
    /// Unit axis of the cone that holds all normals.
    axis: Vec3,
    /// Its half angle; pi for lights that shine all around.
    angle: f32,
    /// Along the axis of a lobe: brightness times area, summed over the lights.
    intensity: f32,
}

impl Bound {
    /// Of nothing.
    pub(crate) const NONE: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
        axis: Vec3::Z,
        angle: 0.0,
        intensity: 0.0,
    };

    /// Of a flat light within two corners of a box.
    pub(crate) fn facing(corners: [Vec3; 2], normal: Vec3, intensity: f32) -> Self {
        Self::new(corners, (normal, 0.0), intensity)
    }

    /// Of a light that shines alike all around.
    pub(crate) fn all_around(corners: [Vec3; 2], intensity: f32) -> Self {
        Self::new(corners, (Vec3::Z, PI), intensity)
    }

    fn new([low, high]: [Vec3; 2], (axis, angle): (Vec3, f32), intensity: f32) -> Self {
        Self {
            low,
            high,
            axis,
            angle,
            intensity,
        }
    }

    /// Of all of `bounds`.
    pub(crate) fn of<'a>(bounds: impl Iterator<Item = &'a Self>) -> Self {
        bounds.fold(Self::NONE, |all, one| all.and(one))
    }

    pub(crate) fn and(&self, other: &Self) -> Self {
        if self.is_none() {
            return *other;
        }
        if other.is_none() {
            return *self;
        }
        let corners = [self.low.min(other.low), self.high.max(other.high)];
        let cone = join((self.axis, self.angle), (other.axis, other.angle));
        Self::new(corners, cone, self.intensity + other.intensity)
    }

    /// The same extent and cone, but lobes that carry `power` in all.
    pub(crate) fn of_power(self, power: f64) -> Self {
        let over = if self.angle < PI { PI } else { 4.0 * PI };
        Self {
            intensity: (power / f64::from(over)) as f32,
            ..self
        }
    }

    fn is_none(&self) -> bool {
        self.low.x > self.high.x
    }

    pub(crate) fn center(&self) -> Vec3 {
        0.5 * (self.low + self.high)
    }

    /// Half the diagonal, squared; grown a little, so that rounding hides no light.
    fn radius2(&self) -> f32 {
        0.25 * (self.high - self.low).length_squared() * 1.001
    }

    /// Sine and cosine of the cone's half angle.
    fn sin_cos(&self) -> (f32, f32) {
        let (sin, cos) = self.angle.sin_cos();
        (sin, if self.angle < PI { cos } else { -1.0 })
    }

    /// Intensity times extent times spread of directions: what a split should make small [ContyEstevez2018].
    pub(crate) fn cost(&self) -> f32 {
        if self.intensity > 0.0 {
            self.intensity * self.radius2() * self.spread()
        } else {
            0.0
        }
    }

    /// Solid angle of the cone, and of the cosine lobes beyond it weighed by how they fall off.
    fn spread(&self) -> f32 {
        let (sin, cos) = self.sin_cos();
        let widest = (self.angle + FRAC_PI_2).min(PI);
        let beyond =
            2.0 * widest * sin - (self.angle - 2.0 * widest).cos() - 2.0 * self.angle * sin + cos;
        TAU * (1.0 - cos) + FRAC_PI_2 * beyond
    }

    /// What [`BoundLanes::importances`] says of one.
    #[cfg(test)]
    pub(crate) fn importance(&self, p: Vec3) -> f32 {
        BoundLanes::new(&[*self]).importances(p)[0]
    }
}

/// Up to [`LANES`] bounds, asked together.
#[derive(Clone, Debug)]
pub(crate) struct BoundLanes {
    center: Lanes3,
    radius2: F,
    axis: Lanes3,
    sin: F,
    cos: F,
    intensity: F,
}

impl BoundLanes {
    /// Spare lanes are dark.
    pub(crate) fn new(bounds: &[Bound]) -> Self {
        let mut all = Self {
            center: Lanes3::ZERO,
            radius2: [0.0; LANES],
            axis: Lanes3::ZERO,
            sin: [0.0; LANES],
            cos: [-1.0; LANES],
            intensity: [0.0; LANES],
        };
        for (k, bound) in bounds.iter().take(LANES).enumerate() {
            all.center.set(k, bound.center());
            all.radius2[k] = bound.radius2();
            all.axis.set(k, bound.axis);
            (all.sin[k], all.cos[k]) = bound.sin_cos();
            all.intensity[k] = bound.intensity;
        }
        all
    }

    /// About what comes to `p` from each, up to a factor that all bounds share; 0 only where nothing does.
    #[inline(always)]
    pub(crate) fn importances(&self, p: Vec3) -> F {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            let to = p - self.center.get(k);
            let (d2, r2) = (to.length_squared(), self.radius2[k]);
            // the mean of 1 / d^2 over a ball is 3 / r^2 in its middle
            let near = d2.max(r2 * (1.0 / 3.0)).max(f32::MIN_POSITIVE);
            let at_most = (self.intensity[k] / near).min(f32::MAX / 64.0);
            let cos = (self.axis.get(k).dot(to) / d2.sqrt()).clamp(-1.0, 1.0);
            let sin = (1.0 - cos * cos).sqrt();
            let sin2_u = (r2 / d2).min(1.0);
            let (sin_u, cos_u) = (sin2_u.sqrt(), (1.0 - sin2_u).sqrt());
            let (sin, cos) = less((sin, cos), (self.sin[k], self.cos[k]));
            let (_, cos) = less((sin, cos), (sin_u, cos_u));
            // within the ball, or lobes all around: every angle is 0 for some light
            let everywhere = (d2 <= r2) | (self.cos[k] <= -1.0);
            out[k] = at_most * if everywhere { 1.0 } else { cos.max(0.0) };
        }
        out
    }
}

/// Sine and cosine of max(0, a - b), for angles in [0, pi].
#[inline(always)]
fn less(a: (f32, f32), b: (f32, f32)) -> (f32, f32) {
    if a.1 >= b.1 {
        (0.0, 1.0)
    } else {
        (a.0 * b.1 - a.1 * b.0, a.1 * b.1 + a.0 * b.0)
    }
}

/// The least cone around two.
fn join(a: (Vec3, f32), b: (Vec3, f32)) -> (Vec3, f32) {
    let ((wide, a), (narrow, b)) = if a.1 >= b.1 { (a, b) } else { (b, a) };
    let between = wide.angle_between(narrow);
    if (between + b).min(PI) <= a {
        return (wide, a);
    }
    let angle = 0.5 * (a + between + b);
    let across = wide.cross(narrow);
    if angle >= PI || across.length_squared() < 1e-12 {
        return (wide, PI);
    }
    let turn = glam::Quat::from_axis_angle(across.normalize(), angle - a);
    // the rounding of angles must not leave a normal outside
    ((turn * wide).normalize(), (angle + 1e-4).min(PI))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::mix;

    fn number(i: u64) -> f32 {
        (mix(i) >> 40) as f32 / 8_388_608.0 - 1.0
    }

    fn direction(i: u64) -> Vec3 {
        Vec3::new(number(i), number(i + 1), number(i + 2)).normalize_or(Vec3::X)
    }

    #[test]
    fn a_joined_cone_holds_both() {
        for i in 0..2000 {
            let [a, b, d] = [0, 3, 6].map(|k| direction(20 * i + k));
            let wide = 0.8 * (number(20 * i + 9) + 1.0);
            let (axis, angle) = join((a, wide), (b, 0.0));
            assert!(axis.angle_between(b) <= angle + 1e-3, "{a} {b}");
            // an edge of the wide cone
            let side = (d - a * a.dot(d)).normalize_or(a.any_orthonormal_vector());
            let edge = a * wide.cos() + side * wide.sin();
            assert!(axis.angle_between(edge) <= angle + 1e-3, "{a} {b} {edge}");
        }
    }

    /// A group's bound is at least what its members send, each by its own bound.
    #[test]
    fn a_group_sends_at_least_what_its_members_do() {
        for i in 0..500 {
            let group: Vec<_> = (0..5)
                .map(|k| {
                    let at = direction(100 * i + 10 * k) * 0.3;
                    let normal = direction(100 * i + 10 * k + 3);
                    Bound::facing([at, at], normal, 1.0)
                })
                .collect();
            let all = Bound::of(group.iter());
            let p = direction(100 * i + 77) * 3.0;
            // distances: members are at most 0.3 from the origin, the centre at most as far
            let (near, far) = (2.7_f32, 3.3_f32);
            let sum: f32 = group.iter().map(|b| b.importance(p)).sum();
            let scale = (far / near).powi(2);
            assert!(
                all.importance(p) * scale >= sum * 0.999,
                "{} for {sum}",
                all.importance(p)
            );
        }
    }

    #[test]
    fn a_flat_light_is_dark_behind_and_brightest_ahead() {
        let light = Bound::facing([Vec3::ZERO; 2], Vec3::Z, 2.0);
        let at = |x: f32, z: f32| light.importance(Vec3::new(x, 0.0, z));
        assert!((at(0.0, 2.0) - 0.5).abs() < 1e-6, "ahead: {}", at(0.0, 2.0));
        let slanted = at(1.0, 1.0);
        assert!(
            (slanted - 2.0 / 2.0 * 0.5_f32.sqrt()).abs() < 1e-6,
            "{slanted}"
        );
        assert!(at(0.3, -1.0) == 0.0, "behind");
        assert!(at(0.0, 0.0).is_finite(), "in the light");
    }
}
