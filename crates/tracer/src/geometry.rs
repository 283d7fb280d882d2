//! All primitives of a scene and the two questions asked of them: what is met first, and is the way free.

use crate::bvh::Bvh;
use crate::math::{F, U};
use crate::path::{HitLanes, NONE, RayLanes};
use crate::shape::{Quad, Sphere};
use brdf::{LANES, Lanes3};
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

/// [`LANES`] of them.
#[derive(Clone, Debug)]
pub(crate) struct PointLanes {
    pub(crate) p: Lanes3,
    pub(crate) normal: Lanes3,
    pub(crate) shading: Lanes3,
    pub(crate) error: F,
}

impl PointLanes {
    const EMPTY: Self = Self {
        p: Lanes3::ZERO,
        normal: Lanes3::ZERO,
        shading: Lanes3::ZERO,
        error: [0.0; LANES],
    };
}

/// What a hit point of an analytic shape is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Anchor {
    /// Centre of a sphere, corner of a quad.
    point: Vec3,
    /// Of a quad; 0 for spheres.
    normal: Vec3,
    /// Of a sphere; 0 for quads.
    radius: f32,
}

impl Anchor {
    const NONE: Self = Self {
        point: Vec3::ZERO,
        normal: Vec3::Z,
        radius: 0.0,
    };
}

/// Corner normals and object of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleInfo {
    pub(crate) object: u32,
    /// Start of three entries in [`Geometry::normals`], or [`NONE`].
    pub(crate) normals: u32,
}

impl TriangleInfo {
    /// Of a lane of a leaf that no triangle takes.
    pub(crate) const SPARE: Self = Self {
        object: NONE,
        normals: NONE,
    };
}

/// The primitives: spheres first, then quads, then triangles in leaf order.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    pub(crate) spheres: Vec<Sphere>,
    pub(crate) quads: Vec<Quad>,
    pub(crate) bvh: Option<Bvh>,
    /// Object of every sphere, then of every quad.
    pub(crate) objects: Vec<u32>,
    /// Of every sphere, then of every quad.
    anchors: Vec<Anchor>,
    /// Per lane of the leaves, some of them [`TriangleInfo::SPARE`].
    pub(crate) triangles: Vec<TriangleInfo>,
    pub(crate) normals: Vec<Vec3>,
}

impl Geometry {
    /// Tells analytic primitives their objects; after the last one was added.
    pub(crate) fn close(&mut self, objects: Vec<u32>) {
        self.objects = objects;
        let spheres = self.spheres.iter().map(|s| Anchor {
            point: s.center,
            normal: Vec3::ZERO,
            radius: s.radius,
        });
        let quads = self.quads.iter().map(|q| Anchor {
            point: q.corner,
            normal: q.normal,
            radius: 0.0,
        });
        self.anchors = spheres.chain(quads).collect();
    }

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
        hits.back = [0; LANES];
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
            bvh.closest(rays, id, hits);
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
            bvh.blocked(rays, id, target, &mut blocked);
        }
        blocked
    }

    /// Normal of the front of the flat primitive `prim`; z for spheres.
    #[inline]
    pub(crate) fn flat_normal(&self, prim: u32) -> Vec3 {
        let quad = prim.wrapping_sub(self.first_quad()) as usize;
        match (self.quads.get(quad), &self.bvh) {
            (Some(quad), _) => quad.normal,
            (None, Some(bvh)) if prim >= self.first_triangle() => {
                (bvh.normal(prim - self.first_triangle())).normalize_or(Vec3::Z)
            }
            _ => Vec3::Z,
        }
    }

    /// The surfaces where the rays `o + t d` met the primitives `prim`.
    #[inline(always)]
    pub(crate) fn points(&self, prim: &U, o: &Lanes3, d: &Lanes3, t: &F) -> PointLanes {
        let mut at = if self.anchors.is_empty() {
            PointLanes::EMPTY
        } else {
            self.analytic_points(prim, o, d, t)
        };
        at.shading = at.normal;
        if self.bvh.is_some() {
            self.triangle_points(prim, o, d, &mut at);
        }
        at
    }

    /// Spheres and quads by one formula: the one keeps points at a distance from its centre, the other in its plane.
    #[inline(always)]
    fn analytic_points(&self, prim: &U, o: &Lanes3, d: &Lanes3, t: &F) -> PointLanes {
        let (mut c, mut n, mut radius) = (Lanes3::ZERO, Lanes3::ZERO, [0.0; LANES]);
        for k in 0..LANES {
            // triangles take any, and are filled in later
            let anchor = self.anchors.get(prim[k] as usize).unwrap_or(&Anchor::NONE);
            c.set(k, anchor.point);
            n.set(k, anchor.normal);
            radius[k] = anchor.radius;
        }
        let mut at = PointLanes::EMPTY;
        for k in 0..LANES {
            let (px, py, pz) = (
                o.x[k] + d.x[k] * t[k],
                o.y[k] + d.y[k] * t[k],
                o.z[k] + d.z[k] * t[k],
            );
            let (rx, ry, rz) = (px - c.x[k], py - c.y[k], pz - c.z[k]);
            let r2 = rx * rx + ry * ry + rz * rz;
            let round = radius[k] > 0.0;
            let inv = if r2 > 0.0 { 1.0 / r2.sqrt() } else { 0.0 };
            let nx = if round { rx * inv } else { n.x[k] };
            let ny = if round { ry * inv } else { n.y[k] };
            let nz = if round { rz * inv } else { n.z[k] };
            let off = n.x[k] * rx + n.y[k] * ry + n.z[k] * rz;
            let x = if round {
                c.x[k] + nx * radius[k]
            } else {
                px - nx * off
            };
            let y = if round {
                c.y[k] + ny * radius[k]
            } else {
                py - ny * off
            };
            let z = if round {
                c.z[k] + nz * radius[k]
            } else {
                pz - nz * off
            };
            // a quad's point enters with its own coordinates, a sphere's with the radius
            let (ex, ey, ez) = if round { (0.0, 0.0, 0.0) } else { (x, y, z) };
            let size = nx.abs() * (c.x[k].abs() + ex.abs())
                + ny.abs() * (c.y[k].abs() + ey.abs())
                + nz.abs() * (c.z[k].abs() + ez.abs())
                + radius[k];
            (at.p.x[k], at.p.y[k], at.p.z[k]) = (x, y, z);
            (at.normal.x[k], at.normal.y[k], at.normal.z[k]) = (nx, ny, nz);
            at.error[k] = SURFACE_ERROR * size;
        }
        at
    }

    #[inline(never)]
    fn triangle_points(&self, prim: &U, o: &Lanes3, d: &Lanes3, at: &mut PointLanes) {
        let first = self.first_triangle();
        for k in (0..LANES).filter(|k| prim[*k] >= first) {
            let point = self.triangle_point(prim[k] - first, o.get(k), d.get(k));
            at.p.set(k, point.p);
            at.normal.set(k, point.normal);
            at.shading.set(k, point.shading);
            at.error[k] = point.error;
        }
    }

    #[inline]
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
