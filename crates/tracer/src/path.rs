//! The state of paths in flight, [`LANES`] to a block, coordinate by coordinate.

use crate::math::{F, U};
use brdf::{LANES, Lanes3};
use glam::Vec3;

/// No primitive, no light: the index that stands for nothing.
pub(crate) const NONE: u32 = u32::MAX;

/// [`LANES`] rays.
#[derive(Clone, Debug)]
pub(crate) struct RayLanes {
    /// Origins.
    pub(crate) o: Lanes3,
    /// Unit directions.
    pub(crate) d: Lanes3,
    /// Where the ray may end at the latest.
    pub(crate) t_max: F,
    /// The primitive the ray leaves, times two, plus one if it leaves to the back; or [`NONE`].
    ///
    /// A flat primitive can't be met again and a sphere only from inside: tested by identity, exactly, not by a
    /// distance.
    pub(crate) from: U,
}

impl RayLanes {
    pub(crate) const EMPTY: Self = Self {
        o: Lanes3::ZERO,
        d: Lanes3::ZERO,
        t_max: [0.0; LANES],
        from: [NONE; LANES],
    };
}

/// What [`LANES`] rays met first.
#[derive(Clone, Debug)]
pub(crate) struct HitLanes {
    /// Distance.
    pub(crate) t: F,
    /// Primitive, or [`NONE`].
    pub(crate) prim: U,
    /// 1 where its back was met, up to rounding for rays along the surface.
    pub(crate) back: U,
}

impl HitLanes {
    pub(crate) const EMPTY: Self = Self {
        t: [0.0; LANES],
        prim: [NONE; LANES],
        back: [0; LANES],
    };
}

/// One path between two vertices.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathState<const N: usize> {
    pub(crate) o: Vec3,
    pub(crate) d: Vec3,
    pub(crate) from: u32,
    /// Where its light is collected.
    pub(crate) slot: u32,
    /// Density of `d` in solid angle at the vertex left behind.
    pub(crate) pdf: f32,
    pub(crate) throughput: [f32; N],
}

/// Paths in flight, dense.
#[derive(Debug)]
pub(crate) struct Paths<const N: usize> {
    pub(crate) rays: Vec<RayLanes>,
    pub(crate) slot: Vec<u32>,
    pub(crate) pdf: Vec<f32>,
    pub(crate) throughput: Vec<[f32; N]>,
    pub(crate) len: usize,
}

impl<const N: usize> Paths<N> {
    /// Room for `capacity` paths.
    pub(crate) fn new(capacity: usize) -> Self {
        let capacity = capacity.next_multiple_of(LANES);
        Self {
            rays: vec![RayLanes::EMPTY; capacity / LANES],
            slot: vec![0; capacity],
            pdf: vec![0.0; capacity],
            throughput: vec![[0.0; N]; capacity],
            len: 0,
        }
    }

    /// Appends a path if it is to be kept; nothing branches on that. The caller keeps to the capacity.
    #[inline(always)]
    pub(crate) fn push(&mut self, path: &PathState<N>, keep: bool) {
        let (block, k) = (self.len / LANES, self.len % LANES);
        let rays = &mut self.rays[block];
        rays.o.set(k, path.o);
        rays.d.set(k, path.d);
        rays.t_max[k] = f32::INFINITY;
        rays.from[k] = path.from;
        self.slot[self.len] = path.slot;
        self.pdf[self.len] = path.pdf;
        self.throughput[self.len] = path.throughput;
        self.len += usize::from(keep);
    }

    /// Closes the last block: its unused lanes meet nothing.
    pub(crate) fn seal(&mut self) {
        if !self.len.is_multiple_of(LANES) {
            let rays = &mut self.rays[self.len / LANES];
            for k in self.len % LANES..LANES {
                rays.t_max[k] = 0.0;
            }
        }
    }

    /// How many blocks are in use.
    pub(crate) fn blocks(&self) -> usize {
        self.len.div_ceil(LANES)
    }

    pub(crate) fn bytes(&self) -> usize {
        let rays = size_of_val(&self.rays[..]) + size_of_val(&self.throughput[..]);
        rays + size_of_val(&self.slot[..]) + size_of_val(&self.pdf[..])
    }
}

/// Shadow rays with what they carry if nothing is in the way.
#[derive(Debug)]
pub(crate) struct Shadows<const N: usize> {
    pub(crate) rays: Vec<RayLanes>,
    /// The primitive that shines, which does not shade itself; or [`NONE`].
    pub(crate) target: Vec<U>,
    pub(crate) slot: Vec<u32>,
    pub(crate) light: Vec<[f32; N]>,
    pub(crate) len: usize,
}

impl<const N: usize> Shadows<N> {
    /// Room for `capacity` rays.
    pub(crate) fn new(capacity: usize) -> Self {
        let capacity = capacity.next_multiple_of(LANES);
        Self {
            rays: vec![RayLanes::EMPTY; capacity / LANES],
            target: vec![[NONE; LANES]; capacity / LANES],
            slot: vec![0; capacity],
            light: vec![[0.0; N]; capacity],
            len: 0,
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        let rays = size_of_val(&self.rays[..]) + size_of_val(&self.target[..]);
        rays + size_of_val(&self.slot[..]) + size_of_val(&self.light[..])
    }

    /// Appends a ray of length `t_max` toward primitive `target` carrying `path.throughput` if it is to be kept;
    /// nothing branches on that.
    #[inline(always)]
    pub(crate) fn push(&mut self, path: &PathState<N>, t_max: f32, target: u32, keep: bool) {
        let (block, k) = (self.len / LANES, self.len % LANES);
        let rays = &mut self.rays[block];
        rays.o.set(k, path.o);
        rays.d.set(k, path.d);
        rays.t_max[k] = t_max;
        rays.from[k] = path.from;
        self.target[block][k] = target;
        self.slot[self.len] = path.slot;
        self.light[self.len] = path.throughput;
        self.len += usize::from(keep);
    }

    /// Closes the last block: its unused lanes meet nothing.
    pub(crate) fn seal(&mut self) {
        if !self.len.is_multiple_of(LANES) {
            let rays = &mut self.rays[self.len / LANES];
            for k in self.len % LANES..LANES {
                rays.t_max[k] = 0.0;
            }
        }
    }
}
