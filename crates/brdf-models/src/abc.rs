//! The ABC model of Loew and others: a power law of the half angle, fitted to the MERL materials [Low2012].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, TAU};

use crate::beckmann::grooves;
use crate::fresnel::Fresnel;
use crate::half::{Half, from_tan2, reflect};
use crate::lobe::{SpecularLobe, combine, share};
use crate::power_law::{ln_power, power_mass};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};

/// f = kd/pi + A F G / (pi ci co (1 + B (1 - hz))^C), G of V-cavities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abc<const N: usize> {
    /// A per channel, the weight of the lobe.
    pub a: [f64; N],
    /// B, inverse width of the lobe in 1 - cos, [1, 1e8].
    pub b: f64,
    /// C, fall-off of the tail, [0.01, 10].
    pub c: f64,
    /// Refractive index of the facets, a dielectric.
    pub index: f64,
    /// Albedo of the Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "abc",
    title: "power law of the half angle over V-cavities, Loew and others",
    formula: "kd/pi + a F(n) G / (pi ci co (1 + b (1 - hz))^c), G = min(1, 2 hz ci/h.wo, 2 hz co/h.wo)",
    citation: "Low2012",
    parameters: &[
        Parameter {
            range: (0.0, 1e6),
            ..Parameter::weight("a", "weight of the lobe", 20.0)
        },
        Parameter::scalar("b", "inverse width of the lobe", (1.0, 1e8), 1000.0),
        Parameter::scalar("c", "fall-off of the tail", (0.01, 10.0), 1.5),
        Parameter::scalar("n", "refractive index of the facets", (1.0, 1e3), 1.5),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.1),
    ],
    laws: Laws {
        conserves_energy: false,
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "a=51.7/37.9/27.4,b=10482,c=0.8167,n=2.2365,kd=0.0245/0.0223/0.0162",
        "a=1000,b=2000,c=1,n=10,kd=0.4",
        "a=0.1,b=12,c=0.024,n=1.04,kd=0.3",
        "a=300,b=5000,c=2.6,n=1.6,kd=0.1",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(Abc {
        a: values.channels("a"),
        b: values.scalar("b"),
        c: values.scalar("c"),
        index: values.scalar("n"),
        diffuse: values.channels("kd"),
    })
}

impl<const N: usize> Abc<N> {
    /// ln(1 + B (1 - hz)), with 1 - hz = sin^2/(1 + cos) so that narrow lobes keep their digits.
    #[inline]
    fn ln_base(&self, half: &Half) -> f64 {
        let len = half.len2.sqrt();
        let r2 = half.h.x * half.h.x + half.h.y * half.h.y;
        (self.b * r2 / (len * (len + half.h.z))).ln_1p()
    }

    #[inline]
    fn fresnel(&self, cos_d: f64) -> f64 {
        Fresnel::from_index([self.index], [0.0]).eval(cos_d)[0]
    }

    /// The integral of the lobe (1 + B v)^-C over v = 1 - hz from 0 to 1.
    #[inline]
    fn mass(&self) -> f64 {
        power_mass(1.0 - self.c, self.b.ln_1p()) / self.b
    }
}

impl<const N: usize> Brdf<N> for Abc<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        Half::new(wi, wo).map_or([0.0; N], |half| {
            let d = (-self.c * self.ln_base(&half)).exp();
            let f = self.fresnel(half.cos_d());
            let lobe = 4.0 * FRAC_1_PI * f * d * grooves(&half, wi, wo);
            combine(&self.diffuse, &self.a, lobe)
        })
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> SpecularLobe for Abc<N> {
    #[inline]
    fn probability(&self, wo: DVec3) -> f64 {
        // what a narrow lobe reflects at normal incidence, 8 A F times its mass
        let scale = 8.0 * self.fresnel(wo.z.min(1.0)) * self.mass();
        share(&self.a.map(|a| a * scale), &self.diffuse)
    }

    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        // v = 1 - hz with density (1 + B v)^-C, azimuth uniform
        let v = ln_power(u.x, 1.0 - self.c, self.b.ln_1p()).exp_m1() / self.b;
        let tan2 = v * (2.0 - v) / ((1.0 - v) * (1.0 - v)).max(f64::MIN_POSITIVE);
        let (sin, cos) = (TAU * u.y).sin_cos();
        reflect(wo, from_tan2(tan2, cos, sin))
    }

    #[inline]
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        Half::new(wi, wo).map_or(0.0, |half| {
            let d = (-self.c * self.ln_base(&half)).exp();
            // density of h over 4 (h.wo) = 2 |H|
            d / (TAU * self.mass() * 2.0 * half.len2.sqrt())
        })
    }
}

impl<const N: usize> DirectionSampler for Abc<N> {
    /// `None` also where the mirrored direction would lie below the horizon.
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        self.sample_mixture(wo, u)
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.mixture_pdf(wi, wo)
    }
}
