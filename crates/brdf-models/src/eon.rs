//! EON: Oren-Nayar made energy preserving [Portsmouth2025].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, PI};

use crate::half::{MIN_COS, above};
use crate::lobe;
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};

/// 1/2 - 2/(3 pi): what single scattering loses at grazing incidence, per unit of roughness.
const C1: f64 = 0.5 - 2.0 / (3.0 * PI);
/// 2/3 - 28/(15 pi): the mean of G/pi over the hemisphere.
const C2: f64 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// Fujii's Oren-Nayar plus the energy it loses, given back by a reciprocal lobe. White facets reflect all
/// light at every angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eon<const N: usize> {
    /// Albedo of the facets per channel.
    pub albedo: [f64; N],
    /// Roughness r, [0, 1]; 0 is Lambert.
    pub roughness: f64,
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "eon",
    title: "energy-preserving Oren-Nayar",
    formula: "kd/pi A (1 + r s/t) + kd_ms/pi (1 - E(ci)) (1 - E(co)) / (1 - <E>), s = wi.wo - ci co, t = s > 0 ? max(ci, co) : 1, A = 1/(1 + (1/2 - 2/(3 pi)) r)",
    citation: "Portsmouth2025",
    parameters: &[
        Parameter::albedo("kd", "albedo of the facets", 0.5),
        Parameter::scalar("r", "roughness", (0.0, 1.0), 0.5),
    ],
    laws: Laws::KEPT,
    examples: &["kd=0.5/0.3/0.1,r=0.5", "kd=1,r=1", "kd=0.8,r=0"],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(Eon {
        albedo: values.channels("kd"),
        roughness: values.scalar("r"),
    })
}

/// C1 - G/pi: the directional loss of single scattering is A r times this.
///
/// Written about the horizon, where it vanishes like the cosine: with m = cos, s = sin and pi/2 - theta = asin m,
/// pi/2 - 2/3 - G = (pi/2 - 2/3) m^2/(1 + s) + s asin m + s^2 m - 2/3 s m (1 + s + s^2)/(1 + s).
#[inline]
fn loss(w: DVec3) -> f64 {
    let (mu, si) = (w.z, w.x.hypot(w.y));
    let linear =
        si * mu.atan2(si) + si * si * mu - 2.0 / 3.0 * si * mu * (1.0 + si + si * si) / (1.0 + si);
    (C1 * mu * mu / (1.0 + si) + FRAC_1_PI * linear).max(0.0)
}

impl<const N: usize> Brdf<N> for Eon<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if !above(wi, wo) {
            return [0.0; N];
        }
        let r = self.roughness;
        let s = wi.x * wo.x + wi.y * wo.y;
        let shape = if s > 0.0 {
            1.0 + r * s / wi.z.max(wo.z)
        } else {
            // 1 + s of unit vectors = (|h_xy|^2 + ci^2 + co^2)/2, which vanishes for opposite grazing directions
            let h = wi + wo;
            (1.0 - r) + 0.5 * r * (h.x * h.x + h.y * h.y + wi.z * wi.z + wo.z * wo.z)
        };
        let a = 1.0 / (1.0 + C1 * r);
        let single = FRAC_1_PI * a * shape;
        // (1 - E_i)(1 - E_o)/(1 - <E>) with A r taken out of each: nothing cancels as r -> 0
        let multiple = FRAC_1_PI * a * r * loss(wi) * loss(wo) / (C1 - C2);
        let mean = a * (1.0 + C2 * r);
        self.albedo.map(|rho| {
            let rho_ms = rho * rho * mean / (1.0 - rho * (1.0 - mean));
            rho * single + rho_ms * multiple
        })
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> DirectionSampler for Eon<N> {
    #[inline]
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let wi = lobe::cosine(u);
        let pdf = lobe::cosine_pdf(wi);
        (wo.z > MIN_COS && pdf > 0.0).then_some(DirectionSample { wi, pdf })
    }

    #[inline]
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if above(wi, wo) {
            lobe::cosine_pdf(wi)
        } else {
            0.0
        }
    }
}
