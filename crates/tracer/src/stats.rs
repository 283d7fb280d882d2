//! What a render did and where its time went.

use std::ops::AddAssign;
use std::time::Duration;

/// Counters and times, summed over threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Camera paths.
    pub paths: u64,
    /// Rays that asked for the nearest hit.
    pub closest_rays: u64,
    /// Rays that asked whether the way to a light is free.
    pub shadow_rays: u64,
    /// Vertices where light was scattered.
    pub vertices: u64,
    /// Bytes of the buffers of all workers.
    pub buffers: u64,
    /// Time by stage.
    pub stages: Stages,
}

/// Thread time of each stage of the stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// Making camera rays.
    pub camera: Duration,
    /// Nearest hits.
    pub closest: Duration,
    /// Light met by chance, and sorting by material.
    pub sort: Duration,
    /// Hit points, frames, points on lights.
    pub prepare: Duration,
    /// Evaluating and sampling materials.
    pub material: Duration,
    /// Weighing what they said, making new rays.
    pub advance: Duration,
    /// Shadow rays.
    pub shadow: Duration,
    /// Adding to the film.
    pub film: Duration,
}

impl Stages {
    /// Names and times, in the order of the work.
    #[must_use]
    pub fn rows(&self) -> [(&'static str, Duration); 8] {
        [
            ("camera", self.camera),
            ("closest", self.closest),
            ("sort", self.sort),
            ("prepare", self.prepare),
            ("material", self.material),
            ("advance", self.advance),
            ("shadow", self.shadow),
            ("film", self.film),
        ]
    }
}

impl AddAssign for Stats {
    fn add_assign(&mut self, other: Self) {
        self.paths += other.paths;
        self.closest_rays += other.closest_rays;
        self.shadow_rays += other.shadow_rays;
        self.vertices += other.vertices;
        self.buffers = self.buffers.max(other.buffers);
        let (a, b) = (&mut self.stages, other.stages);
        a.camera += b.camera;
        a.closest += b.closest;
        a.sort += b.sort;
        a.prepare += b.prepare;
        a.material += b.material;
        a.advance += b.advance;
        a.shadow += b.shadow;
        a.film += b.film;
    }
}
