//! GGX (Trowbridge-Reitz) microfacets with height-correlated Smith masking, sampled by visible normals.
//!
//! [TrowbridgeReitz1975], [Walter2007], [Heitz2014], sampling [Heitz2018] in the spherical-cap form of
//! [DupuyBenyoub2023].

use brdf::{Brdf, DirectionSample, DirectionSampler, LANES, Lanes3, SampleLanes, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, TAU};

use crate::fresnel::Fresnel;
use crate::half::{Half, reflect};
use crate::lobe::{SpecularLobe, share};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values, microfacet};

/// f = kd/pi + ks F D G2 / (4 ci co).
///
/// With s = |(ax w.x, ay w.y, w.z)| the Smith term is G2 = 2 ci co / (s_i co + s_o ci), so that
/// f = ks F D / (2 (s_i co + s_o ci)) + kd/pi: no division by a cosine remains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx<const N: usize> {
    /// Roughness along x, [1e-4, 1].
    pub alpha_x: f64,
    /// Roughness along y, [1e-4, 1].
    pub alpha_y: f64,
    /// Reflectance of the facets.
    pub fresnel: Fresnel<N>,
    /// Weight of the lobe per channel, 1 for bare facets; at most 1 - `diffuse` keeps the energy.
    pub specular: [f64; N],
    /// Albedo of an added Lambert lobe, which does not know the Fresnel term.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "ggx",
    title: "GGX microfacets, Smith masking, conductor or dielectric",
    formula: "kd/pi + ks F(h.wi) D(h) G2 / (4 ci co), D = 1/(pi ax ay (hx^2/ax^2 + hy^2/ay^2 + hz^2)^2)",
    citation: "Walter2007",
    parameters: &[
        Parameter::roughness("alpha", "roughness", 0.1),
        Parameter::same("alpha_x", "roughness along x", "alpha"),
        Parameter::same("alpha_y", "roughness along y", "alpha"),
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
        "alpha=0.1,index=cu",
        "alpha=0.5",
        "alpha=1,f0=0.04,ks=0.5,kd=0.5/0.3/0.1",
        "alpha_x=0.3,alpha_y=0.1,f0=0.9/0.6/0.3",
        "alpha=0.02,f0=0.05,ks=0.6,kd=0.4",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(Ggx {
        alpha_x: values.scalar("alpha_x"),
        alpha_y: values.scalar("alpha_y"),
        fresnel: microfacet::fresnel(values),
        specular: values.channels("ks"),
        diffuse: values.channels("kd"),
    })
}

impl<const N: usize> Ggx<N> {
    /// The lobe without a diffuse part, the same roughness in every direction.
    #[must_use]
    pub const fn isotropic(alpha: f64, fresnel: Fresnel<N>) -> Self {
        Self {
            alpha_x: alpha,
            alpha_y: alpha,
            fresnel,
            specular: [1.0; N],
            diffuse: [0.0; N],
        }
    }

    /// |(ax w.x, ay w.y, w.z)|.
    #[inline]
    fn stretched(&self, w: DVec3) -> f64 {
        DVec3::new(self.alpha_x * w.x, self.alpha_y * w.y, w.z).length()
    }

    /// D(h), 1/sr, from the half vector of any length.
    #[inline]
    fn ndf(&self, half: &Half) -> f64 {
        let (x, y) = (half.h.x / self.alpha_x, half.h.y / self.alpha_y);
        let r = half.len2 / (x * x + y * y + half.h.z * half.h.z);
        r * r * FRAC_1_PI / (self.alpha_x * self.alpha_y)
    }
}

