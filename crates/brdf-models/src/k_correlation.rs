//! Smooth-surface scatter from a K-correlation power spectral density [Church1989], [Dittman2006].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, PI};

use crate::half::above;
use crate::he::LAMBDA;
use crate::lobe::{SpecularLobe, share};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};
use crate::shift_invariant::{PowerDisc, ShiftedLobe, distance2, total_integrated_scatter};

/// f = kd/pi + R ci co (16 pi^2/lambda^4) PSD(|beta - beta0|/lambda), by the vector perturbation theory of
/// [Stover2012] with its polarisation factor at the value it has near the mirror direction, the reflectance R.
///
/// PSD(v) = sigma^2 B^2 (s - 2)/(2 pi (1 + (B v)^2)^(s/2)), whose integral over the plane is sigma^2. Holds for
/// (4 pi sigma/lambda)^2 << 1; the light that is mirrored, 1 - TIS, is no part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KCorrelation<const N: usize> {
    /// Root mean square roughness sigma over all spatial frequencies, nm, [0, 1000].
    pub sigma_nm: f64,
    /// B, micrometres: the shoulder is at the spatial frequency 1/B, [0.01, 1e5].
    pub b_um: f64,
    /// s, the slope of the spectral density beyond the shoulder, (2, 10].
    pub slope: f64,
    /// Wavelength of each channel, nm.
    pub lambda_nm: [f64; N],
    /// Reflectance R of the smooth surface per channel.
    pub specular: [f64; N],
    /// Albedo of an added Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "k-correlation",
    title: "smooth-surface scatter from a K-correlation spectral density",
    formula: "kd/pi + ks ci co (4 pi sigma/lambda)^2 u^2 (s-2)/(2 pi) (1 + u^2 |beta - beta0|^2)^(-s/2), u = b/lambda, beta = (ix, iy), beta0 = (-ox, -oy)",
    citation: "Dittman2006",
    parameters: &[
        Parameter {
            unit: "nm",
            ..Parameter::scalar("sigma", "root mean square roughness", (0.0, 1000.0), 5.0)
        },
        Parameter {
            unit: "um",
            ..Parameter::scalar(
                "b",
                "inverse of the spatial frequency of the shoulder",
                (0.01, 1e5),
                20.0,
            )
        },
        Parameter::scalar("s", "slope of the spectral density", (2.001, 10.0), 2.5),
        LAMBDA,
        Parameter::weight("ks", "reflectance of the smooth surface", 1.0),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.0),
    ],
    laws: Laws {
        conserves_energy: false,
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "sigma=10,b=10,s=2.5,lambda=rgb",
        "sigma=60,b=5,s=3,kd=0.1",
        "sigma=30,b=1,s=4,ks=0.9/0.6/0.3,lambda=rgb,kd=0.1",
        "sigma=1,b=0.05,s=6,lambda=193",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(KCorrelation {
        sigma_nm: values.scalar("sigma"),
        b_um: values.scalar("b"),
        slope: values.scalar("s"),
        lambda_nm: values.channels("lambda"),
        specular: values.channels("ks"),
        diffuse: values.channels("kd"),
    })
}

impl<const N: usize> KCorrelation<N> {
    /// The spectral density of channel `c` in direction cosines.
    #[inline]
    fn disc(&self, c: usize) -> PowerDisc {
        PowerDisc {
            shoulder: 1e-3 * self.lambda_nm[c] / self.b_um,
            slope: -self.slope,
        }
    }

    #[inline]
    fn lobe(&self) -> ShiftedLobe<PowerDisc, N> {
        ShiftedLobe(std::array::from_fn(|c| self.disc(c)))
    }

    /// (4 pi sigma/lambda)^2.
    #[inline]
    fn phase2(&self, c: usize) -> f64 {
        (4.0 * PI * self.sigma_nm / self.lambda_nm[c]).powi(2)
    }

