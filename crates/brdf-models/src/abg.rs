//! The ABg model of optical design programs [Pfisterer2011], [Stover2012].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

use crate::half::above;
use crate::lobe::{ONE_MINUS, SpecularLobe, combine, share};
use crate::power_law::{ln_power, power_mass};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};
use crate::shift_invariant::{Radial, ShiftedLobe, distance2, total_integrated_scatter};

/// f = kd/pi + A/(B + |beta - beta0|^g).
///
/// The light that is mirrored, 1 - TIS, is no part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abg<const N: usize> {
    /// A per channel, 1/sr: the peak is A/B.
    pub a: [f64; N],
    /// B; the shoulder is at B^(1/g) in direction cosines, [1e-12, 1e3].
    pub b: f64,
    /// g, the slope beyond the shoulder, [0.1, 10].
    pub g: f64,
    /// Albedo of an added Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "abg",
    title: "shift-invariant scatter of optical design programs",
    formula: "kd/pi + a/(b + |beta - beta0|^g), beta = (ix, iy), beta0 = (-ox, -oy)",
    citation: "Pfisterer2011",
    parameters: &[
        Parameter {
            range: (0.0, 1e6),
            unit: "1/sr",
            ..Parameter::weight("a", "weight of the lobe; the peak is a/b", 0.01)
        },
        Parameter::scalar("b", "g-th power of the shoulder", (1e-12, 1e3), 1e-3),
        Parameter::scalar("g", "slope beyond the shoulder", (0.1, 10.0), 2.0),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.0),
    ],
    laws: Laws {
        conserves_energy: false,
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "a=0.1,b=0.001,g=2",
        "a=0.3/0.2/0.1,b=0.02,g=1.5,kd=0.2",
        "a=0.05,b=0.00001,g=3.5,kd=0.1",
        "a=1,b=200,g=4",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(Abg {
        a: values.channels("a"),
        b: values.scalar("b"),
        g: values.scalar("g"),
        diffuse: values.channels("kd"),
    })
}

/// The density the lobe is drawn from, per area of direction cosines: flat up to the shoulder r0, (r0/r)^g from
/// there to the edge of the disc of radius 2. The model is between half of it and all of it.
struct Broken {
    /// r0, at most 2.
    shoulder: f64,
    g: f64,
    /// The integral over the flat part, and over all, of the density with 1 at the centre.
    flat: f64,
    whole: f64,
}

impl Broken {
    #[inline]
    fn new(b: f64, g: f64) -> Self {
        let shoulder = b.powf(1.0 / g).min(2.0);
        let flat = PI * shoulder * shoulder;
        let slope = 2.0 * flat * power_mass(2.0 - g, (2.0 / shoulder).ln());
        Self {
            shoulder,
            g,
            flat,
            whole: flat + slope,
        }
    }
}

impl Radial for Broken {
    #[inline]
    fn radius(&self, u: f64) -> f64 {
        let v = u * self.whole;
        if v < self.flat {
            self.shoulder * (v / self.flat).sqrt()
        } else {
            let w = ((v - self.flat) / (self.whole - self.flat)).min(ONE_MINUS);
            let ln = ln_power(w, 2.0 - self.g, (2.0 / self.shoulder).ln());
            self.shoulder * ln.exp()
        }
    }

    #[inline]
    fn density(&self, r2: f64) -> f64 {
        let t2 = r2 / (self.shoulder * self.shoulder);
        let shape = if t2 > 1.0 {
            t2.powf(-0.5 * self.g)
        } else {
            1.0
        };
        shape / self.whole
    }
}

impl<const N: usize> Abg<N> {
    /// Total integrated scatter of light from `wo` per channel, without the Lambert lobe, to about 1e-4.
    #[must_use]
    pub fn tis(&self, wo: DVec3) -> [f64; N] {
        total_integrated_scatter(self, &self.diffuse, wo)
    }

    #[inline]
    fn lobe(&self) -> ShiftedLobe<Broken, 1> {
        ShiftedLobe([Broken::new(self.b, self.g)])
    }

    /// The lobe without its weight.
    #[inline]
    fn shape(&self, r2: f64) -> f64 {
        1.0 / (self.b + r2.powf(0.5 * self.g))
    }
}

impl<const N: usize> Brdf<N> for Abg<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if !above(wi, wo) {
            return [0.0; N];
        }
        combine(&self.diffuse, &self.a, self.shape(distance2(wi, wo)))
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> SpecularLobe for Abg<N> {
    #[inline]
    fn probability(&self, _wo: DVec3) -> f64 {
        // at most what the lobe scatters
        let scale = Broken::new(self.b, self.g).whole / self.b;
        share(&self.a.map(|a| a * scale), &self.diffuse)
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

impl<const N: usize> DirectionSampler for Abg<N> {
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
    use super::Abg;
    use glam::DVec3;
    use testkit::assert_relative;

    #[test]
    fn total_scatter_at_normal_incidence() {
        // g = 2: 2 pi A times the integral of r/(B + r^2) from 0 to 1
        for b in [1e-6, 1e-3, 0.5] {
            let model = Abg {
                a: [0.02],
                b,
                g: 2.0,
                diffuse: [0.5],
            };
            let expected = std::f64::consts::PI * 0.02 * (1.0 / b).ln_1p();
            // the lattice over the edge of the unit disc
            assert_relative(model.tis(DVec3::Z)[0], expected, 3e-4, "TIS");
        }
    }
}
