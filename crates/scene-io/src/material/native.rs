//! Measurements that are rendered through their own answers, in their own channels.

use super::pair::{self, SamplerReport, Visitor};
use crate::cache::{Cache, combine};
use crate::error::Error;
use crate::scene::SamplerName;
use brdf::{Brdf, Material, Measured, Paired, Projected, Status};
use brdf_table::RglTable;
use glam::DVec3;
use std::sync::Arc;

/// A measurement that is asked in its own channels.
pub(super) struct Native {
    pub(super) brdf: Arc<dyn Brdf<3>>,
    measured: Arc<dyn Measured>,
    /// What one unit of each channel adds to linear sRGB.
    matrix: Vec<[f64; 3]>,
    /// The sampling that comes with the file.
    pub(super) sampler: Option<Arc<RglTable>>,
    /// What tells it from others.
    key: u64,
}

impl Native {
    pub(super) fn new(
        measured: Arc<dyn Measured>,
        key: u64,
        scale: [f64; 3],
    ) -> Result<Self, Error> {
        let mut matrix = measured.basis().to_linear_srgb();
        for row in &mut matrix {
            (0..3).for_each(|c| row[c] *= scale[c]);
        }
        let brdf = Projected::new(Arc::clone(&measured), matrix.clone()).ok_or_else(|| {
            Error::invalid("expected as many channels as the basis has, found others")
        })?;
        let bits = scale.map(f64::to_bits);
        Ok(Self {
            brdf: Arc::new(brdf),
            measured,
            matrix,
            sampler: None,
            key: combine(&[key, bits[0], bits[1], bits[2]]),
        })
    }

    pub(super) fn eval(&self, wi: DVec3, wo: DVec3) -> ([f64; 3], Status) {
        let mut native = vec![0.0; self.matrix.len()];
        let status = self.measured.eval_native(wi, wo, &mut native);
        let mut out = [0.0; 3];
        for (value, row) in native.iter().zip(&self.matrix) {
            (0..3).for_each(|c| out[c] += value * row[c]);
        }
        (out, status)
    }

    pub(super) fn material(
        self,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<(Box<dyn Material<3>>, SamplerReport), Error> {
        let brdf = self.brdf;
        match (name, self.sampler) {
            (SamplerName::Native, Some(sampler)) => {
                // the table itself
                let report = SamplerReport::new(SamplerName::Native, 0);
                Ok((Box::new(Paired { brdf, sampler }), report))
            }
            _ => pair::pair(brdf, name, (|_: &_| self.key, cache)),
        }
    }

    /// Hands the sampler `name` stands for to `visitor`.
    pub(super) fn sampler<V: Visitor>(
        &self,
        name: SamplerName,
        cache: &Cache,
        visitor: V,
    ) -> Result<V::Out, Error> {
        match (name, &self.sampler) {
            (SamplerName::Native, Some(sampler)) => {
                Ok(visitor.visit(Arc::clone(sampler), SamplerReport::new(name, 0)))
            }
            _ => pair::build(&self.brdf, name, (|_: &_| self.key, cache), visitor),
        }
    }
}