impl<const N: usize> Brdf<N> for Ggx<N> {
    #[inline]
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let Some(half) = Half::new(wi, wo) else {
            return [0.0; N];
        };
        let lambda = self.stretched(wi) * wo.z + self.stretched(wo) * wi.z;
        let lobe = 0.5 * self.ndf(&half) / lambda;
        let f = self.fresnel.eval_at(half.cos_d(), half.sin2_d());
        std::array::from_fn(|c| self.diffuse[c] * FRAC_1_PI + self.specular[c] * f[c] * lobe)
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: self.alpha_x.to_bits() == self.alpha_y.to_bits(),
            reciprocal: true,
        }
    }

    #[inline(always)]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        let kernel = self.kernel();
        let (mut lobe, mut diffuse) = ([0.0; LANES], [0.0; LANES]);
        let (mut cos_d, mut sin2_d) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            let d = kernel.ndf(wi, wo, k);
            let lambda = kernel.stretched(wi, k) * wo.z[k] + kernel.stretched(wo, k) * wi.z[k];
            let above = wi.z[k].min(wo.z[k]) > 0.0;
            lobe[k] = if above { 0.5 * d.value / lambda } else { 0.0 };
            cos_d[k] = (0.5 * d.len2.sqrt()).min(1.0);
            let (x, y, z) = (wi.x[k] - wo.x[k], wi.y[k] - wo.y[k], wi.z[k] - wo.z[k]);
            sin2_d[k] = (0.25 * (x * x + y * y + z * z)).min(1.0);
            diffuse[k] = if above {
                std::f32::consts::FRAC_1_PI
            } else {
                0.0
            };
        }
        let fresnel = self.fresnel.eval_lanes(&cos_d, &sin2_d);
        std::array::from_fn(|c| {
            let mut f = fresnel[c];
            let (kd, ks) = (self.diffuse[c] as f32, self.specular[c] as f32);
            for k in 0..LANES {
                f[k] = kd * diffuse[k] + ks * f[k] * lobe[k];
            }
            f
        })
    }
}

impl<const N: usize> SpecularLobe for Ggx<N> {
    #[inline]
    fn probability(&self, wo: DVec3) -> f64 {
        if self.has_diffuse() {
            let f = self.fresnel.eval(wo.z.min(1.0));
            let weight: [f64; N] = std::array::from_fn(|c| self.specular[c] * f[c]);
            share(&weight, &self.diffuse)
        } else {
            1.0
        }
    }

    #[inline]
    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        // stretch to the sphere, draw on the cap that the stretched viewer sees, shrink back
        let v = DVec3::new(self.alpha_x * wo.x, self.alpha_y * wo.y, wo.z).normalize();
        let z = (1.0 - u.x) * (1.0 + v.z) - v.z;
        let r = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        let (sin_phi, cos_phi) = (TAU * u.y).sin_cos();
        let c = DVec3::new(r * cos_phi, r * sin_phi, z) + v;
        let h = DVec3::new(self.alpha_x * c.x, self.alpha_y * c.y, c.z).normalize();
        reflect(wo, h)
    }

    #[inline]
    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        // D_visible / (4 wo.h) = G1(wo) D / (4 co), and G1 / co = 2 / (co + s_o)
        Half::new(wi, wo).map_or(0.0, |half| {
            0.5 * self.ndf(&half) / (wo.z + self.stretched(wo))
        })
    }
}

impl<const N: usize> DirectionSampler for Ggx<N> {
    /// `None` also where the mirrored direction would lie below the horizon; the density integrates to
    /// 1 minus that share.
    #[inline]
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        self.sample_mixture(wo, u)
    }

    #[inline]
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.mixture_pdf(wi, wo)
    }

    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        let p = self.probability_lanes(wo);
        let kernel = self.kernel();
        let mut wi = Lanes3::ZERO;
        if self.has_diffuse() {
            let (mut specular, mut diffuse) = (*u, *u);
            for k in 0..LANES {
                specular[0][k] = (u[0][k] / p[k]).min(ONE_MINUS_F32);
                diffuse[0][k] = ((u[0][k] - p[k]) / (1.0 - p[k])).clamp(0.0, ONE_MINUS_F32);
            }
            let a = kernel.sample(wo, &specular);
            let b = crate::lanes::cosine(&diffuse);
            for k in 0..LANES {
                let choose = u[0][k] < p[k];
                wi.x[k] = if choose { a.x[k] } else { b.x[k] };
                wi.y[k] = if choose { a.y[k] } else { b.y[k] };
                wi.z[k] = if choose { a.z[k] } else { b.z[k] };
            }
        } else {
            wi = kernel.sample(wo, u);
        }
        let pdf = self.pdf_lanes_with(&wi, wo, &p);
        SampleLanes { wi, pdf }
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        self.pdf_lanes_with(wi, wo, &self.probability_lanes(wo))
    }
}

