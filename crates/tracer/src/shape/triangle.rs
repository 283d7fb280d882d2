//! The triangle: a test by edge volumes that is watertight, since two triangles compute a shared edge alike.

use glam::{DVec3, Vec3, Vec3A};

/// A triangle in world space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    pub(crate) corners: [Vec3; 3],
}

impl Triangle {
    /// Volumes spanned by the ray and each edge, in the order of the corner opposite to it, relative to `o`.
    ///
    /// (b - a) x (a + b) . d changes its sign exactly, bit for bit, when a and b trade places [Embree].
    #[inline(always)]
    fn volumes(&self, o: Vec3A, d: Vec3A) -> ([f32; 3], [Vec3A; 3]) {
        let [v0, v1, v2] = self.corners.map(|c| Vec3A::from(c) - o);
        let w = [
            (v1 - v2).cross(v1 + v2).dot(d),
            (v2 - v0).cross(v2 + v0).dot(d),
            (v0 - v1).cross(v0 + v1).dot(d),
        ];
        (w, [v0, v1, v2])
    }

    /// Weights of the corners where the ray meets the plane, summing to one.
    #[inline]
    pub(crate) fn barycentric(&self, o: Vec3, d: Vec3) -> [f32; 3] {
        let (w, _) = self.volumes(o.into(), d.into());
        let sum = w[0] + w[1] + w[2];
        if sum.abs() > 0.0 {
            w.map(|x| (x / sum).clamp(0.0, 1.0))
        } else {
            [1.0 / 3.0; 3]
        }
    }

    /// Twice the area times the unit normal.
    #[inline]
    pub(crate) fn cross(&self) -> Vec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Cross product of the edges in double precision, where no scene underflows.
    fn exact_cross(&self) -> DVec3 {
        let [a, b, c] = self.corners.map(|c| c.as_dvec3());
        (b - a).cross(c - a)
    }

    /// The area.
    pub(crate) fn area(&self) -> f64 {
        0.5 * self.exact_cross().length()
    }

    /// The unit normal of the front.
    pub(crate) fn normal(&self) -> Vec3 {
        self.exact_cross().normalize_or(DVec3::Z).as_vec3()
    }
}
