//! All primitives of a scene and the two questions asked of them: what is met first, and is the way free.

use crate::bvh::Bvh;
use crate::math::U;
use crate::path::{HitLanes, NONE, RayLanes};
use crate::shape::{Quad, Sphere};
use brdf::LANES;
use glam::Vec3;

/// By how much a hit point may lie off its surface, relative to the coordinates that entered it, weighed by the normal:
/// eight roundings cover re-projection, barycentric sums and the addition of the centre [Pharr2023].
const SURFACE_ERROR: f32 = 4.0 * f32::EPSILON;

/// Where and on what a ray ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// On the surface, up to `error`.
    pub(crate) p: Vec3,
    /// Geometric normal, front side, unit.
    pub(crate) normal: Vec3,
    /// Shading normal, front side, unit.
    pub(crate) shading: Vec3,
    /// Bound on how far `p` lies off the surface.
    pub(crate) error: f32,
}

/// Corner normals and object of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleInfo {
    pub(crate) object: u32,
    /// Start of three entries in [`Geometry::normals`], or [`NONE`].
    pub(crate) normals: u32,
}

/// The primitives: spheres first, then quads, then triangles in leaf order.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    pub(crate) spheres: Vec<Sphere>,
    pub(crate) quads: Vec<Quad>,
    pub(crate) bvh: Option<Bvh>,
    /// Object of every sphere, then of every quad.
    pub(crate) objects: Vec<u32>,
    /// Per triangle, in leaf order.
    pub(crate) triangles: Vec<TriangleInfo>,
    pub(crate) normals: Vec<Vec3>,
}

impl Geometry {
    /// The first index that is a quad.
    #[inline]
    pub(crate) fn first_quad(&self) -> u32 {
        self.spheres.len() as u32
    }

    /// The first index that is a triangle.
    #[inline]
    pub(crate) fn first_triangle(&self) -> u32 {
        (self.spheres.len() + self.quads.len()) as u32
    }

    /// Object that primitive `prim` belongs to.
    #[inline(always)]
    pub(crate) fn object(&self, prim: u32) -> u32 {
        match self.objects.get(prim as usize) {
            Some(&object) => object,
            None => self.triangles[prim as usize - self.objects.len()].object,
        }
    }

    /// What each ray of a block meets first before its `t_max`.
    #[inline(always)]
    pub(crate) fn closest(&self, rays: &RayLanes, hits: &mut HitLanes) {
        hits.t = rays.t_max;
        hits.prim = [NONE; LANES];
        let mut id = 0;
        for sphere in &self.spheres {
            sphere.closest(rays, id, hits);
            id += 1;
        }
        for quad in &self.quads {
            quad.closest(rays, id, hits);
            id += 1;
        }
        if let Some(bvh) = &self.bvh {
            for k in 0..LANES {
                if hits.t[k] > 0.0 {
                    let skip = (rays.from[k] >> 1).wrapping_sub(id);
                    if let Some((t, i)) = bvh.closest(rays.o.get(k), rays.d.get(k), hits.t[k], skip)
                    {
                        hits.t[k] = t;
                        hits.prim[k] = id + i;
                    }
                }
            }
        }
    }

    /// 1 in each lane whose ray meets anything but its target before `t_max`.
    #[inline(always)]
    pub(crate) fn blocked(&self, rays: &RayLanes, target: &U) -> U {
        let mut blocked = [0; LANES];
        let mut id = 0;
        for sphere in &self.spheres {
            sphere.blocks(rays, id, target, &mut blocked);
            id += 1;
        }
        for quad in &self.quads {
            quad.blocks(rays, id, target, &mut blocked);
            id += 1;
        }
        if let Some(bvh) = &self.bvh {
            for k in 0..LANES {
                if blocked[k] == 0 && rays.t_max[k] > 0.0 {
                    let skip = [
                        (rays.from[k] >> 1).wrapping_sub(id),
                        target[k].wrapping_sub(id),
                    ];
                    let hit = bvh.blocked(rays.o.get(k), rays.d.get(k), rays.t_max[k], skip);
                    blocked[k] = u32::from(hit);
                }
            }
        }
        blocked
    }

    /// The surface where the ray `o + t d` met primitive `prim`.
    #[inline(always)]
    pub(crate) fn point(&self, prim: u32, o: Vec3, d: Vec3, t: f32) -> Point {
        let first_quad = self.first_quad();
        if prim < first_quad {
            let s = &self.spheres[prim as usize];
            let normal = (o + d * t - s.center).normalize_or(Vec3::Z);
            Point {
                p: s.center + normal * s.radius,
                normal,
                shading: normal,
                error: SURFACE_ERROR * (normal.abs().dot(s.center.abs()) + s.radius),
            }
        } else if let Some(q) = self.quads.get((prim - first_quad) as usize) {
            let p = o + d * t;
            let p = p - q.normal * q.normal.dot(p - q.corner);
            Point {
                p,
                normal: q.normal,
                shading: q.normal,
                error: SURFACE_ERROR * q.normal.abs().dot(p.abs() + q.corner.abs()),
            }
        } else {
            self.triangle_point(prim - self.first_triangle(), o, d)
        }
    }

    #[inline(never)]
    fn triangle_point(&self, index: u32, o: Vec3, d: Vec3) -> Point {
        let Some(bvh) = &self.bvh else {
            // triangles exist only inside the tree
            return Point {
                p: o,
                normal: Vec3::Z,
                shading: Vec3::Z,
                error: 0.0,
            };
        };
        let at = bvh.point(index, o, d);
        let info = self.triangles[index as usize];
        let shading = if info.normals == NONE {
            at.normal
        } else {
            let n = &self.normals[info.normals as usize..][..3];
            let w = at.weights;
            (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]).normalize_or(at.normal)
        };
        Point {
            p: at.p,
            normal: at.normal,
            shading,
            error: SURFACE_ERROR * at.normal.abs().dot(at.extent),
        }
    }
}
