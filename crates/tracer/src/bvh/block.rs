//! Triangles of a leaf, tested all at once.

use super::lanes::Lanes8;
use crate::shape::{ShearedRay, Triangle};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// Triangles in a leaf: one register of AVX.
pub(super) const WIDTH: usize = 8;

/// Up to [`WIDTH`] triangles, coordinate by coordinate; unused lanes are NaN, which no ray meets.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
pub(super) struct Block {
    /// Corner, coordinate, lane.
    corners: [[[f32; WIDTH]; 3]; 3],
}

impl Block {
    /// From one to [`WIDTH`] triangles.
    pub(super) fn new(triangles: impl Iterator<Item = Triangle>) -> Self {
        let mut block = Self {
            corners: [[[f32::NAN; WIDTH]; 3]; 3],
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

    /// Distances of the hits with t > 0, infinity for none, less than 0 where [`Self::distance`] has to be asked.
    #[inline(always)]
    pub(super) fn hits(&self, lanes: Lanes8, ray: &ShearedRay) -> [f32; WIDTH] {
        // a map over an array, unlike what stands here, is not compiled for the instruction set of its caller
        let [x, y, z] = ray.axes;
        let [a, b, c] = &self.corners;
        lanes.meet(
            ray,
            [
                [&a[x], &a[y], &a[z]],
                [&b[x], &b[y], &b[z]],
                [&c[x], &c[y], &c[z]],
            ],
        )
    }

    /// The distance that lane `k` of [`Self::hits`] stands for; in double precision where that one could not decide.
    #[inline(always)]
    pub(super) fn distance(&self, k: usize, hit: f32, ray: &ShearedRay) -> f32 {
        if hit < 0.0 {
            self.triangle(k).distance(ray).unwrap_or(f32::INFINITY)
        } else {
            hit
        }
    }
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
        let ray = ShearedRay::new(Vec3::ZERO, Vec3::Z);
        let t = block.hits(Lanes8::detect(), &ray);
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
            let ray = ShearedRay::new(Vec3::ZERO, p.normalize());
            let t = block.hits(Lanes8::detect(), &ray);
            assert!(t[0].min(t[1]) < 10.0, "slipped through at {p}");
        }
    }

    #[test]
    fn a_ray_through_a_corner_meets_one_of_the_triangles_around_it() {
        let mut slipped = 0;
        for i in 0..20_000_u64 {
            let number = |j: u64| (crate::math::mix(16 * i + j) >> 40) as f32 / 8_388_608.0 - 1.0;
            let o = Vec3::new(number(0), number(1), number(2)) * 0.4;
            let corner = o + Vec3::new(number(3), number(4), number(5)) + Vec3::Z * 2.0;
            let around = |k: u64| {
                let phi = (k % 6) as f32 * std::f32::consts::TAU / 6.0;
                let height = 0.1 * number(6 + k % 6);
                corner + Vec3::new(phi.cos(), phi.sin(), height) * 0.2
            };
            let fan = (0..6).map(|k| Triangle {
                corners: [corner, around(k), around(k + 1)],
            });
            let d = (corner.as_dvec3() - o.as_dvec3()).normalize().as_vec3();
            let t = Block::new(fan).hits(Lanes8::detect(), &ShearedRay::new(o, d));
            slipped += usize::from(!t.iter().any(|t| *t < 10.0));
        }
        assert_eq!(slipped, 0, "of 20,000 rays through corners");
    }
}
