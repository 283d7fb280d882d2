//! The one module that knows obvhs: triangles under an eight-wide compressed BVH [Ylitie2017].

use crate::shape::Triangle;
use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::bvh2_to_cwbvh::bvh2_to_cwbvh;
use obvhs::ploc::PlocBuilder;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle as BoxedTriangle;

/// Triangles in the order of the tree's leaves, so that a leaf reads neighbouring memory.
#[derive(Debug)]
pub(crate) struct Bvh {
    tree: CwBvh,
    triangles: Vec<Triangle>,
}

impl Bvh {
    /// Builds over at least one triangle. Also returns the former index of every triangle in the new order.
    pub(crate) fn new(triangles: &[Triangle]) -> (Self, Vec<u32>) {
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
        ReinsertionOptimizer::default().run(&mut binary, params.reinsertion_batch_ratio, None);
        let tree = bvh2_to_cwbvh(&binary, params.max_prims_per_leaf.clamp(1, 3), true, false);
        let order = tree.primitive_indices.clone();
        let triangles = order.iter().map(|&i| triangles[i as usize]).collect();
        (Self { tree, triangles }, order)
    }

    /// The triangle at `index` in leaf order.
    #[inline]
    pub(crate) fn triangle(&self, index: u32) -> &Triangle {
        &self.triangles[index as usize]
    }

    /// Corners of all triangles.
    pub(crate) fn corners(&self) -> impl Iterator<Item = Vec3> {
        self.triangles.iter().flat_map(|t| t.corners)
    }

    /// The nearest triangle before `t_max` other than `skip`, and its distance.
    #[inline]
    pub(crate) fn closest(&self, o: Vec3, d: Vec3, t_max: f32, skip: u32) -> Option<(f32, u32)> {
        let (o, d) = (Vec3A::from(o), Vec3A::from(d));
        let mut hit = RayHit::none();
        let found = self
            .tree
            .ray_traverse(Ray::new(o, d, 0.0, t_max), &mut hit, |_, id| {
                if id as u32 == skip {
                    f32::INFINITY
                } else {
                    self.triangles[id].hit(o, d)
                }
            });
        found.then_some((hit.t, hit.primitive_id))
    }

    /// Whether any triangle but `skip` and `target` lies before `t_max`.
    #[inline]
    pub(crate) fn blocked(&self, o: Vec3, d: Vec3, t_max: f32, skip: [u32; 2]) -> bool {
        let (o, d) = (Vec3A::from(o), Vec3A::from(d));
        !self
            .tree
            .ray_traverse_miss(Ray::new(o, d, 0.0, t_max), |_, id| {
                if skip.contains(&(id as u32)) {
                    f32::INFINITY
                } else {
                    self.triangles[id].hit(o, d)
                }
            })
    }
}
