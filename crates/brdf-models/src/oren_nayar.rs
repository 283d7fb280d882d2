//! Oren-Nayar in full: rough diffuse V-cavities with one interreflection [OrenNayar1994].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

use crate::half::{MIN_COS, above};
use crate::lobe;
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};

/// The full model of the paper, not the shortened one that most renderers use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayar<const N: usize> {
    /// Albedo of the facets per channel.
    pub albedo: [f64; N],
    /// Standard deviation of the facets' slope angle in radians, [0, pi/2].
    pub sigma: f64,
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "oren-nayar",
    title: "rough diffuse facets with one interreflection, the full model",
    formula: "kd/pi (C1 + cos p C2 tan b + (1-|cos p|) C3 tan((a+b)/2)) + 0.17 kd^2/pi s^2/(s^2+0.13) (1 - cos p (2b/pi)^2)",
    citation: "OrenNayar1994",
    parameters: &[
        Parameter::albedo("kd", "albedo of the facets", 0.5),
        Parameter {
            unit: "rad",
            ..Parameter::scalar(
                "sigma",
                "standard deviation of the facets' slope angle",
                (0.0, std::f64::consts::FRAC_PI_2),
                0.3,
            )
        },
    ],
    laws: Laws {
        conserves_energy: false,
        ..Laws::KEPT
    },
    examples: &[
        "kd=0.5/0.3/0.1,sigma=0.3",
        "kd=0.8,sigma=0",
        "kd=1,sigma=0.3",
        "kd=1,sigma=1",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(OrenNayar {
        albedo: values.channels("kd"),
        sigma: values.scalar("sigma"),
    })
}

impl<const N: usize> OrenNayar<N> {
    /// The factors of kd/pi and of kd^2/pi.
    #[inline]
    fn shape(&self, wi: DVec3, wo: DVec3) -> (f64, f64) {
        let s2 = self.sigma * self.sigma;
        let (si, so) = (wi.x.hypot(wi.y), wo.x.hypot(wo.y));
        // seen from the pole every azimuth is the same
        let product = si * so;
        let (cos_phi, sin_phi) = if product > 0.0 {
            let cos = (wi.x * wo.x + wi.y * wo.y) / product;
            (cos.clamp(-1.0, 1.0), (wi.x * wo.y - wi.y * wo.x) / product)
        } else {
            (0.0, 1.0)
        };
        // 1 - |cos p|, which the tangent at grazing angles multiplies by 1e7
        let across = sin_phi * sin_phi / (1.0 + cos_phi.abs());
        let (ti, to) = (si.atan2(wi.z), so.atan2(wo.z));
        let (a, b) = (ti.max(to), ti.min(to));
        // tan b = sin b / cos b with b the smaller angle; tan((a + b)/2) without any angle
        let tan_b = si.min(so) / wi.z.max(wo.z);
        let tan_mean = (si + so) / (wi.z + wo.z);
        let two_b = FRAC_2_PI * b;
        let c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
        let k = s2 / (s2 + 0.09);
        let sin_a = si.max(so);
        let rise = if cos_phi < 0.0 {
            // sin a - (2b/pi)^3 vanishes for opposite grazing directions: from 1 - 2b/pi and 1 - sin a
            let rest = FRAC_2_PI * wi.z.max(wo.z).atan2(si.min(so));
            let cos_a = wi.z.min(wo.z);
            rest * (1.0 + two_b + two_b * two_b) - cos_a * cos_a / (1.0 + sin_a)
        } else {
            sin_a
        };
        let c2 = 0.45 * k * rise;
        let c3 = 0.125 * k * (FRAC_2_PI * FRAC_2_PI * a * b).powi(2);
        let direct = c1 + cos_phi * c2 * tan_b + across * c3 * tan_mean;
        let twice = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * two_b * two_b);
        (direct, twice)
    }
}

impl<const N: usize> Brdf<N> for OrenNayar<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if !above(wi, wo) {
            return [0.0; N];
        }
        let (direct, twice) = self.shape(wi, wo);
        // the fitted terms of the paper dip below zero at grazing angles on very rough surfaces
        self.albedo
            .map(|rho| rho * FRAC_1_PI * (direct + rho * twice).max(0.0))
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> DirectionSampler for OrenNayar<N> {
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
