//! Ashikhmin-Shirley: an anisotropic Phong lobe of the half vector over a coupled diffuse base
//! [AshikhminShirley2000].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, TAU};

use crate::half::{Half, from_tan2, reflect};
use crate::lobe::{SpecularLobe, share};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};

/// What lies under the lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AshikhminBase {
    /// The paper's base, which loses what the lobe takes.
    Coupled,
    /// Lambert, which does not know the lobe: how [Ngan2005] fitted the model.
    Lambert,
}

/// A lobe with Schlick's Fresnel term over a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AshikhminShirley<const N: usize> {
    /// Exponent along x, [0, 1e6].
    pub exponent_x: f64,
    /// Exponent along y, [0, 1e6].
    pub exponent_y: f64,
    /// Reflectance of the facets at normal incidence, per channel.
    pub f0: [f64; N],
    /// Weight of the lobe per channel; 1 in the paper.
    pub specular: [f64; N],
    /// Reflectance of the base per channel, before the lobe takes its part.
    pub diffuse: [f64; N],
    /// The base.
    pub base: AshikhminBase,
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "ashikhmin-shirley",
    title: "anisotropic Phong lobe over a coupled diffuse base",
    formula: "sqrt((nx+1)(ny+1))/(8 pi) hz^(nx cos^2 p + ny sin^2 p) F(h.wi) / ((h.wi) max(ci, co)) + 28 kd/(23 pi) (1-ks) (1-(1-ci/2)^5) (1-(1-co/2)^5), F = ks + (1-ks)(1-h.wi)^5",
    citation: "AshikhminShirley2000",
    parameters: &[
        EXPONENT,
        EXPONENT_X,
        EXPONENT_Y,
        Parameter::albedo("ks", "reflectance of the lobe at normal incidence", 0.05),
        Parameter::base("kd", "reflectance of the base", 0.5),
    ],
    laws: Laws {
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "n=100,ks=0.05,kd=0.5/0.3/0.1",
        "nx=10,ny=1000,ks=0.5,kd=0.8",
        "n=1,ks=1,kd=0",
        "n=10000,ks=0,kd=1",
    ],
};

pub(crate) const LOBE: ModelInfo = ModelInfo {
    name: "ashikhmin-lobe",
    title: "the lobe of Ashikhmin and Shirley over Lambert, both with a weight, as Ngan fitted it",
    formula: "kd/pi + ks sqrt((nx+1)(ny+1))/(8 pi) hz^(nx cos^2 p + ny sin^2 p) F(h.wi) / ((h.wi) max(ci, co)), F = f0 + (1-f0)(1-h.wi)^5",
    citation: "Ngan2005",
    parameters: &[
        EXPONENT,
        EXPONENT_X,
        EXPONENT_Y,
        Parameter::albedo("f0", "reflectance of the facets at normal incidence", 0.05),
        Parameter::weight("ks", "weight of the lobe", 1.0),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.0),
    ],
    examples: &[
        "n=100,f0=0.3,ks=0.5,kd=0.5/0.3/0.1",
        "nx=10,ny=1000,f0=1,ks=0.5,kd=0.5",
        "n=3000,f0=0.05",
    ],
    ..INFO
};

const EXPONENT: Parameter = Parameter::exponent("n", "exponent", 100.0);
const EXPONENT_X: Parameter = Parameter {
    range: (0.0, 1e6),
    ..Parameter::same("nx", "exponent along x", "n")
};
const EXPONENT_Y: Parameter = Parameter {
    range: (0.0, 1e6),
    ..Parameter::same("ny", "exponent along y", "n")
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(AshikhminShirley {
        exponent_x: values.scalar("nx"),
        exponent_y: values.scalar("ny"),
        f0: values.channels("ks"),
        specular: [1.0; N],
        diffuse: values.channels("kd"),
        base: AshikhminBase::Coupled,
    })
}

pub(crate) fn build_lobe<const N: usize>(values: &Values) -> Built<N> {
    Built::new(AshikhminShirley {
        exponent_x: values.scalar("nx"),
        exponent_y: values.scalar("ny"),
        f0: values.channels("f0"),
        specular: values.channels("ks"),
        diffuse: values.channels("kd"),
        base: AshikhminBase::Lambert,
    })
}

