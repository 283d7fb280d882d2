//! What a caller may choose about a render.

use crate::filter::PixelFilter;
use sampling::PointSet;
use std::num::NonZeroUsize;

/// How light is found at a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strategy {
    /// Lights and material each propose a direction; the balance heuristic weighs them [Veach1997]. A constant
    /// environment is left to the material, whose density follows the integrand.
    Mis,
    /// As [`Self::Mis`], but lights propose several directions, of which the one shadow ray takes one in proportion to
    /// what it would carry [Talbot2005]. The material proposes one, which costs nothing, since the path goes there.
    Ris,
    /// Only the lights propose.
    LightOnly,
    /// Only the material proposes; lights without extent are then never found.
    BsdfOnly,
}

/// A part of the tiles of a picture, for renders that share the work and are put together afterwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, below `count`.
    pub index: u32,
    /// Of how many.
    pub count: u32,
}

impl Shard {
    /// Whether tile number `tile` belongs to it: every `count`-th does, so that all shards cost about the same.
    #[must_use]
    pub fn has(&self, tile: usize) -> bool {
        tile % self.count.max(1) as usize == self.index as usize
    }
}

/// Options of [`crate::render`].
#[derive(Clone, Debug)]
pub struct Settings {
    /// Samples a pixel, counting those the film already holds. A power of two times the film's replicates keeps
    /// the points even.
    pub spp: u32,
    /// Decides every random choice.
    pub seed: u64,
    /// At most this many scattering vertices a path; 0 shows the lights alone.
    pub max_depth: u32,
    /// How light is found.
    pub strategy: Strategy,
    /// Where random numbers come from.
    pub points: PointSet,
    /// How samples are spread over pixels.
    pub filter: PixelFilter,
    /// From this many scattering vertices on, weak paths end by chance (Russian roulette); `None`: never.
    pub roulette: Option<u32>,
    /// Which part of the picture is rendered; `None`: all of it.
    pub shard: Option<Shard>,
    /// Worker threads; `None` uses the pool the caller runs in. The picture does not depend on it.
    pub threads: Option<NonZeroUsize>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            spp: 64,
            seed: 0,
            max_depth: 5,
            strategy: Strategy::Mis,
            points: PointSet::Sobol,
            filter: PixelFilter::Box,
            roulette: None,
            shard: None,
            threads: None,
        }
    }
}
