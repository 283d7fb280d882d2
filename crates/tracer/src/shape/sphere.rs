//! The sphere: robust intersection in lanes [Haines2019], hit points re-projected onto the surface.

use crate::path::{HitLanes, RayLanes};
use brdf::LANES;
use glam::Vec3;

/// A sphere in world space; its normal points outward.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere {
    pub(crate) center: Vec3,
    pub(crate) radius: f32,
}

impl Sphere {
    /// Distance of the first hit of lane `k`, infinity for none; and whether it is from inside.
    ///
    /// The discriminant is r^2 - |f + b d|^2, which does not cancel for small or far spheres, and the smaller
    /// root is c / q.
    #[inline(always)]
    fn hit(&self, rays: &RayLanes, k: usize, id: u32) -> (f32, bool) {
        let (fx, fy, fz) = (
            rays.o.x[k] - self.center.x,
            rays.o.y[k] - self.center.y,
            rays.o.z[k] - self.center.z,
        );
        let (dx, dy, dz) = (rays.d.x[k], rays.d.y[k], rays.d.z[k]);
        let b = -(fx * dx + fy * dy + fz * dz);
        let (lx, ly, lz) = (fx + b * dx, fy + b * dy, fz + b * dz);
        let r2 = self.radius * self.radius;
        let disc = r2 - (lx * lx + ly * ly + lz * lz);
        let c = fx * fx + fy * fy + fz * fz - r2;
        let q = b + disc.max(0.0).sqrt().copysign(b);
        let (ta, tb) = (c / q, q);
        let (near, far) = (ta.min(tb), ta.max(tb));
        let foreign = if near > 0.0 { near } else { far };
        let foreign = if disc > 0.0 && foreign > 0.0 {
            foreign
        } else {
            f32::INFINITY
        };
        // Leaving this very sphere: never met from outside; from inside met for certain, at 2b.
        let t = if rays.from[k] == 2 * id {
            f32::INFINITY
        } else {
            foreign
        };
        let from_inside = rays.from[k] == 2 * id + 1;
        let across = (2.0 * b).max(f32::MIN_POSITIVE);
        let t = if from_inside { across } else { t };
        (t, from_inside | (near <= 0.0))
    }

    /// Shortens `hits` where this sphere, primitive `id`, is nearer.
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

    /// Marks the lanes whose way is blocked by this sphere, unless it is their `target`.
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
