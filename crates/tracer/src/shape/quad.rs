//! The parallelogram.

use crate::path::{HitLanes, RayLanes};
use brdf::LANES;
use glam::Vec3;

/// A parallelogram in world space: corner + u edge_u + v edge_v, u and v in [0, 1].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quad {
    pub(crate) corner: Vec3,
    /// Unit, along edge_u x edge_v: the front.
    pub(crate) normal: Vec3,
    /// Dual basis: `dual_u . (p - corner)` is u.
    pub(crate) dual_u: Vec3,
    pub(crate) dual_v: Vec3,
}

impl Quad {
    /// Distance of the hit of lane `k`, infinity for none; and whether it is on the back.
    #[inline(always)]
    fn hit(&self, rays: &RayLanes, k: usize, id: u32) -> (f32, bool) {
        let (n, du, dv) = (self.normal, self.dual_u, self.dual_v);
        let (rx, ry, rz) = (
            rays.o.x[k] - self.corner.x,
            rays.o.y[k] - self.corner.y,
            rays.o.z[k] - self.corner.z,
        );
        let (dx, dy, dz) = (rays.d.x[k], rays.d.y[k], rays.d.z[k]);
        let along = n.x * dx + n.y * dy + n.z * dz;
        let t = -(n.x * rx + n.y * ry + n.z * rz) / along;
        let (px, py, pz) = (rx + t * dx, ry + t * dy, rz + t * dz);
        let u = du.x * px + du.y * py + du.z * pz;
        let v = dv.x * px + dv.y * py + dv.z * pz;
        let inside = (u.min(v) >= 0.0) & (u.max(v) <= 1.0);
        // comparisons with a NaN t (ray in the plane) are false
        let met = inside & (t > 0.0) & (rays.from[k] >> 1 != id);
        (if met { t } else { f32::INFINITY }, along > 0.0)
    }

    /// Shortens `hits` where this quad, primitive `id`, is nearer.
    #[inline(always)]
    pub(crate) fn closest(&self, rays: &RayLanes, id: u32, hits: &mut HitLanes) {
        for k in 0..LANES {
            let (t, back) = self.hit(rays, k, id);
            let nearer = t < hits.t[k];
            hits.t[k] = if nearer { t } else { hits.t[k] };
            hits.prim[k] = if nearer { id } else { hits.prim[k] };
            hits.back[k] = if nearer {
                u32::from(back)
            } else {
                hits.back[k]
            };
        }
    }

    /// Marks the lanes whose way is blocked by this quad, unless it is their `target`.
    #[inline(always)]
    pub(crate) fn blocks(
        &self,
        rays: &RayLanes,
        id: u32,
        target: &[u32; LANES],
        blocked: &mut [u32; LANES],
    ) {
        for k in 0..LANES {
            let (t, _) = self.hit(rays, k, id);
            let hit = (t < rays.t_max[k]) & (target[k] != id);
            blocked[k] |= u32::from(hit);
        }
    }
}
