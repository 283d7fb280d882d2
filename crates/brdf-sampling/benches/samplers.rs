//! Cost of building samplers, of drawing directions and of densities.
//!
//! Sampling and densities are measured in CPU time of the thread, so that a busy machine does not show; packets run
//! under the widest instruction set there is, as a renderer runs them.

use brdf::{DirectionSampler, LANES, Lanes3, direction};
use brdf_sampling::{Cosine, Hvt, Inversion, InversionOptions, Preset, Target, Uniform};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec2, DVec3};
use pulp::{Arch, Simd, WithSimd};
use sampling::Rng;
use std::hint::black_box;

mod cpu_time;

use cpu_time::CpuTime;

const COUNT: usize = 4096;

/// A gloss lobe 3 degrees wide over a diffuse floor; twenty nanoseconds, so that builds show the samplers.
fn gloss(wi: DVec3, wo: DVec3) -> f64 {
    let h = wi + wo;
    let q = 1.0 + (h.x * h.x + h.y * h.y) / (0.0025 * h.z * h.z);
    0.1 + 20.0 / (q * q)
}

/// A sampler compiled for packets of the widest instruction set.
trait Wide: DirectionSampler {
    fn sample_all(&self, arch: Arch, packets: &[(Lanes3, Pair)]);
    fn pdf_all(&self, arch: Arch, pairs: &[(Lanes3, Lanes3)]);
}

/// Two random numbers a lane.
type Pair = [[f32; LANES]; 2];

impl<S: DirectionSampler> Wide for S {
    fn sample_all(&self, arch: Arch, packets: &[(Lanes3, Pair)]) {
        arch.dispatch(Sampling(self, packets));
    }

    fn pdf_all(&self, arch: Arch, pairs: &[(Lanes3, Lanes3)]) {
        arch.dispatch(Densities(self, pairs));
    }
}

struct Sampling<'a, S>(&'a S, &'a [(Lanes3, Pair)]);

impl<S: DirectionSampler> WithSimd for Sampling<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<T: Simd>(self, _: T) {
        for (wo, u) in self.1 {
            black_box(self.0.sample_lanes(wo, u));
        }
    }
}

struct Densities<'a, S>(&'a S, &'a [(Lanes3, Lanes3)]);

impl<S: DirectionSampler> WithSimd for Densities<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<T: Simd>(self, _: T) {
        for (wi, wo) in self.1 {
            black_box(self.0.pdf_lanes(wi, wo));
        }
    }
}

fn samplers() -> Vec<(&'static str, Box<dyn Wide>)> {
    let target = Target::new(&gloss);
    vec![
        ("uniform", Box::new(Uniform)),
        ("cosine", Box::new(Cosine)),
        (
            "inversion",
            Box::new(Inversion::new(target, InversionOptions::default())),
        ),
        (
            "hvt-default",
            Box::new(Hvt::new(target, Preset::Default.options())),
        ),
        (
            "hvt-fine",
            Box::new(Hvt::new(target, Preset::Fine.options())),
        ),
    ]
}

fn scalar(c: &mut Criterion<CpuTime>) {
    let mut rng = Rng::new(1);
    let inputs: Vec<(DVec3, DVec2)> = (0..COUNT)
        .map(|_| {
            (
                direction(1.5 * rng.uniform(), 6.2 * rng.uniform()),
                rng.uniform2(),
            )
        })
        .collect();
    let mut group = c.benchmark_group("brdf-sampling/scalar");
    group.throughput(Throughput::Elements(COUNT as u64));
    for (name, sampler) in samplers() {
        group.bench_function(format!("sample/{name}"), |b| {
            b.iter(|| {
                for (wo, u) in &inputs {
                    black_box(sampler.sample(*wo, *u));
                }
            });
        });
        let pairs: Vec<(DVec3, DVec3)> = inputs
            .iter()
            .filter_map(|(wo, u)| Some((sampler.sample(*wo, *u)?.wi, *wo)))
            .collect();
        group.bench_function(format!("pdf/{name}"), |b| {
            b.iter(|| {
                for (wi, wo) in &pairs {
                    black_box(sampler.pdf(*wi, *wo));
                }
            });
        });
    }
    group.finish();
}

fn lanes(c: &mut Criterion<CpuTime>) {
    let mut rng = Rng::new(2);
    let (arch, mut packets) = (Arch::new(), Vec::new());
    for _ in 0..COUNT / LANES {
        let (mut wo, mut u) = (Lanes3::ZERO, [[0.0; LANES]; 2]);
        for k in 0..LANES {
            wo.set(
                k,
                direction(1.5 * rng.uniform(), 6.2 * rng.uniform()).as_vec3(),
            );
            u[0][k] = rng.uniform() as f32;
            u[1][k] = rng.uniform() as f32;
        }
        packets.push((wo, u));
    }
    let mut group = c.benchmark_group("brdf-sampling/lanes");
    group.throughput(Throughput::Elements(COUNT as u64));
    for (name, sampler) in samplers() {
        group.bench_function(format!("sample/{name}"), |b| {
            b.iter(|| {
                sampler.sample_all(arch, &packets);
            });
        });
        let pairs: Vec<_> = packets
            .iter()
            .map(|(wo, u)| (sampler.sample_lanes(wo, u).wi, *wo))
            .collect();
        group.bench_function(format!("pdf/{name}"), |b| {
            b.iter(|| {
                sampler.pdf_all(arch, &pairs);
            });
        });
    }
    group.finish();
}

fn build(c: &mut Criterion) {
    let target = Target::new(&gloss);
    let mut group = c.benchmark_group("brdf-sampling/build");
    group.sample_size(10);
    for preset in Preset::ALL {
        group.bench_function(format!("hvt/{preset:?}"), |b| {
            b.iter(|| Hvt::new(target, preset.options()));
        });
    }
    group.bench_function("inversion", |b| {
        b.iter(|| Inversion::new(target, InversionOptions::default()));
    });
    group.finish();
}

criterion_group! {
    name = cost;
    config = Criterion::default().with_measurement(CpuTime);
    targets = scalar, lanes
}
criterion_group!(building, build);
criterion_main!(cost, building);
