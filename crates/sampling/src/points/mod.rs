//! Sample points for a renderer, as pure functions of (seed, pixel, index, dimension).
//!
//! No state, no table lookups for Sobol': any sample of any pixel can be asked for in any order, by any
//! thread, and is the same number. Samples 0..2^k of a pixel are a good set for every k.

mod halton;
mod hash;
mod sobol;

use crate::rng::mix64;
use hash::pcg4d;

/// Lanes of [`Points::get2_lanes`].
pub const LANES: usize = 16;

/// Which family of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum PointSet {
    /// Independent uniform numbers.
    Independent,
    /// Halton's sequence in the bases of the primes, Owen-scrambled [Halton1960, Owen2017].
    ///
    /// The first 32 dimension pairs; later ones are independent.
    Halton,
    /// Sobol's (0,2)-sequence, Owen-scrambled and index-shuffled for every dimension pair [Burley2020].
    #[default]
    Sobol,
}

/// A family of points with its seed. Different seeds give independent randomisations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Points {
    kind: PointSet,
    seed: [u32; 2],
}

impl Points {
    /// The points of `kind` randomised by `seed`.
    #[must_use]
    pub fn new(kind: PointSet, seed: u64) -> Self {
        let mixed = mix64(seed.wrapping_add(0x9e37_79b9_7f4a_7c15));
        Self {
            kind,
            seed: [mixed as u32, (mixed >> 32) as u32],
        }
    }

    /// The family.
    #[must_use]
    pub fn kind(&self) -> PointSet {
        self.kind
    }

    /// The `index`-th point of `pixel` for dimension pair `dim` (below 2^31), both coordinates in [0, 1).
    #[inline]
    #[must_use]
    pub fn get2(&self, pixel: u32, index: u32, dim: u32) -> [f32; 2] {
        match self.kind {
            PointSet::Independent => self.independent(pixel, index, pair(dim)).map(unit_f32),
            PointSet::Halton => self.halton(pixel, index, dim),
            PointSet::Sobol => self.sobol(pixel, index, pair(dim)).map(unit_f32),
        }
    }

    /// The `index`-th number of `pixel` for the single dimension `dim`, in [0, 1).
    ///
    /// Independent of every `get2`, also for the same `dim`.
    #[inline]
    #[must_use]
    pub fn get1(&self, pixel: u32, index: u32, dim: u32) -> f32 {
        match self.kind {
            PointSet::Independent => unit_f32(self.independent(pixel, index, single(dim))[0]),
            PointSet::Halton | PointSet::Sobol => {
                unit_f32(self.sobol(pixel, index, single(dim))[0])
            }
        }
    }

    /// [`Self::get2`] for [`LANES`] pairs of pixel and index at once; the same numbers.
    #[inline(always)]
    #[must_use]
    pub fn get2_lanes(
        &self,
        pixel: [u32; LANES],
        index: [u32; LANES],
        dim: u32,
    ) -> [[f32; LANES]; 2] {
        let mut out = [[0.0; LANES]; 2];
        // The choice is made outside of the loops, so that each becomes straight SIMD code.
        match self.kind {
            PointSet::Independent => {
                for k in 0..LANES {
                    let [x, y] = self.independent(pixel[k], index[k], pair(dim));
                    (out[0][k], out[1][k]) = (unit_f32(x), unit_f32(y));
                }
            }
            PointSet::Halton => {
                for k in 0..LANES {
                    [out[0][k], out[1][k]] = self.halton(pixel[k], index[k], dim);
                }
            }
            PointSet::Sobol => {
                for k in 0..LANES {
                    let [x, y] = self.sobol(pixel[k], index[k], pair(dim));
                    (out[0][k], out[1][k]) = (unit_f32(x), unit_f32(y));
                }
            }
        }
        out
    }

    #[inline(always)]
    fn independent(&self, pixel: u32, index: u32, stream: u32) -> [u32; 2] {
        let h = pcg4d([pixel, index, stream ^ self.seed[1], self.seed[0]]);
        [h[0], h[1]]
    }

    /// Unrelated words for a stream of a pixel.
    #[inline(always)]
    fn seeds(&self, pixel: u32, stream: u32) -> [u32; 4] {
        pcg4d([pixel, stream, self.seed[0], self.seed[1]])
    }

    #[inline(always)]
    fn sobol(&self, pixel: u32, index: u32, stream: u32) -> [u32; 2] {
        let [shuffle, x, y, _] = self.seeds(pixel, stream);
        sobol::pair(index, shuffle, [x, y])
    }

    #[inline]
    fn halton(&self, pixel: u32, index: u32, dim: u32) -> [f32; 2] {
        let [x, y, _, _] = self.seeds(pixel, pair(dim));
        match halton::pair(index, dim, [x, y]) {
            Some(p) => p,
            None => self.independent(pixel, index, pair(dim)).map(unit_f32),
        }
    }
}

/// The stream of a dimension pair. Pairs and singles never share one; the difference is in the low bit, which
/// the hash spreads best.
#[inline(always)]
fn pair(dim: u32) -> u32 {
    dim << 1
}

/// The stream of a single dimension.
#[inline(always)]
fn single(dim: u32) -> u32 {
    dim << 1 | 1
}

/// The top 24 bits as a number in [0, 1): every result is exact, none rounds up to 1.
#[inline(always)]
fn unit_f32(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}