/// Schlick's approximation [Schlick1994] per channel, from 1 - c, which near the pole c itself has lost.
#[inline]
fn schlick<const N: usize>(f0: &[f64; N], one_minus_c: f64) -> [f64; N] {
    let m = one_minus_c.powi(5);
    f0.map(|f| f + (1.0 - f) * m)
}

/// 1 - (1 - c/2)^5, without cancellation near the horizon.
#[inline]
fn base(c: f64) -> f64 {
    -(5.0 * (-0.5 * c).ln_1p()).exp_m1()
}

impl<const N: usize> AshikhminShirley<N> {
    /// sqrt((nx+1)(ny+1)) / (2 pi) hz^(nx cos^2 p + ny sin^2 p): the density of half vectors, 1/sr.
    #[inline]
    fn half_density(&self, half: &Half) -> f64 {
        let (x2, y2) = (half.h.x * half.h.x, half.h.y * half.h.y);
        // at the pole the power is 1 whatever the exponent
        let n = if x2 + y2 > 0.0 {
            (self.exponent_x * x2 + self.exponent_y * y2) / (x2 + y2)
        } else {
            0.0
        };
        let scale = ((self.exponent_x + 1.0) * (self.exponent_y + 1.0)).sqrt() / TAU;
        scale * (-0.5 * n * half.tan2().ln_1p()).exp()
    }

    /// What the base reflects before the angular factors.
    #[inline]
    fn base_albedo(&self) -> [f64; N] {
        match self.base {
            AshikhminBase::Coupled => std::array::from_fn(|c| self.diffuse[c] * (1.0 - self.f0[c])),
            AshikhminBase::Lambert => self.diffuse,
        }
    }
}

impl<const N: usize> Brdf<N> for AshikhminShirley<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let Some(half) = Half::new(wi, wo) else {
            return [0.0; N];
        };
        let cos_d = half.cos_d();
        let lobe = 0.25 * self.half_density(&half) / (cos_d * wi.z.max(wo.z));
        let under = match self.base {
            AshikhminBase::Coupled => 28.0 / 23.0 * FRAC_1_PI * base(wi.z) * base(wo.z),
            AshikhminBase::Lambert => FRAC_1_PI,
        };
        let f = schlick(&self.f0, half.sin2_d() / (1.0 + cos_d));
        let d = self.base_albedo();
        std::array::from_fn(|c| self.specular[c] * f[c] * lobe + d[c] * under)
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: self.exponent_x.to_bits() == self.exponent_y.to_bits(),
            reciprocal: true,
        }
    }
}

impl<const N: usize> SpecularLobe for AshikhminShirley<N> {
    #[inline]
    fn probability(&self, wo: DVec3) -> f64 {
        let f = schlick(&self.f0, 1.0 - wo.z.min(1.0));
        let weight: [f64; N] = std::array::from_fn(|c| self.specular[c] * f[c]);
        share(&weight, &self.base_albedo())
    }

    #[inline]
    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        // tan(phi) = sqrt((nx+1)/(ny+1)) tan(2 pi u.y), in every quadrant
        let (sin, cos) = (TAU * u.y).sin_cos();
        let (x, y) = (
            (self.exponent_y + 1.0).sqrt() * cos,
            (self.exponent_x + 1.0).sqrt() * sin,
        );
        let len = x.hypot(y);
        let (cos_phi, sin_phi) = (x / len, y / len);
        let n = self.exponent_x * cos_phi * cos_phi + self.exponent_y * sin_phi * sin_phi;
        // cos = (1-u)^(1/(n+1)), hence tan^2 = (1-u)^(-2/(n+1)) - 1
        let tan2 = (-2.0 * (-u.x).ln_1p() / (n + 1.0)).exp_m1();
        reflect(wo, from_tan2(tan2, cos_phi, sin_phi))
    }

    #[inline]
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        Half::new(wi, wo).map_or(0.0, |half| {
            self.half_density(&half) / (2.0 * half.len2.sqrt())
        })
    }
}

impl<const N: usize> DirectionSampler for AshikhminShirley<N> {
    /// `None` also where the mirrored direction would lie below the horizon.
    #[inline]
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        self.sample_mixture(wo, u)
    }

    #[inline]
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.mixture_pdf(wi, wo)
    }
}
