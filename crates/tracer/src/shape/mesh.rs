//! Indexed triangles as they come from a file.

use glam::Vec3;

/// Indexed triangles, optionally with a normal at every position.
///
/// Triangles without area are left out when the scene is built; an index beyond the positions, a coordinate that is
/// not finite and a count of normals other than that of the positions are errors there.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Corner positions.
    pub positions: Vec<Vec3>,
    /// Three indices into `positions` a triangle, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Shading normals, one a position, any length; `None` shades with the plane of the triangle.
    pub normals: Option<Vec<Vec3>>,
}