/// Largest f32 below 1.
const ONE_MINUS_F32: f32 = 1.0 - f32::EPSILON / 2.0;

/// The f32 side of the model: what the packet loops read.
struct Kernel {
    alpha: [f32; 2],
    inv_alpha: [f32; 2],
    inv_pi_alpha2: f32,
}

/// D and |H|^2 of one lane.
struct Ndf {
    value: f32,
    len2: f32,
}

impl<const N: usize> Ggx<N> {
    fn has_diffuse(&self) -> bool {
        self.diffuse.iter().any(|&d| d > 0.0)
    }

    #[inline(always)]
    fn kernel(&self) -> Kernel {
        Kernel {
            alpha: [self.alpha_x as f32, self.alpha_y as f32],
            inv_alpha: [(1.0 / self.alpha_x) as f32, (1.0 / self.alpha_y) as f32],
            inv_pi_alpha2: (FRAC_1_PI / (self.alpha_x * self.alpha_y)) as f32,
        }
    }

    #[inline(always)]
    fn probability_lanes(&self, wo: &Lanes3) -> [f32; LANES] {
        if !self.has_diffuse() {
            return [1.0; LANES];
        }
        let cos = wo.z.map(|z| z.clamp(0.0, 1.0));
        let sin2 = cos.map(|c| (1.0 - c) * (1.0 + c));
        let mut specular = [0.0_f32; LANES];
        for (f, ks) in self
            .fresnel
            .eval_lanes(&cos, &sin2)
            .iter()
            .zip(&self.specular)
        {
            for k in 0..LANES {
                specular[k] += *ks as f32 * f[k];
            }
        }
        let diffuse = self.diffuse.iter().sum::<f64>() as f32;
        specular.map(|s| s / (s + diffuse))
    }

    #[inline(always)]
    fn pdf_lanes_with(&self, wi: &Lanes3, wo: &Lanes3, p: &[f32; LANES]) -> [f32; LANES] {
        let kernel = self.kernel();
        let mut pdf = [0.0; LANES];
        for k in 0..LANES {
            let lobe = 0.5 * kernel.ndf(wi, wo, k).value / (wo.z[k] + kernel.stretched(wo, k));
            let mixed = p[k] * lobe + (1.0 - p[k]) * wi.z[k] * std::f32::consts::FRAC_1_PI;
            pdf[k] = if wi.z[k].min(wo.z[k]) > 0.0 {
                mixed
            } else {
                0.0
            };
        }
        pdf
    }
}

impl Kernel {
    #[inline(always)]
    fn stretched(&self, w: &Lanes3, k: usize) -> f32 {
        let (x, y) = (self.alpha[0] * w.x[k], self.alpha[1] * w.y[k]);
        (x * x + y * y + w.z[k] * w.z[k]).sqrt()
    }

    #[inline(always)]
    fn ndf(&self, wi: &Lanes3, wo: &Lanes3, k: usize) -> Ndf {
        let (x, y, z) = (wi.x[k] + wo.x[k], wi.y[k] + wo.y[k], wi.z[k] + wo.z[k]);
        let len2 = x * x + y * y + z * z;
        let (sx, sy) = (x * self.inv_alpha[0], y * self.inv_alpha[1]);
        let r = len2 / (sx * sx + sy * sy + z * z);
        Ndf {
            value: r * r * self.inv_pi_alpha2,
            len2,
        }
    }

