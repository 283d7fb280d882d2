//! A quick look that tells slow samplers.

use brdf::{DirectionSampler, direction};
use brdf_sampling::SamplerCost;
use sampling::Rng;
use std::hint::black_box;
use std::time::Instant;

/// Seconds of the quick look.
const SECONDS: f64 = 0.2;
/// Calls of it at most.
const CALLS: usize = 1 << 14;

/// The mean cost over as many calls as fit into a fifth of a second.
pub(super) fn probe(sampler: &dyn DirectionSampler) -> SamplerCost {
    let mut rng = Rng::new(3);
    let mut pairs = Vec::new();
    let start = Instant::now();
    let mut calls = 0;
    while calls == 0 || (calls < CALLS && start.elapsed().as_secs_f64() < SECONDS) {
        let wo = direction(1.5 * rng.uniform(), 6.0 * rng.uniform());
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
