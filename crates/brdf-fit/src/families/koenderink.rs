//! Koenderink and van Doorn's basis of an order: weights of either sign and no shape [Koenderink1998].

use super::{channels, whole};
use crate::family::{Family, Lobes, Part, ShapeParameter, Weight};
use brdf_models::KoenderinkBasis;
use glam::DVec3;

/// Orders 2 (5 functions) and 8 (55), those published for CUReT.
pub(super) const NAMES: [&str; 2] = ["koenderink-2", "koenderink-8"];

pub(super) struct KoenderinkVanDoorn {
    name: &'static str,
    basis: KoenderinkBasis,
    weights: Vec<Weight>,
}

impl KoenderinkVanDoorn {
    pub(super) fn new(name: &str) -> Self {
        let (name, order) = if name == NAMES[0] {
            (NAMES[0], 2)
        } else {
            (NAMES[1], 8)
        };
        let basis = KoenderinkBasis::new(order);
        let weight = |name: String| Weight { name, signed: true };
        let names = (1..basis.len()).map(|k| super::numbered("a", k - 1));
        Self {
            name,
            weights: std::iter::once("kd".into())
                .chain(names)
                .map(weight)
                .collect(),
            basis,
        }
    }
}

/// The basis with its constant, 1/(2 pi), as 1/pi: the weight is an albedo.
struct Functions(KoenderinkBasis);

impl Lobes for Functions {
    fn eval(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) {
        self.0.eval(wi, wo, out);
        out[0] *= 2.0;
    }
}

impl Family for KoenderinkVanDoorn {
    fn name(&self) -> &str {
        self.name
    }

    fn shape(&self) -> &[ShapeParameter] {
        &[]
    }

    fn weights(&self) -> &[Weight] {
        &self.weights
    }

    fn lobes(&self, _shape: &[f64]) -> Box<dyn Lobes> {
        Box::new(Functions(self.basis.clone()))
    }

    fn parts(&self, _shape: &[f64], weights: &[Vec<f64>]) -> Vec<Part> {
        let values = (self.weights.iter().enumerate())
            .map(|(k, w)| format!("{}={}", w.name, channels(weights, k)));
        let values: Vec<String> = values.collect();
        vec![whole(
            format!("koenderink:{}", values.join(",")),
            weights.len(),
        )]
    }
}
