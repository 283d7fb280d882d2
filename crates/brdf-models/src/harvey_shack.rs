//! Harvey and Shack's shift-invariant scatter [Harvey1976]: a shoulder and a slope in direction cosines.

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};

use crate::half::above;
use crate::lobe::{SpecularLobe, combine, share};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};
use crate::shift_invariant::{PowerDisc, ShiftedLobe, distance2, total_integrated_scatter};

/// f = kd/pi + b0 (1 + (|beta - beta0|/l)^2)^(s/2).
///
/// The light that is mirrored, 1 - TIS, is no part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarveyShack<const N: usize> {
    /// Peak b0 per channel, 1/sr.
    pub peak: [f64; N],
    /// Shoulder l in direction cosines, [1e-5, 10].
    pub shoulder: f64,
    /// Slope s beyond the shoulder, [-10, 0].
    pub slope: f64,
    /// Albedo of an added Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "harvey-shack",
    title: "shift-invariant scatter of polished surfaces, Harvey and Shack",
    formula: "kd/pi + b0 (1 + (|beta - beta0|/l)^2)^(s/2), beta = (ix, iy), beta0 = (-ox, -oy)",
    citation: "Harvey1976",
    parameters: &[
        Parameter {
            range: (0.0, 1e9),
            unit: "1/sr",
            ..Parameter::weight("b0", "peak, the weight of the lobe", 1.0)
        },
        Parameter::scalar("l", "shoulder, in direction cosines", (1e-5, 10.0), 0.01),
        Parameter::scalar("s", "slope beyond the shoulder", (-10.0, 0.0), -1.5),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.0),
    ],
    laws: Laws {
        conserves_energy: false,
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "b0=100,l=0.02,s=-2.5",
        "b0=3/2/1,l=0.05,s=-2,kd=0.2",
        "b0=0.5,l=0.5,s=0",
        "b0=500,l=0.05,s=-4,kd=0.1",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(HarveyShack {
        peak: values.channels("b0"),
        shoulder: values.scalar("l"),
        slope: values.scalar("s"),
        diffuse: values.channels("kd"),
    })
}

impl<const N: usize> HarveyShack<N> {
    #[inline]
    const fn disc(&self) -> PowerDisc {
        PowerDisc {
            shoulder: self.shoulder,
            slope: self.slope,
        }
    }

    #[inline]
    const fn lobe(&self) -> ShiftedLobe<PowerDisc, 1> {
        ShiftedLobe([self.disc()])
    }

    /// Total integrated scatter of light from `wo` per channel, without the Lambert lobe, to about 1e-4.
    #[must_use]
    pub fn tis(&self, wo: DVec3) -> [f64; N] {
        total_integrated_scatter(self, &self.diffuse, wo)
    }

    /// Total integrated scatter at normal incidence in closed form,
    /// 2 pi b0 l^2 ((1 + 1/l^2)^(s/2+1) - 1)/(s + 2).
    #[must_use]
    pub fn tis_normal(&self) -> [f64; N] {
        let mass = self.disc().mass(1.0);
        self.peak.map(|b0| b0 * mass)
    }
}

impl<const N: usize> Brdf<N> for HarveyShack<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if !above(wi, wo) {
            return [0.0; N];
        }
        let shape = self.disc().shape(distance2(wi, wo));
        combine(&self.diffuse, &self.peak, shape)
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> SpecularLobe for HarveyShack<N> {
    #[inline]
    fn probability(&self, _wo: DVec3) -> f64 {
        share(&self.tis_normal(), &self.diffuse)
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

impl<const N: usize> DirectionSampler for HarveyShack<N> {
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
    use super::HarveyShack;
    use brdf::direction;
    use glam::DVec3;
    use testkit::assert_relative;

    #[test]
    fn total_scatter_at_normal_incidence() {
        for (shoulder, slope) in [(0.01, -1.5), (0.1, -2.0), (1.0, -0.5), (0.5, 0.0)] {
            let model = HarveyShack {
                peak: [2.0],
                shoulder,
                slope,
                diffuse: [0.3],
            };
            // the lattice over the edge of the unit disc
            assert_relative(model.tis(DVec3::Z)[0], model.tis_normal()[0], 3e-4, "TIS");
        }
        let flat = HarveyShack {
            peak: [0.25],
            shoulder: 1.0,
            slope: 0.0,
            diffuse: [0.0],
        };
        let pi = std::f64::consts::PI;
        assert_relative(
            flat.tis_normal()[0],
            0.25 * pi,
            1e-14,
            "a constant is Lambert",
        );
        // a constant scatters the same share from every side
        let oblique = flat.tis(direction(1.0, 0.3))[0];
        assert_relative(oblique, 0.25 * pi, 3e-4, "oblique");
    }
}
