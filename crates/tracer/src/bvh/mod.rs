//! The one module that knows obvhs: it builds a binary tree over the triangles, which is opened to eight children a
//! node and eight triangles a leaf, each tested in one step [Wald2008].

mod block;
mod lanes;
mod traverse;
mod tree;

use crate::math::{F, U};
use crate::path::{HitLanes, RayLanes};
use crate::shape::{ShearedRay, Triangle};
use block::{Block, WIDTH};
use brdf::{LANES, Pages};
use glam::Vec3;
use lanes::{Lanes8, WIDER};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::PlocBuilder;
use obvhs::triangle::Triangle as BoxedTriangle;
use traverse::{Stack, Tree, TreeRay, slack};
use tree::{Node, Opener};

/// Triangles in blocks, the tree's leaves. The index of a triangle is [`WIDTH`] times its block and its lane.
///
/// They are scaled by a power of two that brings the largest coordinate near one: products of edges of a tiny scene
/// would underflow. Scaling by it is exact.
#[derive(Debug)]
pub(crate) struct Bvh {
    nodes: Pages<Node>,
    blocks: Pages<Block>,
    lanes: Lanes8,
    /// Low and high corner of the box around everything, scaled.
    bounds: [Vec3; 2],
    scale: f32,
    unscale: f32,
}

/// Where a ray met a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrianglePoint {
    pub(crate) p: Vec3,
    /// Unit, on the front.
    pub(crate) normal: Vec3,
    /// Of the corners, summing to one.
    pub(crate) weights: [f32; 3],
    /// The largest coordinates of the corners, by magnitude.
    pub(crate) extent: Vec3,
}

impl Bvh {
    /// Builds over at least one triangle. Also returns the former index of every triangle in the new order,
    /// [`crate::path::NONE`] where a block has a lane to spare.
    pub(crate) fn new(mut triangles: Vec<Triangle>) -> (Self, Vec<u32>) {
        let largest = triangles
            .iter()
            .flat_map(|t| t.corners)
            .map(|c| c.abs().max_element())
            .fold(f32::MIN_POSITIVE, f32::max);
        // both the power and its inverse stay normal numbers
        let exponent = largest.log2().floor().clamp(-125.0, 125.0);
        let (scale, unscale) = ((-exponent).exp2(), exponent.exp2());
        for triangle in &mut triangles {
            triangle.corners = triangle.corners.map(|c| c * scale);
        }
        let wide = Opener::open(&binary_tree(&triangles), &triangles);
        let member = |i: &u32| triangles.get(*i as usize).copied();
        let blocks: Vec<_> = (wide.leaves.iter())
            .map(|leaf| Block::new(leaf.iter().filter_map(member)))
            .collect();
        let none = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        let bvh = Self {
            bounds: wide.nodes.first().map_or(none, Node::bounds),
            nodes: Pages::from(wide.nodes),
            blocks: Pages::from(blocks),
            lanes: Lanes8::detect(),
            scale,
            unscale,
        };
        (bvh, wide.leaves.into_flattened())
    }

