//! Cook-Torrance, that is Torrance-Sparrow with Beckmann facets: in V-shaped grooves [CookTorrance1982],
//! [TorranceSparrow1967], or masked after Smith [Smith1967].
//!
//! The 1982 paper divides by pi and normalises D without it, a factor 4 too bright; this is the
//! consistent form [Walter2007]. Sampled by the visible normals of V-cavities [HeitzDEon2014].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_1_PI;

use crate::beckmann::{Cavities, grooves};
use crate::fresnel::Fresnel;
use crate::half::Half;
use crate::lobe::{SpecularLobe, share};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values, microfacet};
use crate::smith::Smith;

/// What facets hide of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Masking {
    /// V-shaped grooves as long as the surface [TorranceSparrow1967].
    Grooves,
    /// A random surface seen from each side in turn, G1(wi) G1(wo) [Smith1967], [Walter2007].
    Smith,
}

/// f = kd/pi + ks F D G / (4 ci co), D Beckmann, G by [`Masking`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookTorrance<const N: usize> {
    /// Root mean square slope times sqrt 2, [1e-4, 1].
    pub m: f64,
    /// What the facets hide of each other.
    pub masking: Masking,
    /// Reflectance of the facets.
    pub fresnel: Fresnel<N>,
    /// Weight of the lobe per channel, 1 for bare facets; at most 1 - `diffuse` keeps the energy.
    pub specular: [f64; N],
    /// Albedo of an added Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "cook-torrance",
    title: "Torrance-Sparrow with Beckmann microfacets in V-cavities",
    formula: "kd/pi + ks F D G / (4 ci co), D = exp(-tan^2 d/m^2)/(pi m^2 cos^4 d), G = min(1, 2 hz ci/h.wo, 2 hz co/h.wo)",
    citation: "CookTorrance1982",
    parameters: &[
        Parameter::roughness("m", "rms slope times sqrt 2", 0.2),
        microfacet::F0,
        microfacet::N,
        microfacet::K,
        microfacet::INDEX,
        Parameter::weight("ks", "weight of the lobe", 1.0),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.0),
    ],
    laws: Laws {
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "m=0.2,index=cu",
        "m=0.6,f0=0.05,ks=0.5,kd=0.5/0.3/0.1",
        "m=0.03",
        "m=1",
    ],
};

pub(crate) const SMITH: ModelInfo = ModelInfo {
    name: "cook-torrance-smith",
    title: "Beckmann microfacets with Smith masking, the short-wave limit of `he`",
    formula: "kd/pi + ks F D G1(wi) G1(wo) / (4 ci co), D = exp(-tan^2 d/m^2)/(pi m^2 cos^4 d), G1 = 1/(1 + (exp(-q^2)/(sqrt(pi) q) - erfc(q))/2), q = 1/(m tan t)",
    citation: "Walter2007",
    ..INFO
};

fn build<const N: usize>(values: &Values, masking: Masking) -> Built<N> {
    Built::new(CookTorrance {
        m: values.scalar("m"),
        masking,
        fresnel: microfacet::fresnel(values),
        specular: values.channels("ks"),
        diffuse: values.channels("kd"),
    })
}

pub(crate) fn build_grooves<const N: usize>(values: &Values) -> Built<N> {
    build(values, Masking::Grooves)
}

pub(crate) fn build_smith<const N: usize>(values: &Values) -> Built<N> {
    build(values, Masking::Smith)
}

impl<const N: usize> CookTorrance<N> {
    #[inline]
    const fn cavities(&self) -> Cavities {
        Cavities { m: self.m }
    }

    /// G/(4 ci co).
    #[inline]
    fn masking(&self, half: &Half, wi: DVec3, wo: DVec3) -> f64 {
        match self.masking {
            Masking::Grooves => grooves(half, wi, wo),
            Masking::Smith => {
                let (i, o) = (Smith::new(wi, self.m), Smith::new(wo, self.m));
                0.25 * i.g1_over_cos * o.g1_over_cos
            }
        }
    }
}

impl<const N: usize> Brdf<N> for CookTorrance<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let Some(half) = Half::new(wi, wo) else {
            return [0.0; N];
        };
        let d = self.cavities().ndf(&half);
        // the tail, where the exponential is 0, needs no masking
        let lobe = if d > 0.0 {
            d * self.masking(&half, wi, wo)
        } else {
            0.0
        };
        let f = self.fresnel.eval_at(half.cos_d(), half.sin2_d());
        std::array::from_fn(|c| self.diffuse[c] * FRAC_1_PI + self.specular[c] * f[c] * lobe)
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> SpecularLobe for CookTorrance<N> {
    #[inline]
    fn probability(&self, wo: DVec3) -> f64 {
        let f = self.fresnel.eval(wo.z.min(1.0));
        let weight: [f64; N] = std::array::from_fn(|c| self.specular[c] * f[c]);
        share(&weight, &self.diffuse)
    }

    /// Facets visible in grooves serve both maskings: Smith's is never larger than twice as open.
    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        self.cavities().sample(wo, u)
    }

    #[inline]
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        Half::new(wi, wo).map_or(0.0, |half| self.cavities().pdf(&half, wo))
    }
}

impl<const N: usize> DirectionSampler for CookTorrance<N> {
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
