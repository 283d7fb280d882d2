//! Phong's cosine power about the mirror direction, as he wrote it and as Lewis made it physical.
//!
//! [Phong1975], [Lewis1994]; sampling [LafortuneWillems1994].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

use crate::half::above;
use crate::lobe::{SpecularLobe, combine, cos_power, power_lobe, power_lobe_pdf, share};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};

/// Which of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhongForm {
    /// ks (r.wo)^n / ci: Phong's shading formula read as a reflectance. Neither reciprocal nor bounded.
    Classic,
    /// ks (n + 2)/(2 pi) (r.wo)^n: reciprocal, reflects ks at normal incidence and less elsewhere.
    Lewis,
}

/// A cosine power about the mirror direction and a Lambert lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong<const N: usize> {
    /// Exponent n, [0, 1e6].
    pub exponent: f64,
    /// Weight of the lobe per channel.
    pub specular: [f64; N],
    /// Albedo of the Lambert lobe.
    pub diffuse: [f64; N],
    /// The normalisation.
    pub form: PhongForm,
}

const PARAMETERS: &[Parameter] = &[
    Parameter::exponent("n", "exponent of the cosine", 50.0),
    Parameter::weight("ks", "weight of the lobe", 0.5),
    Parameter::base("kd", "albedo of the Lambert lobe", 0.3),
];

const EXAMPLES: &[&str] = &[
    "n=50,ks=0.3,kd=0.5/0.3/0.1",
    "n=1,ks=1,kd=0",
    "n=3000,ks=0.9,kd=0.1",
];

pub(crate) const CLASSIC: ModelInfo = ModelInfo {
    name: "phong",
    title: "Phong 1975, for reference: neither reciprocal nor energy conserving",
    formula: "kd/pi + ks (r.wo)_+^n / ci, r = wi mirrored at the normal",
    citation: "Phong1975",
    parameters: PARAMETERS,
    laws: Laws {
        reciprocal: false,
        conserves_energy: false,
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: EXAMPLES,
};

pub(crate) const LEWIS: ModelInfo = ModelInfo {
    name: "lewis",
    title: "Phong normalised by Lewis: reciprocal, energy conserving",
    formula: "kd/pi + ks (n+2)/(2 pi) (r.wo)_+^n",
    citation: "Lewis1994",
    laws: Laws {
        sampler_complete: false,
        ..Laws::KEPT
    },
    ..CLASSIC
};

fn build<const N: usize>(values: &Values, form: PhongForm) -> Built<N> {
    Built::new(Phong {
        exponent: values.scalar("n"),
        specular: values.channels("ks"),
        diffuse: values.channels("kd"),
        form,
    })
}

pub(crate) fn build_classic<const N: usize>(values: &Values) -> Built<N> {
    build(values, PhongForm::Classic)
}

pub(crate) fn build_lewis<const N: usize>(values: &Values) -> Built<N> {
    build(values, PhongForm::Lewis)
}

/// `w` mirrored at the surface normal.
#[inline]
fn mirror(w: DVec3) -> DVec3 {
    DVec3::new(-w.x, -w.y, w.z)
}

impl<const N: usize> Brdf<N> for Phong<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if !above(wi, wo) {
            return [0.0; N];
        }
        let scale = match self.form {
            PhongForm::Classic => 1.0 / wi.z,
            PhongForm::Lewis => (self.exponent + 2.0) / TAU,
        };
        let lobe = scale * cos_power(mirror(wo), wi, self.exponent);
        combine(&self.diffuse, &self.specular, lobe)
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: true,
            reciprocal: self.form == PhongForm::Lewis,
        }
    }
}

impl<const N: usize> SpecularLobe for Phong<N> {
    #[inline]
    fn probability(&self, _wo: DVec3) -> f64 {
        share(&self.specular, &self.diffuse)
    }

    #[inline]
    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        power_lobe(mirror(wo), self.exponent, u)
    }

    #[inline]
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        power_lobe_pdf(mirror(wo), self.exponent, wi)
    }
}

impl<const N: usize> DirectionSampler for Phong<N> {
    /// `None` also where the direction about the mirror direction lies below the horizon.
    #[inline]
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        self.sample_mixture(wo, u)
    }

    #[inline]
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.mixture_pdf(wi, wo)
    }
}
