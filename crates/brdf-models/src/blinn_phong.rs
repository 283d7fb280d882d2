//! Blinn-Phong: a cosine power of the half angle [Blinn1977], normalised exactly at normal incidence.

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

use crate::half::{Half, reflect};
use crate::lobe::{SpecularLobe, combine, power_lobe, share};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};

/// f = kd/pi + ks (n+2)(n+4) / (8 pi (2^(-n/2) + n)) (n.h)^n.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlinnPhong<const N: usize> {
    /// Exponent n, [0, 1e6].
    pub exponent: f64,
    /// Albedo of the lobe at normal incidence, per channel.
    pub specular: [f64; N],
    /// Albedo of the Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "blinn-phong",
    title: "cosine power of the half angle, normalised at normal incidence",
    formula: "kd/pi + ks (n+2)(n+4) / (8 pi (2^(-n/2) + n)) (n.h)^n",
    citation: "Blinn1977",
    parameters: &[
        Parameter::exponent("n", "exponent of the cosine", 100.0),
        Parameter::weight("ks", "albedo of the lobe at normal incidence", 0.5),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.3),
    ],
    laws: Laws {
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "n=100,ks=0.3,kd=0.5/0.3/0.1",
        "n=2,ks=1,kd=0",
        "n=3000,ks=0.9,kd=0.1",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(BlinnPhong {
        exponent: values.scalar("n"),
        specular: values.channels("ks"),
        diffuse: values.channels("kd"),
    })
}

/// (n.h)^n from tan^2, so that exponents of 1e6 keep their digits.
#[inline]
fn power(half: &Half, n: f64) -> f64 {
    (-0.5 * n * half.tan2().ln_1p()).exp()
}

impl<const N: usize> Brdf<N> for BlinnPhong<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        Half::new(wi, wo).map_or([0.0; N], |half| {
            let n = self.exponent;
            let scale = (n + 2.0) * (n + 4.0) / (8.0 * PI * ((-0.5 * n).exp2() + n));
            combine(&self.diffuse, &self.specular, scale * power(&half, n))
        })
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> SpecularLobe for BlinnPhong<N> {
    #[inline]
    fn probability(&self, _wo: DVec3) -> f64 {
        share(&self.specular, &self.diffuse)
    }

    #[inline]
    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        reflect(wo, power_lobe(DVec3::Z, self.exponent, u))
    }

    #[inline]
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        // over 4 (h.wo) = 2 |H|
        Half::new(wi, wo).map_or(0.0, |half| {
            (self.exponent + 1.0) / TAU * power(&half, self.exponent) / (2.0 * half.len2.sqrt())
        })
    }
}

impl<const N: usize> DirectionSampler for BlinnPhong<N> {
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
