//! Triangles that shine together: one is chosen by area, then a point on it; also the parallelogram, as two of them.

use super::bound::Bound;
use super::rect::Toward;
use crate::shape::Triangle;
use glam::Vec3;

/// One-sided triangles of one radiance.
#[derive(Clone, Debug)]
pub(crate) struct TriangleLight {
    triangles: Vec<Triangle>,
    /// Unit front normals.
    normals: Vec<Vec3>,
    /// Primitive each triangle belongs to.
    prims: Vec<u32>,
    /// Areas up to and with each triangle, over the total.
    cdf: Vec<f32>,
    area: f32,
}

impl TriangleLight {
    /// From triangles with the primitives they belong to. `None` when their area is zero.
    pub(crate) fn new(triangles: Vec<Triangle>, prims: Vec<u32>) -> Option<Self> {
        let mut sum = 0.0_f64;
        let sums: Vec<f64> = triangles
            .iter()
            .map(|t| {
                sum += t.area();
                sum
            })
            .collect();
        (sum > 0.0).then(|| Self {
            normals: triangles.iter().map(Triangle::normal).collect(),
            triangles,
            prims,
            cdf: sums.iter().map(|s| (s / sum) as f32).collect(),
            area: sum as f32,
        })
    }

    /// Says that all triangles are parts of primitive `prim`.
    pub(crate) fn belong_to(&mut self, prim: u32) {
        self.prims.fill(prim);
    }

    /// Around all triangles, which send out `power` together.
    pub(crate) fn bound(&self, power: f64) -> Bound {
        let all = self.triangles.iter().zip(&self.normals).map(|(t, normal)| {
            let [a, b, c] = t.corners;
            Bound::facing([a.min(b).min(c), a.max(b).max(c)], *normal, 1.0)
        });
        let all = all.fold(Bound::NONE, |all, one| all.and(&one));
        all.of_power(power)
    }

    /// The total area.
    pub(crate) fn area(&self) -> f32 {
        self.area
    }

    /// A point of the light as seen from `p`, and the primitive it lies on.
    #[inline]
    pub(crate) fn sample(&self, p: Vec3, u: f32, v: f32) -> (Toward, u32) {
        let i = self
            .cdf
            .partition_point(|&c| c <= u)
            .min(self.cdf.len() - 1);
        let below = if i > 0 { self.cdf[i - 1] } else { 0.0 };
        // what is left of u is uniform again
        let u = ((u - below) / (self.cdf[i] - below)).clamp(0.0, 1.0);
        let [a, b, c] = self.triangles[i].corners;
        let root = u.sqrt();
        let q = a * (1.0 - root) + b * (root * (1.0 - v)) + c * (root * v);
        let to = q - p;
        let d2 = to.length_squared();
        let distance = d2.sqrt();
        let wi = to / distance;
        let toward = Toward {
            wi,
            distance,
            pdf: self.pdf(self.normals[i], wi, distance),
        };
        (toward, self.prims[i])
    }

    /// Density of [`Self::sample`] for a point at `distance` along `wi` where the front normal is `normal`.
    #[inline]
    pub(crate) fn pdf(&self, normal: Vec3, wi: Vec3, distance: f32) -> f32 {
        let cos = -normal.dot(wi);
        if cos > 0.0 {
            distance * distance / (self.area * cos)
        } else {
            0.0
        }
    }
}
