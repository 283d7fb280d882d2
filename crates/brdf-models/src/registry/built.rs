//! A constructed model, in the three shapes its users ask for.

use brdf::{Brdf, DirectionSampler, Material, Paired};
use std::fmt;
use std::sync::Arc;

use super::{ModelInfo, Role, Values, build};

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

/// One lobe of a model.
#[expect(missing_debug_implementations, reason = "trait objects have none")]
pub struct Lobe<const N: usize> {
    /// The weight it has in the model: `ks`, `kd`, `ks2` ...
    pub weight: String,
    /// The model with this weight 1 in every channel and the others 0.
    pub brdf: Arc<dyn Brdf<N>>,
}

impl<const N: usize> ParsedModel<N> {
    /// The model taken apart at its shapes: f = f_0 + sum_j w_j (f_j - f_0), channel by channel, with f_j the
    /// lobe of weight j and f_0 the `rest`, which has all weights 0.
    ///
    /// The rest is 0 everywhere but for models that say otherwise in their documentation; models without
    /// weights have no lobes, and are all rest. This is what a fit solves for w by linear least squares.
    #[must_use]
    pub fn lobes(&self) -> (Arc<dyn Brdf<N>>, Vec<Lobe<N>>) {
        let with = |one: Option<&str>| {
            let mut values = self.values.clone();
            for entry in &mut values.entries {
                if self.info.role(&entry.name) == Role::Weight {
                    entry.numbers = vec![f64::from(u8::from(one == Some(&*entry.name)))];
                }
            }
            build::<N>(self.info.name, &values)
                .map_or_else(|| Arc::clone(&self.built.brdf), |b| b.brdf)
        };
        let weights = self.values.iter().map(|(name, _)| name);
        let lobes = weights
            .filter(|name| self.info.role(name) == Role::Weight)
            .map(|name| Lobe {
                weight: name.to_owned(),
                brdf: with(Some(name)),
            });
        let lobes = lobes.collect();
        (with(None), lobes)
    }
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
