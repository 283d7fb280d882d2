//! A material pairs what the surface does with how directions are chosen for it.
//!
//! Renderers hold `Box<dyn Material<N>>` and hand it whole streams of packets, so that one virtual call
//! serves hundreds of paths and everything below it is compiled for the concrete pair.

use crate::contract::{Brdf, DirectionSampler};
use crate::lanes::{LANES, Lanes3};

/// [`LANES`] evaluations: directions in, f cos and pdf out.
#[derive(Clone, Debug)]
pub struct EvalPacket<const N: usize> {
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
pub struct SamplePacket<const N: usize> {
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

impl<const N: usize> EvalPacket<N> {
    /// A packet of zeros.
    pub const ZERO: Self = Self {
        wo: Lanes3::ZERO,
        wi: Lanes3::ZERO,
        f_cos: [[0.0; LANES]; N],
        pdf: [0.0; LANES],
    };
}

impl<const N: usize> SamplePacket<N> {
    /// A packet of zeros.
    pub const ZERO: Self = Self {
        wo: Lanes3::ZERO,
        u: [[0.0; LANES]; 2],
        wi: Lanes3::ZERO,
        pdf: [0.0; LANES],
        weight: [[0.0; LANES]; N],
    };
}

/// What a renderer sees of a surface.
pub trait Material<const N: usize>: Send + Sync {
    /// Fills `f_cos` and `pdf` of every packet.
    fn eval(&self, packets: &mut [EvalPacket<N>]);
    /// Fills `wi`, `pdf` and `weight` of every packet.
    fn sample(&self, packets: &mut [SamplePacket<N>]);
}

/// The usual material: a [`Brdf`] and the [`DirectionSampler`] chosen for it.
#[derive(Clone, Copy, Debug)]
pub struct Paired<B, S> {
    /// What the surface does.
    pub brdf: B,
    /// How directions are chosen.
    pub sampler: S,
}

impl<const N: usize, B: Brdf<N>, S: DirectionSampler> Material<N> for Paired<B, S> {
    fn eval(&self, packets: &mut [EvalPacket<N>]) {
        for p in packets {
            p.f_cos = self.brdf.eval_lanes(&p.wi, &p.wo);
            for channel in &mut p.f_cos {
                for (f, z) in channel.iter_mut().zip(p.wi.z) {
                    *f *= z.max(0.0);
                }
            }
            p.pdf = self.sampler.pdf_lanes(&p.wi, &p.wo);
        }
    }

    fn sample(&self, packets: &mut [SamplePacket<N>]) {
        for p in packets {
            let s = self.sampler.sample_lanes(&p.wo, &p.u);
            let f = self.brdf.eval_lanes(&s.wi, &p.wo);
            for (weight, f) in p.weight.iter_mut().zip(f) {
                for k in 0..LANES {
                    let w = f[k] * s.wi.z[k].max(0.0) / s.pdf[k];
                    weight[k] = if s.pdf[k] > 0.0 { w } else { 0.0 };
                }
            }
            p.wi = s.wi;
            p.pdf = s.pdf;
        }
    }
}
