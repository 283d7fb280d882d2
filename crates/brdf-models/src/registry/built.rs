//! A constructed model, in the three shapes its users ask for.

use brdf::{Brdf, DirectionSampler, Material, Paired};
use std::fmt;
use std::sync::Arc;

use super::{ModelInfo, Values};

/// What the surface does, how directions are chosen for it, and the two as one material.
#[expect(missing_debug_implementations, reason = "trait objects have none")]
pub struct Built<const N: usize> {
    /// What the surface does.
    pub brdf: Arc<dyn Brdf<N>>,
    /// The model's own sampler, exact.
    pub sampler: Arc<dyn DirectionSampler>,
    /// Both, compiled together: what a renderer holds.
    pub material: Box<dyn Material<N>>,
}

impl<const N: usize> Built<N> {
    /// Wraps a model that is its own sampler.
    pub(crate) fn new<M: Brdf<N> + DirectionSampler + 'static>(model: M) -> Self {
        let model = Arc::new(model);
        Self {
            brdf: Arc::clone(&model) as Arc<dyn Brdf<N>>,
            sampler: Arc::clone(&model) as Arc<dyn DirectionSampler>,
            material: Box::new(Paired {
                brdf: Arc::clone(&model),
                sampler: model,
            }),
        }
    }
}

/// A model made from text.
pub struct ParsedModel<const N: usize> {
    /// Its entry in the registry.
    pub info: &'static ModelInfo,
    /// Every parameter with the value used, defaults included.
    pub values: Values,
    /// The model.
    pub built: Built<N>,
}

impl<const N: usize> fmt::Debug for ParsedModel<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}

/// The text that gives the same model again, nothing left to default: `ward:alpha=0.15,...`.
impl<const N: usize> fmt::Display for ParsedModel<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.info.name, self.values)
    }
}
