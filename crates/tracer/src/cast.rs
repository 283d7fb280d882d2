//! Rays asked of a scene without rendering it: for other integrators, and to measure ray casting alone.

use crate::math::splat3;
use crate::mode::Mode;
use crate::path::{HitLanes, NONE, RayLanes};
use crate::scene::Scene;
use brdf::LANES;
use glam::Vec3;

/// A ray in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub o: Vec3,
    /// Unit direction.
    pub d: Vec3,
    /// Where it ends at the latest; may be infinite.
    pub t_max: f32,
}

/// What a ray met first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// Distance along the ray.
    pub t: f32,
    /// Index into [`crate::Description::objects`].
    pub object: u32,
}

impl<const N: usize, S: Mode<N>> Scene<N, S> {
    /// What each ray meets first before its `t_max`, into `hits`; as many as the shorter of the two.
    pub fn nearest(&self, rays: &[Ray], hits: &mut [Option<RayHit>]) {
        brdf::arch().dispatch(Nearest {
            scene: self,
            rays,
            hits,
        });
    }
}

/// A stream of rays to be compiled for each instruction set and run with the widest there is.
struct Nearest<'a, const N: usize, S: Mode<N>> {
    scene: &'a Scene<N, S>,
    rays: &'a [Ray],
    hits: &'a mut [Option<RayHit>],
}

impl<const N: usize, S: Mode<N>> pulp::WithSimd for Nearest<'_, N, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<I: pulp::Simd>(self, _: I) {
        let geometry = &self.scene.geometry;
        let (mut lanes, mut met) = (RayLanes::EMPTY, HitLanes::EMPTY);
        for (rays, hits) in self.rays.chunks(LANES).zip(self.hits.chunks_mut(LANES)) {
            (lanes.o, lanes.d) = (splat3(Vec3::ZERO), splat3(Vec3::Z));
            lanes.t_max = [0.0; LANES];
            for (k, ray) in rays.iter().enumerate() {
                lanes.o.set(k, ray.o);
                lanes.d.set(k, ray.d);
                lanes.t_max[k] = ray.t_max;
            }
            geometry.closest(&lanes, &mut met);
            for (k, hit) in hits.iter_mut().enumerate() {
                *hit = (met.prim[k] != NONE).then(|| RayHit {
                    t: met.t[k],
                    object: geometry.object(met.prim[k]),
                });
            }
        }
    }
}
