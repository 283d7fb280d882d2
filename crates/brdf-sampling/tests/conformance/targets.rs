//! Reflectances that are hard to sample, each in its own way.

use brdf::{DirectionSampler, Symmetry};
use brdf_sampling::SharedTarget;
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

/// A reflectance with a name.
#[derive(Clone)]
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) f: SharedTarget,
    pub(crate) symmetry: Symmetry,
    /// The sampler the table's file brings along.
    pub(crate) own: Option<Arc<dyn DirectionSampler>>,
}

impl Case {
    pub(crate) fn new(
        name: &'static str,
        f: impl Fn(DVec3, DVec3) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self {
            name,
            f: Arc::new(f),
            symmetry: Symmetry::FULL,
            own: None,
        }
    }
}

/// D G2 / (4 cos cos) of an anisotropic GGX [Walter2007], without Fresnel.
fn ggx(ax: f64, ay: f64, wi: DVec3, wo: DVec3) -> f64 {
    let h = (wi + wo).normalize_or_zero();
    let q = (h.x / ax).powi(2) + (h.y / ay).powi(2) + h.z * h.z;
    let d = 1.0 / (std::f64::consts::PI * ax * ay * q * q);
    let lambda = |w: DVec3| {
        let t = ((ax * w.x).powi(2) + (ay * w.y).powi(2)) / (w.z * w.z);
        0.5 * ((1.0 + t).sqrt() - 1.0)
    };
    d / (4.0 * wi.z * wo.z * (1.0 + lambda(wi) + lambda(wo)))
}

/// A table-like function: steep ridges in half angles, piecewise linear between nodes, not symmetric about the
/// plane of incidence.
fn spiky(wi: DVec3, wo: DVec3) -> f64 {
    let hd = brdf::HalfDiff::new(wi, wo);
    // a triangle wave, 0 at integers and 1 halfway
    let zigzag = |x: f64| 1.0 - (2.0 * (x - x.floor()) - 1.0).abs();
    let ridges = zigzag(6.0 * hd.theta_h.sqrt())
        * (0.3 + zigzag(2.5 * hd.theta_d))
        * (0.3 + zigzag(2.0 * hd.phi_d / std::f64::consts::PI + 0.13));
    0.02 + 40.0 * ridges.powi(4) * (-4.0 * hd.theta_h).exp()
}

/// Every case.
pub(crate) fn all() -> Vec<Case> {
    let mut brushed = Case::new("brushed", |wi, wo| {
        0.05 * FRAC_1_PI + ggx(0.06, 0.3, wi, wo)
    });
    brushed.symmetry.isotropic = false;
    let mut one_way = Case::new("one-way", |wi, wo| {
        ggx(0.2, 0.2, wi, wo) * (0.2 + wi.z * wi.z) * (1.0 + 0.8 * wi.x * wo.y)
    });
    one_way.symmetry = Symmetry {
        isotropic: false,
        reciprocal: false,
    };
    vec![
        Case::new("lambert", |_, _| FRAC_1_PI),
        Case::new("ggx-0.3", |wi, wo| ggx(0.3, 0.3, wi, wo)),
        Case::new("ggx-0.05", |wi, wo| ggx(0.05, 0.05, wi, wo)),
        Case::new("ggx-0.005", |wi, wo| ggx(0.005, 0.005, wi, wo)),
        Case::new("spiky", spiky),
        brushed,
        one_way,
        Case::new("black", |_, _| 0.0),
        Case::new("nan", |wi, _| if wi.x > 0.0 { f64::NAN } else { -1.0 }),
        // nothing at all for most viewers
        Case::new("half-black", |_, wo| if wo.z > 0.5 { 1.0 } else { 0.0 }),
    ]
}
