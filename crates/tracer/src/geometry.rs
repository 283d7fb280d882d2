//! All primitives of a scene and the two questions asked of them: what is met first, and is the way free.

use crate::bvh::Bvh;
use crate::math::U;
use crate::path::{HitLanes, NONE, RayLanes};
use crate::shape::{Quad, Sphere, Triangle};
use brdf::LANES;
use glam::Vec3;

/// Multiple of the unit roundoff by which a hit point may lie off its surface, relative to the largest coordinate
/// that entered it; it covers re-projection, barycentric sums and the addition of the centre [Pharr2023].
const SURFACE_ERROR: f32 = 8.0 * f32::EPSILON;

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
    /// Error bound of a point on a sphere, then on a quad.
    pub(crate) errors: Vec<f32>,
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

    /// Computes the error bounds of the analytic shapes, once they are all there.
    pub(crate) fn bound_errors(&mut self, corners: impl Iterator<Item = [Vec3; 4]>) {
        let spheres = self
            .spheres
            .iter()
            .map(|s| SURFACE_ERROR * (s.center.abs().max_element() + s.radius));
        let quads = corners.map(|c| SURFACE_ERROR * largest(&c));
        self.errors = spheres.chain(quads).collect();
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
                error: self.errors[prim as usize],
            }
        } else if let Some(q) = self.quads.get((prim - first_quad) as usize) {
            let p = o + d * t;
            Point {
                p: p - q.normal * q.normal.dot(p - q.corner),
                normal: q.normal,
                shading: q.normal,
                error: self.errors[prim as usize],
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
        let triangle: &Triangle = bvh.triangle(index);
        let w = triangle.barycentric(o, d);
        let [a, b, c] = triangle.corners;
        let normal = triangle.cross().normalize_or(Vec3::Z);
        let info = self.triangles[index as usize];
        let shading = if info.normals == NONE {
            normal
        } else {
            let n = &self.normals[info.normals as usize..][..3];
            (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]).normalize_or(normal)
        };
        Point {
            p: a * w[0] + b * w[1] + c * w[2],
            normal,
            shading,
            error: SURFACE_ERROR * largest(&triangle.corners),
        }
    }
}

/// The largest coordinate, by magnitude.
fn largest(points: &[Vec3]) -> f32 {
    points
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, f32::max)
}
