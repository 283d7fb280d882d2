//! What one worker holds: paths in flight and all that is known of them between two stages.

use crate::light::LightLanes;
use crate::mode::Mode;
use crate::path::{HitLanes, Paths, Shadows};
use crate::stats::Stats;
use crate::vertex::VertexLanes;
use brdf::{EvalPacket, LANES, SamplePacket, Tag};

/// Blocks of vertices a material is handed at once: few enough to stay in the first-level cache, enough to make the
/// virtual call free.
pub(crate) const BLOCKS: usize = 16;

/// Shadow rays that wait to be traced together: what they carry is still in the first-level cache then, in many channels in
/// the second.
pub(crate) const WAITING: usize = 2 * BLOCKS * LANES;

/// Buffers of one worker, reused for all its batches.
#[derive(Debug)]
pub(crate) struct Workspace<const N: usize, S: Mode<N>> {
    pub(crate) paths: Paths<N>,
    pub(crate) next: Paths<N>,
    pub(crate) hits: Vec<HitLanes>,
    pub(crate) shadows: Shadows<N>,
    /// Paths sorted by material, and where each material's part ends.
    pub(crate) order: Vec<u32>,
    pub(crate) bucket: Vec<u32>,
    pub(crate) ends: Vec<usize>,
    /// Paths that met a light.
    pub(crate) met: Vec<u32>,
    pub(crate) vertices: Vec<VertexLanes<N>>,
    /// Points on lights and their evaluations: for each block of vertices as many as there are candidates.
    pub(crate) lights: Vec<LightLanes<N>>,
    pub(crate) evals: Vec<EvalPacket<N, S::Tag>>,
    pub(crate) samples: Vec<SamplePacket<N, S::Tag>>,
    /// Light collected in each slot.
    pub(crate) slots: Vec<[f32; N]>,
    /// What the channels of each slot are.
    pub(crate) tag: Vec<S::Tag>,
    /// Points of each slot: stream, and index in the stream.
    pub(crate) stream: Vec<u32>,
    pub(crate) index: Vec<u32>,
    /// Upper left corner of each slot's pixel.
    pub(crate) corner: [Vec<f32>; 2],
    pub(crate) stats: Stats,
}

impl<const N: usize, S: Mode<N>> Workspace<N, S> {
    /// Room for `capacity` paths, `materials` materials and `candidates` points on lights a vertex.
    pub(crate) fn new(capacity: usize, materials: usize, candidates: usize) -> Self {
        let capacity = capacity.next_multiple_of(LANES);
        Self {
            paths: Paths::new(capacity),
            next: Paths::new(capacity),
            hits: vec![HitLanes::EMPTY; capacity.div_ceil(LANES)],
            shadows: Shadows::new(WAITING),
            order: vec![0; capacity],
            bucket: vec![0; capacity],
            ends: vec![0; materials + 1],
            met: vec![0; capacity],
            vertices: vec![VertexLanes::EMPTY; BLOCKS],
            lights: vec![LightLanes::EMPTY; BLOCKS * candidates],
            evals: vec![EvalPacket::ZERO; BLOCKS * candidates],
            samples: vec![SamplePacket::ZERO; BLOCKS],
            slots: vec![[0.0; N]; capacity],
            tag: vec![S::Tag::FIRST; capacity],
            stream: vec![0; capacity],
            index: vec![0; capacity],
            corner: [vec![0.0; capacity], vec![0.0; capacity]],
            stats: Stats::default(),
        }
    }

    /// What all this takes.
    pub(crate) fn bytes(&self) -> usize {
        let paths = self.paths.bytes() + self.next.bytes() + self.shadows.bytes();
        let blocks = size_of_val(&self.hits[..])
            + size_of_val(&self.vertices[..])
            + size_of_val(&self.lights[..])
            + size_of_val(&self.evals[..])
            + size_of_val(&self.samples[..]);
        // order, bucket, met, stream, index and two coordinates a slot
        let slots = size_of_val(&self.slots[..]) + size_of_val(&self.tag[..]);
        paths + blocks + slots + 7 * size_of_val(&self.order[..])
    }
}
