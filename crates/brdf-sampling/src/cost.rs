//! What a sampler costs, one call at a time and in packets.

use brdf::{DirectionSampler, LANES, Lanes3, direction};
use glam::{DVec2, DVec3};
use pulp::{Simd, WithSimd};
use sampling::Rng;
use std::hint::black_box;
use std::time::Instant;

/// Time of one direction, by the clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplerCost {
    /// Nanoseconds of sampling.
    pub sample_ns: f64,
    /// Nanoseconds of the density.
    pub pdf_ns: f64,
}

/// Directions timed together: enough that the clock does not count, few enough that inputs stay in the cache.
const BATCH: usize = 1024;

/// Times calls one after another on this thread for viewers all over the hemisphere: the best of `runs` batches of 1024.
#[must_use]
pub fn sampler_cost(sampler: &dyn DirectionSampler, runs: usize) -> SamplerCost {
    let calls = SingleCalls::new(sampler, BATCH);
    SamplerCost {
        sample_ns: best_of(runs, calls.inputs.len(), || calls.sample(sampler)),
        pdf_ns: best_of(runs, calls.pairs.len(), || calls.pdf(sampler)),
    }
}

/// The same a direction when [`LANES`] are asked for at once, with the widest instructions there are: as renderers call a
/// sampler.
#[must_use]
pub fn packet_cost<S: DirectionSampler>(sampler: &S, runs: usize) -> SamplerCost {
    let calls = PacketCalls::new(sampler, BATCH);
    SamplerCost {
        sample_ns: best_of(runs, BATCH, || calls.sample(sampler)),
        pdf_ns: best_of(runs, BATCH, || calls.pdf(sampler)),
    }
}

/// Viewers all over the hemisphere but its last degrees.
fn viewer(rng: &mut Rng) -> DVec3 {
    direction(1.5 * rng.uniform(), 6.0 * rng.uniform())
}

/// What single calls are made with.
#[derive(Clone, Debug)]
pub struct SingleCalls {
    inputs: Vec<(DVec3, DVec2)>,
    pairs: Vec<(DVec3, DVec3)>,
}

impl SingleCalls {
    /// `count` viewers, and pairs of what `sampler` draws for them.
    #[must_use]
    pub fn new(sampler: &dyn DirectionSampler, count: usize) -> Self {
        let mut rng = Rng::new(5);
        let inputs: Vec<_> = (0..count)
            .map(|_| (viewer(&mut rng), rng.uniform2()))
            .collect();
        let pairs = inputs
            .iter()
            .filter_map(|(wo, u)| Some((sampler.sample(*wo, *u)?.wi, *wo)))
            .collect();
        Self { inputs, pairs }
    }

    /// Draws once for every viewer.
    pub fn sample(&self, sampler: &dyn DirectionSampler) {
        for (wo, u) in &self.inputs {
            black_box(sampler.sample(*wo, *u));
        }
    }

    /// Asks for the density of every pair.
    pub fn pdf(&self, sampler: &dyn DirectionSampler) {
        for (wi, wo) in &self.pairs {
            black_box(sampler.pdf(*wi, *wo));
        }
    }
}

/// What calls in packets are made with.
#[derive(Clone, Debug)]
pub struct PacketCalls {
    inputs: Vec<(Lanes3, [[f32; LANES]; 2])>,
    pairs: Vec<(Lanes3, Lanes3)>,
}

impl PacketCalls {
    /// `count` viewers, a multiple of [`LANES`], and pairs of what `sampler` draws for them.
    #[must_use]
    pub fn new<S: DirectionSampler>(sampler: &S, count: usize) -> Self {
        let mut rng = Rng::new(4);
        let mut packet = || {
            let (mut wo, mut u) = (Lanes3::ZERO, [[0.0; LANES]; 2]);
            for k in 0..LANES {
                wo.set(k, viewer(&mut rng).as_vec3());
                for list in &mut u {
                    list[k] = (rng.uniform() as f32).min(1.0 - f32::EPSILON);
                }
            }
            (wo, u)
        };
        let inputs: Vec<_> = (0..count / LANES).map(|_| packet()).collect();
        let pairs = inputs
            .iter()
            .map(|(wo, u)| (sampler.sample_lanes(wo, u).wi, *wo))
            .collect();
        Self { inputs, pairs }
    }

    /// Draws once for every viewer.
    pub fn sample<S: DirectionSampler>(&self, sampler: &S) {
        brdf::arch().dispatch(Samples(sampler, &self.inputs));
    }

    /// Asks for the density of every pair.
    pub fn pdf<S: DirectionSampler>(&self, sampler: &S) {
        brdf::arch().dispatch(Densities(sampler, &self.pairs));
    }
}

struct Samples<'a, S>(&'a S, &'a [(Lanes3, [[f32; LANES]; 2])]);

impl<S: DirectionSampler> WithSimd for Samples<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) {
        for (wo, u) in self.1 {
            black_box(self.0.sample_lanes(wo, u));
        }
    }
}

struct Densities<'a, S>(&'a S, &'a [(Lanes3, Lanes3)]);

impl<S: DirectionSampler> WithSimd for Densities<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) {
        for (wi, wo) in self.1 {
            black_box(self.0.pdf_lanes(wi, wo));
        }
    }
}

fn best_of(runs: usize, calls: usize, batch: impl Fn()) -> f64 {
    let one = |_| {
        let start = Instant::now();
        batch();
        start.elapsed().as_secs_f64() * 1e9 / calls.max(1) as f64
    };
    (0..runs.max(1)).map(one).fold(f64::INFINITY, f64::min)
}
