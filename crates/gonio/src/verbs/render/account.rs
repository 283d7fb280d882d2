//! Where the time and the memory of a render went.

use super::Traced;
use crate::output::say;
use crate::process;
use scene_io::BuiltScene;
use scene_io::spectral::AnyScene;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

/// Wall-clock seconds of the stages of a render, one after the other; [`MaterialRow`] divides `materials`.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Seconds {
    /// Reading and checking the scene file.
    scene: f64,
    /// Reading measured files, making their tables and samplers.
    materials: f64,
    /// Reading meshes and pictures.
    meshes: f64,
    /// Trees, light tables.
    build: f64,
    /// The pilot that chooses how light is found.
    strategy: f64,
    /// Passes over the picture, with the estimates between them.
    trace: f64,
    /// Of these, the estimates.
    rows: f64,
    /// The error estimate of the whole.
    estimate: f64,
    /// Writing pictures.
    write: f64,
}

/// Divides time into stages.
pub(super) struct Clock {
    last: Instant,
    pub(super) seconds: Seconds,
}

impl Clock {
    pub(super) fn new() -> Self {
        Self {
            last: Instant::now(),
            seconds: Seconds::default(),
        }
    }

    /// Seconds since the last lap.
    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let passed = now - self.last;
        self.last = now;
        passed.as_secs_f64()
    }

    pub(super) fn scene_read(&mut self) {
        self.seconds.scene = self.lap();
    }

    pub(super) fn built<S>(&mut self, built: &BuiltScene<S>) {
        let all = self.lap();
        let [meshes, build] = built.seconds;
        self.seconds.meshes = meshes;
        self.seconds.build = build;
        self.seconds.materials = (all - meshes - build).max(0.0);
    }

    pub(super) fn strategy_chosen(&mut self) {
        self.seconds.strategy = self.lap();
    }

    pub(super) fn traced(&mut self, traced: &Traced) {
        self.seconds.trace = self.lap();
        self.seconds.rows = traced.rows_seconds;
    }

    pub(super) fn estimated(&mut self) {
        self.seconds.estimate = self.lap();
    }

    pub(super) fn written(&mut self) {
        self.seconds.write = self.lap();
    }
}

impl Seconds {
    /// Says where time went.
    pub(super) fn explain(&self) {
        say(format_args!(
            "seconds: scene file {:.3}, materials {:.3}, meshes {:.3}, build {:.3}, light strategy {:.3}, trace {:.3} (of it estimates {:.3}), last estimate {:.3}, pictures {:.3}",
            self.scene,
            self.materials,
            self.meshes,
            self.build,
            self.strategy,
            self.trace,
            self.rows,
            self.estimate,
            self.write
        ));
    }

    /// Until rendering begins.
    pub(super) fn before(&self) -> f64 {
        self.scene + self.materials + self.meshes + self.build
    }
}

/// A material in use.
#[derive(Serialize)]
pub(super) struct MaterialRow {
    name: String,
    file: Option<PathBuf>,
    sampler: String,
    table_bytes: usize,
    sampler_bytes: usize,
    read_seconds: f64,
    sampler_seconds: f64,
}

pub(super) fn materials(built: &BuiltScene<AnyScene>) -> Vec<MaterialRow> {
    let row = |m: &scene_io::MaterialReport| MaterialRow {
        name: m.name.clone(),
        file: m.file.clone(),
        sampler: m.sampler.name.to_string(),
        table_bytes: m.table_bytes,
        sampler_bytes: m.sampler.bytes,
        read_seconds: m.seconds[0],
        sampler_seconds: m.seconds[1],
    };
    built.materials.iter().map(row).collect()
}

/// Seconds of all threads by stage of the stream.
pub(super) fn threads(traced: &Traced) -> BTreeMap<&'static str, f64> {
    let rows = traced.stats.stages.rows();
    rows.map(|(name, time)| (name, time.as_secs_f64())).into()
}

/// Bytes a render needs at once by arithmetic, and what the system saw (docs/performance.md).
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Memory {
    /// Sums of the film: 8 x channels x replicates a pixel.
    film: usize,
    /// Pictures on their way to files.
    pictures: usize,
    /// Tables of reflectance.
    tables: usize,
    samplers: usize,
    /// Trees, leaves and normals of triangles.
    triangles: usize,
    /// A picture around the scene.
    environment: usize,
    /// Buffers of the workers.
    workers: usize,
    /// What was needed to build trees, before there was a film.
    building: usize,
    /// The program itself.
    program: usize,
    /// All that is there at once, while it renders or while it is built.
    sum: usize,
    /// The largest resident size so far, where the system says.
    peak: Option<u64>,
}

/// Resident before anything is loaded: code, the runtime, thread stacks. Measured.
const PROGRAM: usize = 14 << 20;

/// Of a pixel on its way to files: colour and variance in f32.
const PICTURE_BYTES: usize = 12 + 12;

/// The nine planes of its EXR in f32.
const PLANE_BYTES: usize = 36;

/// Of a channel of a film of other channels than linear sRGB: its mean in f64 and its plane in f32.
const CHANNEL_BYTES: usize = 8 + 4;

impl Memory {
    /// Says where memory went.
    pub(super) fn explain(&self) {
        let mb = |bytes: usize| bytes as f64 / 1e6;
        let peak = self.peak.map_or_else(String::new, |peak| {
            format!(", seen {:.1}", peak as f64 / 1e6)
        });
        say(format_args!(
            "memory, MB: film {:.1}, pictures {:.1}, tables {:.1}, samplers {:.1}, triangles {:.1}, environment {:.1}, workers {:.1}, program {:.1}, at first to build {:.1}, in all {:.1}{peak}",
            mb(self.film),
            mb(self.pictures),
            mb(self.tables),
            mb(self.samplers),
            mb(self.triangles),
            mb(self.environment),
            mb(self.workers),
            mb(self.program),
            mb(self.building),
            mb(self.sum)
        ));
    }

    pub(super) fn new(built: &BuiltScene<AnyScene>, traced: &Traced) -> Self {
        let scene = built.scene.bytes();
        let pixels = built.size.0 as usize * built.size.1 as usize;
        // a film of other channels has a twin in linear sRGB, for the estimates and the PNG, which goes before its planes come
        let (film, twin) = (traced.film.bytes(), traced.film.twin_bytes());
        let own = match twin {
            0 => PLANE_BYTES * pixels,
            twin => twin.max(traced.film.channels() * pixels * CHANNEL_BYTES),
        };
        let mut memory = Self {
            film,
            pictures: PICTURE_BYTES * pixels + own,
            tables: built.materials.iter().map(|m| m.table_bytes).sum(),
            samplers: built.materials.iter().map(|m| m.sampler.bytes).sum(),
            triangles: scene.triangles,
            environment: scene.environment,
            workers: traced.stats.buffers as usize,
            building: scene.building,
            program: PROGRAM,
            sum: 0,
            peak: process::peak_bytes(),
        };
        let rendering = memory.film + memory.pictures + memory.triangles + memory.workers;
        memory.sum = memory.tables
            + memory.samplers
            + memory.environment
            + memory.program
            + rendering.max(memory.building);
        memory
    }
}
