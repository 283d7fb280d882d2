//! The triangle, and the test whether a ray meets it, which is watertight [Woop2013].
//!
//! The corners, relative to the ray's origin, are sheared along the axis where the ray moves most until the ray is that
//! axis. Each corner is rounded once, the same for all triangles that share it: from there on a mesh without gaps is
//! a plane picture without gaps, and the question is which of its triangles hold the origin. [`edge`] is the
//! difference of two products; rounding keeps the order of two numbers, so that its sign is never wrong: it is
//! right, or the result is 0. As 0 counts for either side, every triangle whose picture holds the origin says so,
//! but for those whose picture has no area, whose neighbours hold what it holds. Where all three edges are 0, the same
//! in double precision, which is exact for products of singles, tells a triangle without area from a narrow one.

use glam::{DVec3, Vec3};
use std::ops::{Add, Div, Mul, Sub};

/// A triangle in world space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    pub(crate) corners: [Vec3; 3],
}

/// A ray as triangles see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShearedRay {
    /// Two axes, and the one along which the ray moves most.
    pub(crate) axes: [usize; 3],
    /// The origin by these axes.
    o: [f32; 3],
    /// How far the ray moves along the first two for a step along the third: at most one.
    slope: [f32; 2],
    /// Distance for a step along the third.
    inverse: f32,
}

impl ShearedRay {
    /// The ray `o + t d`.
    #[inline(always)]
    pub(crate) fn new(o: Vec3, d: Vec3) -> Self {
        let (o, d) = (o.to_array(), d.to_array());
        let size = d.map(f32::abs);
        let axes = if size[2] >= size[0] && size[2] >= size[1] {
            [0, 1, 2]
        } else if size[1] >= size[0] {
            [2, 0, 1]
        } else {
            [1, 2, 0]
        };
        let inverse = 1.0 / d[axes[2]];
        Self {
            axes,
            o: [o[axes[0]], o[axes[1]], o[axes[2]]],
            slope: [d[axes[0]] * inverse, d[axes[1]] * inverse],
            inverse,
        }
    }

    /// A corner, given by [`Self::axes`], where the ray is the third axis; for one triangle or several.
    #[inline(always)]
    pub(crate) fn shear<T: Number>(&self, corner: [T; 3]) -> [T; 3] {
        let splat = |x: f32| corner[0].splat(x);
        let z = corner[2] - splat(self.o[2]);
        [
            corner[0] - splat(self.o[0]) - splat(self.slope[0]) * z,
            corner[1] - splat(self.o[1]) - splat(self.slope[1]) * z,
            z,
        ]
    }
}

/// A number of single precision, or several in lanes.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// `x` in every lane.
    fn splat(self, x: f32) -> Self;
    /// The lesser; the second of a NaN and a number.
    fn lesser(self, other: Self) -> Self;
    /// The greater; the second of a NaN and a number.
    fn greater(self, other: Self) -> Self;
    /// `yes` where this is more than 0, else `no`.
    fn if_positive(self, yes: Self, no: Self) -> Self;
    /// `yes` where this is 0, else `no`.
    fn if_zero(self, yes: Self, no: Self) -> Self;
}

impl Number for f32 {
    #[inline(always)]
    fn splat(self, x: f32) -> Self {
        x
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn if_positive(self, yes: Self, no: Self) -> Self {
        if self > 0.0 { yes } else { no }
    }

    #[inline(always)]
    fn if_zero(self, yes: Self, no: Self) -> Self {
        if self == 0.0 { yes } else { no }
    }
}

/// Distance at which a ray meets a triangle with these corners, given by [`ShearedRay::axes`], if more than 0;
/// infinity for none and for corners that are NaN; -1 where single precision can't decide: [`Triangle::distance`] can.
#[inline(always)]
pub(crate) fn meet<T: Number>(ray: &ShearedRay, corners: [[T; 3]; 3]) -> T {
    let [a, b, c] = [
        ray.shear(corners[0]),
        ray.shear(corners[1]),
        ray.shear(corners[2]),
    ];
    let splat = |x: f32| a[0].splat(x);
    let w = [edge(b, c), edge(c, a), edge(a, b)];
    let low = w[0].lesser(w[1]).lesser(w[2]);
    let high = w[0].greater(w[1]).greater(w[2]);
    let sum = w[0] + w[1] + w[2];
    let t = (w[0] * a[2] + w[1] * b[2] + w[2] * c[2]) / sum * splat(ray.inverse);
    let none = splat(f32::INFINITY);
    let met = sum.if_zero(splat(-1.0), t.if_positive(t, none));
    let outside = (splat(0.0) - low).if_positive(none, met);
    high.if_positive(outside, met)
}

/// Twice the area that an edge spans with the ray, seen along it: of `a` to `b` and of `b` to `a` the same but for the sign.
#[inline(always)]
fn edge<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[1] - a[1] * b[0]
}

impl Triangle {
    /// Sheared corners, and [`edge`]s opposite to them without rounding.
    #[inline]
    fn edges(&self, ray: &ShearedRay) -> ([[f32; 3]; 3], [f64; 3]) {
        let corners = self
            .corners
            .map(|c| ray.shear(ray.axes.map(|axis| c[axis])));
        let edge = |i: usize, j: usize| {
            let [a, b] = [corners[i], corners[j]].map(|c| c.map(f64::from));
            a[0] * b[1] - a[1] * b[0]
        };
        (corners, [edge(1, 2), edge(2, 0), edge(0, 1)])
    }

    /// Where a ray meets the inside or the rim; `None` also if it sees the triangle edge-on.
    #[inline(never)]
    pub(crate) fn distance(&self, ray: &ShearedRay) -> Option<f32> {
        let (corners, w) = self.edges(ray);
        let sum = w[0] + w[1] + w[2];
        let inside = w.iter().all(|w| w * sum >= 0.0);
        let along: f64 = (corners.iter().zip(w))
            .map(|(c, w)| f64::from(c[2]) * w)
            .sum();
        let t = (along / sum * f64::from(ray.inverse)) as f32;
        (inside && sum != 0.0 && t > 0.0).then_some(t)
    }

    /// Weights of the corners where the ray meets the plane, summing to one.
    #[inline]
    pub(crate) fn barycentric(&self, ray: &ShearedRay) -> [f32; 3] {
        let (_, w) = self.edges(ray);
        let sum = w[0] + w[1] + w[2];
        if sum == 0.0 {
            return [1.0 / 3.0; 3];
        }
        w.map(|w| (w / sum).clamp(0.0, 1.0) as f32)
    }

    /// Twice the area times the unit normal.
    #[inline]
    pub(crate) fn cross(&self) -> Vec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Cross product of the edges in double precision, where no scene underflows.
    fn exact_cross(&self) -> DVec3 {
        let [a, b, c] = self.corners.map(|c| c.as_dvec3());
        (b - a).cross(c - a)
    }

    /// The area.
    pub(crate) fn area(&self) -> f64 {
        0.5 * self.exact_cross().length()
    }

    /// The unit normal of the front.
    pub(crate) fn normal(&self) -> Vec3 {
        self.exact_cross().normalize_or(DVec3::Z).as_vec3()
    }
}
