//! How directions are chosen on spectral surfaces: as on their linear sRGB twins.

use crate::cache::Cache;
use crate::error::Error;
use crate::material::{SamplerReport, Surface, Visitor};
use crate::scene::SamplerName;
use brdf::{DirectionSampler, Material, Paired, Tag, TaggedBrdf};
use brdf_sampling::Hvt;
use std::any::Any;
use std::sync::Arc;

/// Samplers of spectral materials: the usual one compiled with the reflectance, all others through a pointer, since
/// every pair is a program of its own.
pub(super) enum SpectralSampler {
    Hvt(Hvt),
    Other(Arc<dyn DirectionSampler>),
}

/// Keeps the sampler that comes.
struct Keep;

impl Visitor for Keep {
    type Out = (SpectralSampler, SamplerReport);

    fn visit<S: DirectionSampler + 'static>(self, sampler: S, report: SamplerReport) -> Self::Out {
        let bytes = sampler.bytes();
        let mut slot = Some(sampler);
        let hvt = (&mut slot as &mut dyn Any).downcast_mut::<Option<Hvt>>();
        let kept = match (hvt.and_then(Option::take), slot) {
            (Some(hvt), _) => SpectralSampler::Hvt(hvt),
            (None, Some(other)) => SpectralSampler::Other(Arc::new(other)),
            (None, None) => SpectralSampler::Other(Arc::new(brdf_sampling::Cosine)),
        };
        (kept, SamplerReport { bytes, ..report })
    }
}

/// A reflectance and its sampler as one material.
pub(super) fn paired<const N: usize, T: Tag>(
    brdf: impl TaggedBrdf<N, T> + 'static,
    sampler: SpectralSampler,
) -> Box<dyn Material<N, T>> {
    match sampler {
        SpectralSampler::Hvt(sampler) => Box::new(Paired { brdf, sampler }),
        SpectralSampler::Other(sampler) => Box::new(Paired { brdf, sampler }),
    }
}

/// The sampler `name` stands for.
pub(super) fn of(
    rgb: &Surface,
    name: SamplerName,
    cache: &Cache,
) -> Result<(SpectralSampler, SamplerReport), Error> {
    rgb.sampler(name, cache, Keep)
}
