//! Fixed-width structure-of-arrays packets: plain arrays the compiler turns into SIMD.

use glam::Vec3;

/// How many directions travel together. 16 floats fill one AVX-512 or two AVX2 registers.
pub const LANES: usize = 16;

/// [`LANES`] vectors, coordinate by coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes3 {
    /// x of every lane.
    pub x: [f32; LANES],
    /// y of every lane.
    pub y: [f32; LANES],
    /// z of every lane.
    pub z: [f32; LANES],
}

impl Lanes3 {
    /// All lanes zero.
    pub const ZERO: Self = Self {
        x: [0.0; LANES],
        y: [0.0; LANES],
        z: [0.0; LANES],
    };

    /// The vector in lane `k`.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, k: usize) -> Vec3 {
        Vec3::new(self.x[k], self.y[k], self.z[k])
    }

    /// Replaces the vector in lane `k`.
    #[inline(always)]
    pub fn set(&mut self, k: usize, v: Vec3) {
        self.x[k] = v.x;
        self.y[k] = v.y;
        self.z[k] = v.z;
    }
}
