//! Nanoseconds of sampling: a quick look that tells slow samplers, and packets compiled for this machine.

use brdf::{DirectionSampler, LANES, Lanes3, direction};
use brdf_sampling::SamplerCost;
use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};
use sampling::Rng;
use std::hint::black_box;
use std::time::Instant;

/// Nanoseconds a direction when [`LANES`] are asked for at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PacketCost {
    /// Of sampling.
    pub sample_ns: f64,
    /// Of the density.
    pub pdf_ns: f64,
}

/// Seconds of the quick look.
const QUICK_SECONDS: f64 = 0.2;
/// Calls of it at most.
const QUICK_CALLS: usize = 1 << 14;
/// Packets timed together: 1024 directions, whose inputs stay in the cache.
const PACKETS: usize = 64;

/// Viewers all over the hemisphere but its last degrees, as [`brdf_sampling::sampler_cost`] takes them.
fn viewer(rng: &mut Rng) -> DVec3 {
    direction(1.5 * rng.uniform(), 6.0 * rng.uniform())
}

/// The mean cost over as many calls as fit into a fifth of a second.
pub(super) fn probe(sampler: &dyn DirectionSampler) -> SamplerCost {
    let mut rng = Rng::new(3);
    let mut pairs = Vec::new();
    let start = Instant::now();
    let mut calls = 0;
    while calls == 0 || (calls < QUICK_CALLS && start.elapsed().as_secs_f64() < QUICK_SECONDS) {
        let wo = viewer(&mut rng);
        pairs.extend(sampler.sample(wo, rng.uniform2()).map(|s| (s.wi, wo)));
        calls += 1;
    }
    let sample_ns = start.elapsed().as_secs_f64() * 1e9 / calls as f64;
    let start = Instant::now();
    for (wi, wo) in &pairs {
        black_box(sampler.pdf(*wi, *wo));
    }
    SamplerCost {
        sample_ns,
        pdf_ns: start.elapsed().as_secs_f64() * 1e9 / pairs.len().max(1) as f64,
    }
}

/// The best of `runs` batches in packets, with the widest instructions there are: as renderers call a sampler.
pub(super) fn packets<S: DirectionSampler>(sampler: &S, runs: usize) -> PacketCost {
    let mut rng = Rng::new(4);
    let inputs: Vec<(Lanes3, [[f32; LANES]; 2])> = (0..PACKETS)
        .map(|_| {
            let (mut wo, mut u) = (Lanes3::ZERO, [[0.0; LANES]; 2]);
            for k in 0..LANES {
                wo.set(k, viewer(&mut rng).as_vec3());
                (u[0][k], u[1][k]) = (rng.uniform() as f32, rng.uniform() as f32);
            }
            (wo, u.map(|lane| lane.map(|v| v.min(1.0 - f32::EPSILON))))
        })
        .collect();
    let pairs: Vec<(Lanes3, Lanes3)> = (inputs.iter())
        .map(|(wo, u)| (sampler.sample_lanes(wo, u).wi, *wo))
        .collect();
    let arch = Arch::new();
    PacketCost {
        sample_ns: best_of(runs, || arch.dispatch(Samples(sampler, &inputs))),
        pdf_ns: best_of(runs, || arch.dispatch(Densities(sampler, &pairs))),
    }
}

fn best_of(runs: usize, batch: impl Fn()) -> f64 {
    let one = |_| {
        let start = Instant::now();
        batch();
        start.elapsed().as_secs_f64() * 1e9 / (PACKETS * LANES) as f64
    };
    (0..runs.max(1)).map(one).fold(f64::INFINITY, f64::min)
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