    /// Bytes of nodes and leaves.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.blocks)
    }

    /// Triangle `index`, scaled.
    #[inline]
    fn triangle(&self, index: u32) -> Triangle {
        self.blocks[index as usize / WIDTH].triangle(index as usize % WIDTH)
    }

    /// Where the ray `o + t d`, which met triangle `index`, did so.
    #[inline]
    pub(crate) fn point(&self, index: u32, o: Vec3, d: Vec3) -> TrianglePoint {
        let triangle = self.triangle(index);
        let [a, b, c] = triangle.corners;
        let weights = triangle.barycentric(&ShearedRay::new(o * self.scale, d));
        TrianglePoint {
            p: (a * weights[0] + b * weights[1] + c * weights[2]) * self.unscale,
            normal: triangle.cross().normalize_or(Vec3::Z),
            weights,
            extent: a.abs().max(b.abs()).max(c.abs()) * self.unscale,
        }
    }

    /// Along the front normal of triangle `index`; not unit.
    #[inline]
    pub(crate) fn normal(&self, index: u32) -> Vec3 {
        self.triangle(index).cross()
    }

    /// Low and high corner of the box around everything.
    pub(crate) fn bounds(&self) -> [Vec3; 2] {
        self.bounds.map(|corner| corner * self.unscale)
    }

    /// Shortens each ray that is still on its way to the nearest triangle it meets, other than the one it left.
    /// `first` is what the scene adds to the indices of triangles.
    #[inline(always)]
    pub(crate) fn closest(&self, rays: &RayLanes, first: u32, hits: &mut HitLanes) {
        let (tree, mut stack) = (self.tree(), Stack::new());
        let near = self.near(rays, &hits.t);
        for k in 0..LANES {
            if near[k] != 0 {
                let d = rays.d.get(k);
                let ray = TreeRay::new(rays.o.get(k) * self.scale, d);
                let skip = (rays.from[k] >> 1).wrapping_sub(first);
                let met = tree.closest(&ray, hits.t[k] * self.scale, skip, &mut stack);
                if let Some((t, i)) = met {
                    hits.t[k] = t * self.unscale;
                    hits.prim[k] = first + i;
                    hits.back[k] = u32::from(self.normal(i).dot(d) > 0.0);
                }
            }
        }
    }

    /// Sets the lanes of `blocked` whose ray meets a triangle on its way other than the one it left and its target.
    #[inline(always)]
    pub(crate) fn blocked(&self, rays: &RayLanes, first: u32, target: &U, blocked: &mut U) {
        let mut stack = Stack::new();
        let near = self.near(rays, &rays.t_max);
        for k in 0..LANES {
            if blocked[k] == 0 && near[k] != 0 {
                let ray = TreeRay::new(rays.o.get(k) * self.scale, rays.d.get(k));
                let skip = [rays.from[k] >> 1, target[k]].map(|i| i.wrapping_sub(first));
                let t_max = rays.t_max[k] * self.scale;
                blocked[k] = u32::from((self.tree()).blocked(&ray, t_max, skip, &mut stack));
            }
        }
    }

    /// 1 in each lane whose ray may come into the box around everything before `t_max`: the test of a node, so that it
    /// misses no ray that the root does not, for all lanes at once.
    #[inline(always)]
    fn near(&self, rays: &RayLanes, t_max: &F) -> U {
        let o = [&rays.o.x, &rays.o.y, &rays.o.z].map(|axis| axis.map(|x| x * self.scale));
        let d = [&rays.d.x, &rays.d.y, &rays.d.z];
        let [low, high] = self.bounds.map(|corner| corner.to_array());
        let mut out = [0; LANES];
        for k in 0..LANES {
            let size = o[0][k].abs().max(o[1][k].abs()).max(o[2][k].abs());
            let slack = slack(size);
            let (mut enters, mut leaves) = (0.0_f32, t_max[k] * self.scale);
            for axis in 0..3 {
                let inverse = 1.0 / d[axis][k];
                let back = inverse.is_sign_negative();
                let (first, last) = if back {
                    (high[axis], low[axis])
                } else {
                    (low[axis], high[axis])
                };
                let along = slack.copysign(inverse);
                // a NaN bounds nothing
                enters = enters.max((first - (o[axis][k] + along)) * inverse);
                leaves = leaves.min((last - (o[axis][k] - along)) * inverse);
            }
            out[k] = u32::from((t_max[k] > 0.0) & (enters <= leaves * WIDER));
        }
        out
    }

    #[inline(always)]
    fn tree(&self) -> Tree<'_> {
        Tree {
            nodes: &self.nodes,
            blocks: &self.blocks,
            lanes: self.lanes,
        }
    }
}