    #[inline(always)]
    fn sample(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> Lanes3 {
        let mut wi = Lanes3::ZERO;
        for k in 0..LANES {
            let inv = 1.0 / self.stretched(wo, k);
            let (vx, vy, vz) = (
                self.alpha[0] * wo.x[k] * inv,
                self.alpha[1] * wo.y[k] * inv,
                wo.z[k] * inv,
            );
            let z = (1.0 - u[0][k]) * (1.0 + vz) - vz;
            let r = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
            let (sin_phi, cos_phi) = crate::lanes::sin_cos_turn(u[1][k]);
            let (hx, hy, hz) = (
                self.alpha[0] * (r * cos_phi + vx),
                self.alpha[1] * (r * sin_phi + vy),
                z + vz,
            );
            // 2 (wo.h) h / |h|^2 - wo: one division instead of a normalisation
            let dot = wo.x[k] * hx + wo.y[k] * hy + wo.z[k] * hz;
            let scale = 2.0 * dot / (hx * hx + hy * hy + hz * hz);
            wi.x[k] = scale * hx - wo.x[k];
            wi.y[k] = scale * hy - wo.y[k];
            wi.z[k] = scale * hz - wo.z[k];
        }
        wi
    }
}

#[cfg(test)]
mod tests {
    use super::Ggx;
    use crate::fresnel::Fresnel;
    use brdf::{Brdf, DirectionSampler, direction};
    use glam::DVec3;

    /// n and k that Mitsuba 3 makes of the spectra of copper in RGB [Mitsuba3].
    const COPPER: [[f64; 3]; 2] = [
        [0.201005, 0.923750, 1.102215],
        [3.913262, 2.453045, 2.142090],
    ];

    fn copper(alpha_x: f64, alpha_y: f64) -> Ggx<3> {
        Ggx {
            alpha_x,
            alpha_y,
            fresnel: Fresnel::from_index(COPPER[0], COPPER[1]),
            specular: [1.0; 3],
            diffuse: [0.0; 3],
        }
    }

    fn pair(degrees: [f64; 4]) -> (DVec3, DVec3) {
        let [ti, pi, to, po] = degrees.map(f64::to_radians);
        (direction(ti, pi), direction(to, po))
    }

    /// G2 with height correlation over the product of two G1, which is what Mitsuba uses.
    fn correlation(model: &Ggx<3>, a: DVec3, b: DVec3) -> f64 {
        let lambda = |w: DVec3| 0.5 * (model.stretched(w) / w.z - 1.0);
        (1.0 + lambda(a)) * (1.0 + lambda(b)) / (1.0 + lambda(a) + lambda(b))
    }

    #[test]
    fn agrees_with_mitsuba_on_copper() {
        // roughconductor, material Cu, ggx, RGB mode: eval / cos and pdf of the second direction given the first
        let cases = [
            (
                0.1,
                0.1,
                [30.0, 0.0, 32.0, 180.0],
                [9.698492, 6.314228, 5.210445],
                8.651545,
            ),
            (
                0.1,
                0.1,
                [30.0, 0.0, 40.0, 170.0],
                [2.560975, 1.667536, 1.377538],
                2.065778,
            ),
            (
                0.1,
                0.1,
                [60.0, 20.0, 65.0, 210.0],
                [2.324820, 1.546571, 1.321253],
                1.051396,
            ),
            (
                0.1,
                0.1,
                [80.0, 0.0, 85.0, 178.0],
                [44.37706, 36.37969, 34.35678],
                5.099407,
            ),
            (
                0.3,
                0.1,
                [30.0, 0.0, 40.0, 170.0],
                [1.600738, 1.042294, 0.861031],
                1.308525,
            ),
            (
                0.3,
                0.1,
                [5.0, 0.0, 10.0, 90.0],
                [0.818799, 0.533060, 0.439112],
                0.847069,
            ),
        ];
        for (ax, ay, angles, value, pdf) in cases {
            let model = copper(ax, ay);
            let (known, other) = pair(angles);
            let f = model.eval(other, known);
            for c in 0..3 {
                // f32 arithmetic there
                let expected = value[c] * correlation(&model, other, known);
                let error = (f[c] / expected - 1.0).abs();
                assert!(error < 1e-5, "{angles:?} {} {expected}", f[c]);
            }
            let p = model.pdf(other, known);
            assert!((p / pdf - 1.0).abs() < 1e-5, "{angles:?} {p} {pdf}");
        }
    }
}
