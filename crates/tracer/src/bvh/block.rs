//! Triangles of a leaf, tested all at once.

use crate::shape::Triangle;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// Triangles in a leaf: one register of AVX.
pub(super) const WIDTH: usize = 8;

/// Up to [`WIDTH`] triangles, coordinate by coordinate; unused lanes are points, which no ray meets.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
pub(super) struct Block {
    /// Corner, coordinate, lane.
    corners: [[[f32; WIDTH]; 3]; 3],
}

/// A ray as leaves see it.
#[derive(Clone, Copy)]
pub(super) struct LeafRay {
    pub(super) o: [f32; 3],
    pub(super) d: [f32; 3],
}

impl Block {
    /// From one to [`WIDTH`] triangles.
    pub(super) fn new(triangles: impl Iterator<Item = Triangle>) -> Self {
        let mut block = Self {
            corners: [[[0.0; WIDTH]; 3]; 3],
        };
        for (k, triangle) in triangles.take(WIDTH).enumerate() {
            for (into, corner) in block.corners.iter_mut().zip(triangle.corners) {
                for (lanes, x) in into.iter_mut().zip(corner.to_array()) {
                    lanes[k] = x;
                }
            }
        }
        block
    }

    /// The triangle of lane `k`.
    #[inline]
    pub(super) fn triangle(&self, k: usize) -> Triangle {
        Triangle {
            corners: self.corners.map(|c| Vec3::new(c[0][k], c[1][k], c[2][k])),
        }
    }

    /// Distances of the hits with t > 0, infinity for none: the edge volumes of [`Triangle::barycentric`], watertight.
    #[inline(always)]
    pub(super) fn hits(&self, ray: &LeafRay) -> [f32; WIDTH] {
        let mut t = [0.0; WIDTH];
        let c = &self.corners;
        let (o, d) = (ray.o, ray.d);
        for k in 0..WIDTH {
            let v0 = [c[0][0][k] - o[0], c[0][1][k] - o[1], c[0][2][k] - o[2]];
            let v1 = [c[1][0][k] - o[0], c[1][1][k] - o[1], c[1][2][k] - o[2]];
            let v2 = [c[2][0][k] - o[0], c[2][1][k] - o[1], c[2][2][k] - o[2]];
            let w0 = dot(cross(sub(v1, v2), add(v1, v2)), d);
            let w1 = dot(cross(sub(v2, v0), add(v2, v0)), d);
            let w2 = dot(cross(sub(v0, v1), add(v0, v1)), d);
            let low = if w0 < w1 { w0 } else { w1 };
            let low = if low < w2 { low } else { w2 };
            let high = if w0 > w1 { w0 } else { w1 };
            let high = if high > w2 { high } else { w2 };
            let normal = cross(sub(v1, v0), sub(v2, v0));
            let at = dot(v0, normal) / dot(normal, d);
            let met = !((low < 0.0) & (high > 0.0)) & (at > 0.0);
            t[k] = if met { at } else { f32::INFINITY };
        }
        t
    }
}

#[inline(always)]
fn sub(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn add(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f32; 3]; 3]) -> Triangle {
        Triangle {
            corners: corners.map(Vec3::from),
        }
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "infinity means no hit")]
    fn lanes_are_met_on_their_own_and_spare_ones_never() {
        let at = |z: f32| triangle([[-1.0, -1.0, z], [1.0, -1.0, z], [0.0, 1.0, z]]);
        let block = Block::new([at(3.0), at(-2.0), at(5.0)].into_iter());
        let ray = LeafRay {
            o: [0.0, 0.0, 0.0],
            d: [0.0, 0.0, 1.0],
        };
        let t = block.hits(&ray);
        assert!((t[0] - 3.0).abs() < 1e-6, "ahead: {}", t[0]);
        assert!((t[2] - 5.0).abs() < 1e-6, "behind the first: {}", t[2]);
        for k in [1, 3, 4, 5, 6, 7] {
            assert_eq!(t[k], f32::INFINITY, "lane {k}");
        }
        assert_eq!(block.triangle(2).corners, at(5.0).corners, "kept as given");
    }

    #[test]
    fn a_ray_through_a_shared_edge_meets_one_of_its_triangles() {
        let [a, b] = [[-0.3, -0.7, 2.0], [0.9, 1.1, 2.5]];
        let block = Block::new(
            [
                triangle([a, b, [-1.0, 1.0, 2.0]]),
                triangle([b, a, [1.0, -1.0, 2.0]]),
            ]
            .into_iter(),
        );
        let (a, b) = (Vec3::from(a), Vec3::from(b));
        for i in 1..1000_u16 {
            // a point on the edge, rounded
            let p = a + (b - a) * (f32::from(i) / 1000.0);
            let ray = LeafRay {
                o: [0.0; 3],
                d: p.normalize().to_array(),
            };
            let t = block.hits(&ray);
            assert!(t[0].min(t[1]) < 10.0, "slipped through at {p}");
        }
    }
}