/// A binary tree over at least one triangle.
fn binary_tree(triangles: &[Triangle]) -> Bvh2 {
    let boxed: Vec<_> = triangles
        .iter()
        .map(|t| BoxedTriangle {
            v0: t.corners[0].into(),
            v1: t.corners[1].into(),
            v2: t.corners[2].into(),
        })
        .collect();
    // obvhs' own helper would validate, and panic, in debug builds
    let params = BvhBuildParams::medium_build();
    let mut binary = PlocBuilder::with_capacity(boxed.len()).build(
        params.ploc_search_distance,
        &boxed,
        (0..boxed.len() as u32).collect(),
        params.sort_precision,
        params.search_depth_threshold,
    );
    drop(boxed);
    ReinsertionOptimizer::default().run(&mut binary, params.reinsertion_batch_ratio, None);
    binary
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::splat3;
    use crate::path::NONE;

    /// Numbers in [-1, 1).
    fn numbers(seed: u64) -> impl FnMut() -> f32 {
        let mut i = seed;
        move || {
            i += 1;
            (crate::math::mix(i) >> 40) as f32 / 8_388_608.0 - 1.0
        }
    }

    /// The nearest of all triangles in double precision, which rounding can mistake where edges are grazed.
    fn brute_force(triangles: &[Triangle], o: Vec3, d: Vec3) -> Option<(f64, usize)> {
        let (o, d) = (o.as_dvec3(), d.as_dvec3());
        let mut best: Option<(f64, usize)> = None;
        for (i, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.corners.map(|c| c.as_dvec3());
            let (e, f) = (b - a, c - a);
            let p = d.cross(f);
            let s = o - a;
            let q = s.cross(e);
            let det = e.dot(p);
            let (u, v, t) = (s.dot(p) / det, d.dot(q) / det, f.dot(q) / det);
            let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0;
            if inside && best.is_none_or(|(b, _)| t < b) {
                best = Some((t, i));
            }
        }
        best
    }

    fn agree_with_brute_force(triangles: &[Triangle], seed: u64) {
        let (bvh, order) = Bvh::new(triangles.to_vec());
        let mut taken: Vec<_> = order.iter().filter(|&&i| i != NONE).collect();
        taken.sort_unstable();
        assert!(
            taken.iter().copied().copied().eq(0..triangles.len() as u32),
            "each once"
        );
        let mut next = numbers(seed);
        let mut point = || Vec3::new(next(), next(), next());
        let mut differ = 0;
        for _ in 0..64 {
            let mut rays = RayLanes::EMPTY;
            rays.o = splat3(point() * 2.0);
            for k in 0..LANES {
                rays.d.set(k, point().normalize_or(Vec3::Z));
            }
            // along an axis: 0 * inf in the slabs
            rays.d.set(0, Vec3::X);
            rays.d.set(1, -Vec3::Y);
            rays.t_max = [f32::INFINITY; LANES];
            let mut hits = HitLanes::EMPTY;
            hits.t = rays.t_max;
            bvh.closest(&rays, 0, &mut hits);
            let mut blocked = [0; LANES];
            bvh.blocked(&rays, 0, &[NONE; LANES], &mut blocked);
            for k in 0..LANES {
                let expected = brute_force(triangles, rays.o.get(k), rays.d.get(k));
                let found = (hits.prim[k] != NONE).then(|| order[hits.prim[k] as usize] as usize);
                assert_eq!(
                    blocked[k] != 0,
                    found.is_some(),
                    "a shadow ray sees what others see"
                );
                let same = match (expected, found) {
                    (Some((t, _)), Some(_)) => (t - f64::from(hits.t[k])).abs() < 1e-4 * t.max(0.1),
                    (None, None) => true,
                    _ => false,
                };
                differ += usize::from(!same);
            }
        }
        // edges grazed within rounding: a handful of 1024
        assert!(differ <= 3, "{differ} of 1024 rays differ");
    }

    #[test]
    fn rays_meet_what_a_search_through_all_triangles_finds() {
        for n in [1, 2, 7, 8, 9, 65, 1000] {
            let mut next = numbers(n);
            let mut point = |size: f32| Vec3::new(next(), next(), next()) * size;
            let triangles: Vec<_> = (0..n)
                .map(|_| {
                    let at = point(1.0);
                    Triangle {
                        corners: [at, at + point(0.3), at + point(0.3)],
                    }
                })
                .collect();
            agree_with_brute_force(&triangles, 77 + n);
        }
    }

    #[test]
    fn trees_that_would_be_too_deep_are_cut_even() {
        // each triangle is a third of the one before, around one corner: every cut sheds a single one
        let triangles: Vec<_> = (0..70_u8)
            .flat_map(|i| {
                let size = (-f32::from(i)).exp2();
                (0..4_u8).map(move |j| {
                    let turn = |a: u8| {
                        let phi = f32::from(a) * std::f32::consts::FRAC_PI_2;
                        Vec3::new(phi.cos(), phi.sin(), 0.3) * size
                    };
                    Triangle {
                        corners: [turn(j), turn(j + 1), Vec3::Z * (0.5 * size)],
                    }
                })
            })
            .collect();
        agree_with_brute_force(&triangles, 5);
    }
}
