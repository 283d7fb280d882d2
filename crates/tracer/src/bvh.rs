//! The one module that knows obvhs: triangles under an eight-wide compressed BVH [Ylitie2017].

use crate::shape::Triangle;
use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::bvh2_to_cwbvh::bvh2_to_cwbvh;
use obvhs::ploc::PlocBuilder;
use obvhs::ray::{Ray, RayHit};

/// By how much boxes are larger than their triangles, in units in which the largest coordinate lies in [1, 2).
///
/// The tree tests a box as (p - o)/d + q e/d: for rays that run along a face the two cancel and leave the rounding of their
/// terms, 6e-8 of coordinates up to 4 and of their sum. Without the margin such rays slip past flat boxes.
const PAD: f32 = 8.0 * f32::EPSILON;

/// Triangles in the order of the tree's leaves, so that a leaf reads neighbouring memory.
///
/// They are scaled by a power of two that brings the largest coordinate near one: the tree's quantisation has absolute
/// limits, and products of edges of a tiny scene would underflow. Scaling by it is exact.
#[derive(Debug)]
pub(crate) struct Bvh {
    tree: CwBvh,
    triangles: Vec<Triangle>,
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
    /// Builds over at least one triangle. Also returns the former index of every triangle in the new order.
    pub(crate) fn new(triangles: &[Triangle]) -> (Self, Vec<u32>) {
        let largest = triangles
            .iter()
            .flat_map(|t| t.corners)
            .map(|c| c.abs().max_element())
            .fold(f32::MIN_POSITIVE, f32::max);
        // both the power and its inverse stay normal numbers
        let exponent = largest.log2().floor().clamp(-125.0, 125.0);
        let (scale, unscale) = ((-exponent).exp2(), exponent.exp2());
        let triangles: Vec<_> = triangles
            .iter()
            .map(|t| Triangle {
                corners: t.corners.map(|c| c * scale),
            })
            .collect();
        let boxed: Vec<_> = triangles
            .iter()
            .map(|t| {
                let corners = t.corners.map(Vec3A::from);
                let low = corners[0].min(corners[1]).min(corners[2]);
                let high = corners[0].max(corners[1]).max(corners[2]);
                Aabb::new(low - PAD, high + PAD)
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
        ReinsertionOptimizer::default().run(&mut binary, params.reinsertion_batch_ratio, None);
        let tree = bvh2_to_cwbvh(&binary, params.max_prims_per_leaf.clamp(1, 3), true, false);
        let order = tree.primitive_indices.clone();
        let triangles = order.iter().map(|&i| triangles[i as usize]).collect();
        let bvh = Self {
            tree,
            triangles,
            scale,
            unscale,
        };
        (bvh, order)
    }

    /// Where the ray `o + t d`, which met triangle `index`, did so.
    #[inline]
    pub(crate) fn point(&self, index: u32, o: Vec3, d: Vec3) -> TrianglePoint {
        let triangle = &self.triangles[index as usize];
        let [a, b, c] = triangle.corners;
        let weights = triangle.barycentric(o * self.scale, d);
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
        self.triangles[index as usize].cross()
    }

    /// Corners of all triangles.
    pub(crate) fn corners(&self) -> impl Iterator<Item = Vec3> {
        let unscale = self.unscale;
        self.triangles
            .iter()
            .flat_map(move |t| t.corners.map(|c| c * unscale))
    }

    /// The nearest triangle before `t_max` other than `skip`, and its distance.
    #[inline]
    pub(crate) fn closest(&self, o: Vec3, d: Vec3, t_max: f32, skip: u32) -> Option<(f32, u32)> {
        let (o, d) = (Vec3A::from(o * self.scale), Vec3A::from(d));
        let mut hit = RayHit::none();
        let found = self.tree.ray_traverse(
            Ray::new(o, d, 0.0, t_max * self.scale),
            &mut hit,
            |_, id| {
                if id as u32 == skip {
                    f32::INFINITY
                } else {
                    self.triangles[id].hit(o, d)
                }
            },
        );
        found.then_some((hit.t * self.unscale, hit.primitive_id))
    }

    /// Whether any triangle but `skip` and `target` lies before `t_max`.
    #[inline]
    pub(crate) fn blocked(&self, o: Vec3, d: Vec3, t_max: f32, skip: [u32; 2]) -> bool {
        let (o, d) = (Vec3A::from(o * self.scale), Vec3A::from(d));
        !self
            .tree
            .ray_traverse_miss(Ray::new(o, d, 0.0, t_max * self.scale), |_, id| {
                if skip.contains(&(id as u32)) {
                    f32::INFINITY
                } else {
                    self.triangles[id].hit(o, d)
                }
            })
    }
}