    /// Root mean square roughness that light of each wavelength sees at normal incidence, nm: spatial frequencies
    /// up to 1/lambda, sigma^2 (1 - (1 + (B/lambda)^2)^(1 - s/2)).
    #[must_use]
    pub fn relevant_roughness_nm(&self) -> [f64; N] {
        std::array::from_fn(|c| {
            let span = (1.0 / self.disc(c).shoulder).powi(2).ln_1p();
            let seen = -((1.0 - 0.5 * self.slope) * span).exp_m1();
            self.sigma_nm * seen.sqrt()
        })
    }

    /// Total integrated scatter for small angles, R (4 pi sigma_rel cos/lambda)^2 [Davies1954], at the cosine `c` of
    /// the angle of incidence: an upper bound of [`Self::tis`] at normal incidence, reached by narrow scatter.
    #[must_use]
    pub fn tis_small_angles(&self, cos: f64) -> [f64; N] {
        let seen = self.relevant_roughness_nm();
        std::array::from_fn(|c| {
            let x = 4.0 * PI * seen[c] * cos / self.lambda_nm[c];
            self.specular[c] * x * x
        })
    }

    /// Total integrated scatter of light from `wo` per channel, without the Lambert lobe, to about 1e-4.
    #[must_use]
    pub fn tis(&self, wo: DVec3) -> [f64; N] {
        total_integrated_scatter(self, &self.diffuse, wo)
    }
}

impl<const N: usize> Brdf<N> for KCorrelation<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if !above(wi, wo) {
            return [0.0; N];
        }
        let r2 = distance2(wi, wo);
        std::array::from_fn(|c| {
            let disc = self.disc(c);
            let u = 1.0 / disc.shoulder;
            let peak = self.phase2(c) * u * u * (self.slope - 2.0) * 0.5 * FRAC_1_PI;
            let lobe = wi.z * wo.z * peak * disc.shape(r2);
            self.diffuse[c] * FRAC_1_PI + self.specular[c] * lobe
        })
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> SpecularLobe for KCorrelation<N> {
    #[inline]
    fn probability(&self, wo: DVec3) -> f64 {
        share(&self.tis_small_angles(wo.z.min(1.0)), &self.diffuse)
    }

    #[inline]
    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        self.lobe().sample(wo, u)
    }

    #[inline]
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.lobe().pdf(wi, wo)
    }
}

impl<const N: usize> DirectionSampler for KCorrelation<N> {
    /// `None` also where the direction cosines leave the unit disc.
    #[inline]
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        self.sample_mixture(wo, u)
    }

    #[inline]
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.mixture_pdf(wi, wo)
    }
}

#[cfg(test)]
mod tests {
    use super::KCorrelation;
    use brdf::{Brdf, direction};
    use glam::DVec3;
    use testkit::assert_relative;
    use testkit::integrate::hemisphere;

    fn model(b_um: f64, slope: f64) -> KCorrelation<2> {
        KCorrelation {
            sigma_nm: 4.0,
            b_um,
            slope,
            lambda_nm: [633.0, 400.0],
            specular: [0.9, 0.5],
            diffuse: [0.0; 2],
        }
    }

    #[test]
    fn narrow_scatter_has_the_total_of_small_angles() {
        // shoulder at 1/3000: what scatters beyond 20 degrees is a millionth
        let narrow = model(2000.0, 4.0);
        for (exact, bound) in (narrow.tis(DVec3::Z).into_iter()).zip(narrow.tis_small_angles(1.0)) {
            // the cosine of the scattered direction, averaged: 1 - O(l^2 ln(1/l))
            assert_relative(exact, bound, 1e-3, "TIS");
        }
        let wo = direction(0.9, 0.4);
        let (exact, bound) = (narrow.tis(wo)[0], narrow.tis_small_angles(wo.z)[0]);
        assert_relative(exact, bound, 1e-3, "oblique TIS");
    }

    #[test]
    fn wide_scatter_matches_quadrature() {
        let wide = model(0.5, 3.0);
        for theta in [0.0, 0.7] {
            let wo = direction(theta, 0.0);
            let expected = hemisphere(|i| wide.eval(DVec3::from_array(i), wo)[0] * i[2], 60);
            // the lattice over the edge of the unit disc
            assert_relative(wide.tis(wo)[0], expected, 3e-4, "TIS");
        }
    }
}
