//! A material pairs what the surface does with how directions are chosen for it.
//!
//! Renderers hold `Box<dyn Material<N>>` and hand it whole streams of packets, so that one virtual call
//! serves hundreds of paths and everything below it is compiled for the concrete pair.

use crate::arch::arch;
use crate::contract::DirectionSampler;
use crate::lanes::{LANES, Lanes3};
use crate::tag::{Tag, TaggedBrdf};
use pulp::{Simd, WithSimd};

/// [`LANES`] evaluations: directions in, f cos and pdf out.
#[derive(Clone, Debug)]
pub struct EvalPacket<const N: usize, T: Tag = ()> {
    /// What the channels of each lane are.
    pub tag: [T; LANES],
    /// Toward the viewer.
    pub wo: Lanes3,
    /// Toward the light.
    pub wi: Lanes3,
    /// f_r(wi, wo) * max(cos wi, 0), per channel, lane by lane.
    pub f_cos: [[f32; LANES]; N],
    /// Density with which [`Material::sample`] would have chosen `wi`, 1/sr.
    pub pdf: [f32; LANES],
}

/// [`LANES`] samplings: viewer and random numbers in, direction, density and weight out.
#[derive(Clone, Debug)]
pub struct SamplePacket<const N: usize, T: Tag = ()> {
    /// What the channels of each lane are.
    pub tag: [T; LANES],
    /// Toward the viewer.
    pub wo: Lanes3,
    /// Two numbers in [0, 1) a lane.
    pub u: [[f32; LANES]; 2],
    /// Sampled direction toward the light.
    pub wi: Lanes3,
    /// Its density, 1/sr; 0 = no sample.
    pub pdf: [f32; LANES],
    /// f cos / pdf per channel; 0 where `pdf` is 0.
    pub weight: [[f32; LANES]; N],
}

impl<const N: usize, T: Tag> EvalPacket<N, T> {
    /// A packet of zeros.
    pub const ZERO: Self = Self {
        tag: [T::FIRST; LANES],
        wo: Lanes3::ZERO,
        wi: Lanes3::ZERO,
        f_cos: [[0.0; LANES]; N],
        pdf: [0.0; LANES],
    };
}

impl<const N: usize, T: Tag> SamplePacket<N, T> {
    /// A packet of zeros.
    pub const ZERO: Self = Self {
        tag: [T::FIRST; LANES],
        wo: Lanes3::ZERO,
        u: [[0.0; LANES]; 2],
        wi: Lanes3::ZERO,
        pdf: [0.0; LANES],
        weight: [[0.0; LANES]; N],
    };
}

/// What a renderer sees of a surface.
///
/// Directions are chosen without regard to the channels: where paths carry several wavelengths, all share one density,
/// the balance heuristic over them gives each the same weight, and nothing is left to be weighed. A sampler that
/// follows one wavelength would need it.
pub trait Material<const N: usize, T: Tag = ()>: Send + Sync {
    /// Fills `f_cos` and `pdf` of every packet.
    fn eval(&self, packets: &mut [EvalPacket<N, T>]);
    /// Fills `wi`, `pdf` and `weight` of every packet.
    fn sample(&self, packets: &mut [SamplePacket<N, T>]);

    /// Bytes of the tables of its reflectance.
    fn table_bytes(&self) -> usize {
        0
    }
}

/// The usual material: a [`Brdf`](crate::Brdf) (or [`TaggedBrdf`]) and the [`DirectionSampler`] chosen for it.
#[derive(Clone, Copy, Debug)]
pub struct Paired<B, S> {
    /// What the surface does.
    pub brdf: B,
    /// How directions are chosen.
    pub sampler: S,
}

impl<const N: usize, T: Tag, B: TaggedBrdf<N, T>, S: DirectionSampler> Material<N, T>
    for Paired<B, S>
{
    fn eval(&self, packets: &mut [EvalPacket<N, T>]) {
        arch().dispatch(Eval(self, packets));
    }

    fn sample(&self, packets: &mut [SamplePacket<N, T>]) {
        arch().dispatch(Sample(self, packets));
    }

    fn table_bytes(&self) -> usize {
        self.brdf.table_bytes()
    }
}

/// Evaluations to be compiled for each instruction set and run with the widest there is.
///
/// What a reflectance and a sampler declare `#[inline(always)]` is compiled with them; the rest still works. Results
/// are the same bits, since no step is fused.
struct Eval<'a, B, S, T: Tag, const N: usize>(&'a Paired<B, S>, &'a mut [EvalPacket<N, T>]);

impl<const N: usize, T: Tag, B: TaggedBrdf<N, T>, S: DirectionSampler> WithSimd
    for Eval<'_, B, S, T, N>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) {
        let Self(pair, packets) = self;
        for p in packets {
            p.f_cos = pair.brdf.eval_tagged(&p.wi, &p.wo, &p.tag);
            for c in 0..N {
                for k in 0..LANES {
                    p.f_cos[c][k] *= p.wi.z[k].max(0.0);
                }
            }
            p.pdf = pair.sampler.pdf_lanes(&p.wi, &p.wo);
        }
    }
}

/// Samplings, like [`Eval`].
struct Sample<'a, B, S, T: Tag, const N: usize>(&'a Paired<B, S>, &'a mut [SamplePacket<N, T>]);

impl<const N: usize, T: Tag, B: TaggedBrdf<N, T>, S: DirectionSampler> WithSimd
    for Sample<'_, B, S, T, N>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) {
        let Self(pair, packets) = self;
        for p in packets {
            let s = pair.sampler.sample_lanes(&p.wo, &p.u);
            let f = pair.brdf.eval_tagged(&s.wi, &p.wo, &p.tag);
            for c in 0..N {
                for k in 0..LANES {
                    let w = f[c][k] * s.wi.z[k].max(0.0) / s.pdf[k];
                    p.weight[c][k] = if s.pdf[k] > 0.0 { w } else { 0.0 };
                }
            }
            p.wi = s.wi;
            p.pdf = s.pdf;
        }
    }
}
