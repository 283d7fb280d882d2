//! What can be met by a ray: analytic shapes tested one after the other in lanes, triangles in a BVH.

mod mesh;
mod quad;
mod sphere;
mod triangle;

pub(crate) use quad::Quad;
pub(crate) use sphere::Sphere;
pub(crate) use triangle::{Number, ShearedRay, Triangle, meet};

pub use mesh::Mesh;

use glam::DVec3;

/// A shape in its own coordinates; [`crate::Object`] places it in the world.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A sphere; its front is the outside. Keeps its form under rotation, translation and uniform scale only.
    Sphere {
        /// The centre.
        center: DVec3,
        /// The radius, positive.
        radius: f64,
    },
    /// A parallelogram corner + u `edge_u` + v `edge_v`; its front is the side `edge_u` x `edge_v` points to.
    Quad {
        /// Where u = v = 0.
        corner: DVec3,
        /// From u = 0 to u = 1.
        edge_u: DVec3,
        /// From v = 0 to v = 1.
        edge_v: DVec3,
    },
    /// Triangles; the front is where their corners appear counter-clockwise.
    Mesh(Mesh),
}
