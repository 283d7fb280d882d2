//! Lambert: the same radiance in every direction [Lambert1760].

use brdf::{Brdf, DirectionSample, DirectionSampler, LANES, Lanes3, SampleLanes, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_1_PI;

use crate::half::{MIN_COS, above};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};
use crate::{lanes, lobe};

/// f = albedo / pi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert<const N: usize> {
    /// Reflected share per channel, [0, 1].
    pub albedo: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "lambert",
    title: "the same radiance in every direction",
    formula: "kd/pi",
    citation: "Lambert1760",
    parameters: &[Parameter::base("kd", "diffuse albedo", 0.5)],
    laws: Laws::KEPT,
    examples: &["", "kd=1", "kd=0.2/0.1/0.05"],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(Lambert {
        albedo: values.channels("kd"),
    })
}

impl<const N: usize> Brdf<N> for Lambert<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if above(wi, wo) {
            self.albedo.map(|a| a * FRAC_1_PI)
        } else {
            [0.0; N]
        }
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    #[inline(always)]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        let above = lanes::above(wi, wo);
        self.albedo
            .map(|a| above.map(|m| m * (a * FRAC_1_PI) as f32))
    }
}

impl<const N: usize> DirectionSampler for Lambert<N> {
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

    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        let wi = lanes::cosine(u);
        let pdf = lanes::cosine_pdf(&wi, wo);
        SampleLanes { wi, pdf }
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        lanes::cosine_pdf(wi, wo)
    }
}
