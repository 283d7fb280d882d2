//! The lobe of Ashikhmin and Shirley over a Lambert base, as fitted by Ngan and others.
//!
//! The published model ties the lobe's weight to its Fresnel term; [Ngan2005] gave it a weight of its own and a
//! Lambert base, which the published family is not part of. This is theirs: it can say how bright and how steep toward
//! grazing angles apart.

use super::registry::Sum;
use super::{build, exponent, lambert, numbered, reflectance};
use crate::family::{Channels, Family, Lobes, Part, ShapeParameter, Weight};

pub(super) const NAME: &str = "ashikhmin-shirley";

/// kd/pi + sum w (n + 1)/(8 pi) hz^n F(h.wi)/((h.wi) max(ci, co)), F Schlick's from f0.
pub(super) struct AshikhminShirley {
    shape: Vec<ShapeParameter>,
    weights: Vec<Weight>,
}

impl AshikhminShirley {
    pub(super) fn new(lobes: usize) -> Self {
        let weight = |name: String| Weight {
            name,
            signed: false,
        };
        Self {
            shape: (0..lobes)
                .flat_map(|lobe| [exponent(lobe), reflectance("f0", lobe)])
                .collect(),
            weights: std::iter::once(weight("kd".into()))
                .chain((0..lobes).map(|lobe| weight(numbered("w", lobe))))
                .collect(),
        }
    }

    /// The model's `ks` is the reflectance at normal incidence of its lobe.
    fn text(lobe: &[f64]) -> String {
        format!("{NAME}:n={},ks={},kd=0", lobe[0], lobe[1])
    }
}

impl Family for AshikhminShirley {
    fn name(&self) -> &'static str {
        NAME
    }

    fn shape(&self) -> &[ShapeParameter] {
        &self.shape
    }

    fn weights(&self) -> &[Weight] {
        &self.weights
    }

    fn lobes(&self, shape: &[f64]) -> Box<dyn Lobes> {
        let lobe = |s: &[f64]| Channels(build::<1>(&Self::text(s)).built.brdf);
        Box::new(Sum(shape.chunks_exact(2).map(lobe).collect()))
    }

    fn parts(&self, shape: &[f64], weights: &[Vec<f64>]) -> Vec<Part> {
        let lobes = shape.chunks_exact(2).enumerate().map(|(j, s)| Part {
            text: Self::text(s),
            scale: weights.iter().map(|w| w[1 + j]).collect(),
        });
        std::iter::once(lambert(weights, 0)).chain(lobes).collect()
    }
}
