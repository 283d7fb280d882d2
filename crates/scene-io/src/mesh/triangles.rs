//! Indexed triangles as they come from a file or a generator.

use crate::error::Error;
use glam::Vec3;

/// Most vertices of a mesh: 2^26.
pub const MAX_VERTICES: usize = 1 << 26;
/// Most triangles of a mesh: 2^26.
pub const MAX_TRIANGLES: usize = 1 << 26;

/// Indexed triangles, counter-clockwise seen from the front.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Corner positions.
    pub positions: Vec<Vec3>,
    /// Shading normals, unit, one a position.
    pub normals: Option<Vec<Vec3>>,
    /// Three indices into `positions` a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Triangles of the file that were left out because they have no area.
    pub dropped: usize,
}

impl Triangles {
    /// Checks counts, indices and coordinates; drops triangles without area; normalises the normals.
    pub(super) fn checked(mut self) -> Result<Self, Error> {
        for (found, most, what) in [
            (self.positions.len(), MAX_VERTICES, "vertices"),
            (self.triangles.len(), MAX_TRIANGLES, "triangles"),
        ] {
            if found > most {
                return Err(Error::invalid(format!(
                    "expected at most {most} {what}, found {found}"
                )));
            }
        }
        if let Some(k) = self.positions.iter().position(|p| !p.is_finite()) {
            let message = format!(
                "expected finite coordinates, found {} in vertex {k}",
                self.positions[k]
            );
            return Err(Error::invalid(message));
        }
        let vertices = self.positions.len();
        for (k, t) in self.triangles.iter().enumerate() {
            if let Some(i) = t.iter().find(|i| **i as usize >= vertices) {
                return Err(Error::invalid(format!(
                    "expected indices below {vertices} (the vertices), found {i} in triangle {k}"
                )));
            }
        }
        let before = self.triangles.len();
        let positions = &self.positions;
        self.triangles
            .retain(|t| has_area(t.map(|i| positions[i as usize])));
        self.dropped += before - self.triangles.len();
        if self.triangles.is_empty() {
            let dropped = self.dropped;
            return Err(Error::invalid(format!(
                "expected triangles, found none ({dropped} without area)"
            )));
        }
        self.normals = self.normals.filter(|n| n.len() == vertices).map(unit);
        Ok(self)
    }
}

fn has_area([a, b, c]: [Vec3; 3]) -> bool {
    let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
    (b - a).cross(c - a).length_squared() > 0.0
}

/// A normal of no length stays zero; whoever shades falls back on the plane of the triangle.
fn unit(normals: Vec<Vec3>) -> Vec<Vec3> {
    normals.into_iter().map(Vec3::normalize_or_zero).collect()
}
