//! Lafortune's generalised cosine lobes, any number of them, isotropic or not [Lafortune1997].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, TAU};

use crate::half::{MIN_COS, above};
use crate::lobe::{ONE_MINUS, cosine, cosine_pdf, power_lobe, power_lobe_pdf};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values, numbered};

/// One lobe: weight (n+2)/(2 pi) (cx ix ox + cy iy oy + cz iz oz)_+^n.
///
/// With -cx = -cy = cz = 1 it is Lewis' Phong lobe; cx = cy > 0 reflects back; |c| <= 1 keeps its albedo at
/// or below its weight. Lafortune's own coefficients are these times (weight (n+2)/(2 pi))^(1/n).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LafortuneLobe<const N: usize> {
    /// Albedo at most, per channel.
    pub weight: [f64; N],
    /// cx, cy, cz.
    pub axes: DVec3,
    /// Exponent n, [0, 1e6].
    pub exponent: f64,
}

/// A sum of lobes and a Lambert lobe.
#[derive(Clone, Debug, PartialEq)]
pub struct Lafortune<const N: usize> {
    /// The lobes.
    pub lobes: Vec<LafortuneLobe<N>>,
    /// Albedo of the Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "lafortune",
    title: "generalised cosine lobes, any number",
    formula: "kd/pi + sum_j ks_j (n_j+2)/(2 pi) (cx_j ix ox + cy_j iy oy + cz_j iz oz)_+^n_j",
    citation: "Lafortune1997",
    parameters: &[
        of_a_lobe(Parameter::weight("ks", "weight of the lobe", 0.5)),
        of_a_lobe(Parameter::exponent("n", "exponent of the lobe", 50.0)),
        of_a_lobe(Parameter::scalar(
            "cx",
            "coefficient of ix ox",
            (-1.0, 1.0),
            -1.0,
        )),
        of_a_lobe(Parameter {
            range: (-1.0, 1.0),
            ..Parameter::same("cy", "coefficient of iy oy", "cx")
        }),
        of_a_lobe(Parameter::scalar(
            "cz",
            "coefficient of iz oz",
            (-1.0, 1.0),
            1.0,
        )),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.3),
    ],
    laws: Laws {
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "ks=0.4,n=30,kd=0.5/0.3/0.1",
        "ks=0.3/0.2/0.1,n=40,cx=-0.9,cz=0.8,ks2=0.2,n2=8,cx2=0.7,cz2=0.9,ks3=0.2,n3=2,kd=0.2",
        "ks=1,n=20,cx=-0.95,cy=-0.7,cz=1,kd=0",
        "ks=0.2,n=5,ks2=0.2,n2=20,ks3=0.2,n3=80,ks4=0.2,n4=320,ks5=0.1,n5=1,cx5=1,kd=0.1",
    ],
};

const fn of_a_lobe(parameter: Parameter) -> Parameter {
    Parameter {
        repeats: true,
        ..parameter
    }
}

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    let lobe = |lobe: usize| {
        let of = |name: &str| values.scalar(&numbered(name, lobe));
        LafortuneLobe {
            weight: values.channels(&numbered("ks", lobe)),
            axes: DVec3::new(of("cx"), of("cy"), of("cz")),
            exponent: of("n"),
        }
    };
    Built::new(Lafortune {
        lobes: (1..)
            .take_while(|k| values.is_given(&numbered("ks", *k)))
            .map(lobe)
            .filter(|l| l.energy() > 0.0)
            .collect(),
        diffuse: values.channels("kd"),
    })
}

impl<const N: usize> LafortuneLobe<N> {
    /// Sum of the weights: zero for a lobe that may be left out.
    fn energy(&self) -> f64 {
        self.weight.iter().sum()
    }

    /// The lobe without its weight.
    #[inline]
    fn shape(&self, wi: DVec3, wo: DVec3) -> f64 {
        // the same products for (wi, wo) and (wo, wi): reciprocal to the bit
        let d = (wi * wo).dot(self.axes);
        if d > 0.0 {
            (self.exponent + 2.0) / TAU * d.powf(self.exponent)
        } else {
            0.0
        }
    }

    /// The lobe's axis for this viewer (unit) and its share of the energy, up to a common factor.
    #[inline]
    fn aim(&self, wo: DVec3) -> (DVec3, f64) {
        let v = self.axes * wo;
        let len = v.length();
        if len > 0.0 {
            let share = (self.exponent + 2.0) / (self.exponent + 1.0) * len.powf(self.exponent);
            (v / len, self.energy() * share)
        } else {
            (DVec3::Z, 0.0)
        }
    }
}

impl<const N: usize> Brdf<N> for Lafortune<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if !above(wi, wo) {
            return [0.0; N];
        }
        let mut f = self.diffuse.map(|d| d * FRAC_1_PI);
        for lobe in &self.lobes {
            let shape = lobe.shape(wi, wo);
            for c in 0..N {
                f[c] += lobe.weight[c] * shape;
            }
        }
        f
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: self
                .lobes
                .iter()
                .all(|l| l.axes.x.to_bits() == l.axes.y.to_bits()),
            reciprocal: true,
        }
    }
}

impl<const N: usize> Lafortune<N> {
    /// Energy of the Lambert lobe, and of everything together, for this viewer.
    #[inline]
    fn energies(&self, wo: DVec3) -> (f64, f64) {
        let diffuse: f64 = self.diffuse.iter().sum();
        let lobes: f64 = self.lobes.iter().map(|l| l.aim(wo).1).sum();
        // where every lobe has vanished the Lambert lobe must do, even if it is black
        if diffuse + lobes > 0.0 {
            (diffuse, diffuse + lobes)
        } else {
            (1.0, 1.0)
        }
    }
}

impl<const N: usize> DirectionSampler for Lafortune<N> {
    /// `None` also where the direction about a lobe's axis lies below the horizon.
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= MIN_COS {
            return None;
        }
        let (diffuse, total) = self.energies(wo);
        let mut rest = u.x * total;
        let mut wi = None;
        for lobe in &self.lobes {
            let (axis, energy) = lobe.aim(wo);
            if rest < energy {
                wi = Some(power_lobe(
                    axis,
                    lobe.exponent,
                    DVec2::new((rest / energy).min(ONE_MINUS), u.y),
                ));
                break;
            }
            rest -= energy;
        }
        let wi = match wi {
            Some(wi) => wi,
            // rounding may leave a hair beyond the last lobe of a black base
            None if diffuse > 0.0 => {
                cosine(DVec2::new((rest / diffuse).clamp(0.0, ONE_MINUS), u.y))
            }
            None => return None,
        };
        let pdf = self.pdf(wi, wo);
        (pdf > 0.0).then_some(DirectionSample { wi, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if !above(wi, wo) {
            return 0.0;
        }
        let (diffuse, total) = self.energies(wo);
        let mut pdf = diffuse / total * cosine_pdf(wi);
        for lobe in &self.lobes {
            let (axis, energy) = lobe.aim(wo);
            pdf += energy / total * power_lobe_pdf(axis, lobe.exponent, wi);
        }
        pdf
    }
}
