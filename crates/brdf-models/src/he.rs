//! He, Torrance, Sillion and Greenberg: scattering from a Gaussian rough surface by wave optics, unpolarised
//! [He1991].
//!
//! Two closed forms make it cheap and keep it finite. The apparent roughness solves a transcendental equation,
//! z0 = sigma0 x with x e^(x^2/2) = c, whose solution is x^2 = W(c^2) [Corless1996]. The geometrical factor of the
//! paper, made of scalar products of polarisation vectors, is exactly (|V|^2/V.z)^2, V = wi + wo, because (s, p, k)
//! is an orthonormal triple on either side.

mod lambert_w;
mod series;

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use pulp::{Simd, WithSimd};
use std::f64::consts::{FRAC_1_PI, TAU};

use crate::beckmann::Cavities;
use crate::elementary::exp;
use crate::fresnel::Fresnel;
use crate::half::{Half, MIN_COS, above, from_tan2, reflect};
use crate::lobe::{ONE_MINUS, cosine, cosine_pdf};
use crate::registry::{Built, DefaultValue, Laws, ModelInfo, Parameter, Values, microfacet};
use crate::smith::Smith;

use lambert_w::lambert_w;
use series::{SIDE, series};

/// f = kd/pi + ks (F e^-g S delta + F (|V|^2/Vz)^2 S D / (pi ci co)).
///
/// The mirror reflection, a delta function in the paper, is widened to a lobe of roughness [`Self::mirror_width`],
/// so that evaluation, sampling and density stay consistent; [`Self::specular_albedo`] is the factor of the delta
/// function itself, and `mirror` = 0 leaves it out (docs/decisions/0011).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct He<const N: usize> {
    /// Root mean square height sigma0 in micrometres, [0, 100].
    pub sigma_um: f64,
    /// Autocorrelation length tau in micrometres, [0.01, 1e4].
    pub tau_um: f64,
    /// Wavelength of each channel, nm.
    pub lambda_nm: [f64; N],
    /// Reflectance of the smooth surface.
    pub fresnel: Fresnel<N>,
    /// Weight of mirror reflection and directional-diffuse part per channel; 1 is the theory.
    pub specular: [f64; N],
    /// Albedo of the uniform diffuse part a(lambda).
    pub diffuse: [f64; N],
    /// Factor of the mirror reflection, [0, 1]; 1 is the theory.
    pub mirror: f64,
    /// Roughness of the lobe that stands for the mirror reflection, [1e-4, 0.1].
    pub mirror_width: f64,
}

/// Wavelengths at which the primaries of linear sRGB look like spectral light over D65 [Bt709], [Cie15]; nm.
const RGB_NM: [f64; 3] = [611.4, 549.1, 464.2];

/// Wavelength of a channel.
pub(crate) const LAMBDA: Parameter = Parameter {
    per_channel: true,
    unit: "nm",
    words: &[("rgb", RGB_NM)],
    ..Parameter::scalar(
        "lambda",
        "wavelength; `rgb` is 611.4/549.1/464.2, the dominant wavelengths of the primaries",
        (10.0, 1e6),
        550.0,
    )
};

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "he",
    title: "wave optics of a Gaussian rough surface, He, Torrance, Sillion and Greenberg, unpolarised",
    formula: "kd/pi + ks F S (mirror e^-g M + (|H|^2/Hz)^2 k^2 tau^2/16 sum_m e^-g g^m/(m! m) e^(-w/m) / (pi ci co)), k = 2 pi/lambda, g = (k s Hz)^2, w = k^2 tau^2 (Hx^2 + Hy^2)/4, s = sigma/sqrt(1 + W((Ki + Ko)^2/(8 pi))), K = tan(t) erfc(tau cot(t)/(2 sigma)), S Smith's shadowing, M a lobe of ward-gmd",
    citation: "He1991",
    parameters: &[
        Parameter {
            unit: "um",
            ..Parameter::scalar("sigma", "root mean square height", (0.0, 100.0), 0.1)
        },
        Parameter {
            unit: "um",
            ..Parameter::scalar("tau", "autocorrelation length", (0.01, 1e4), 2.0)
        },
        LAMBDA,
        microfacet::F0,
        microfacet::N,
        microfacet::K,
        microfacet::INDEX,
        Parameter::scalar(
            "mirror",
            "factor of the mirror reflection, 0 to leave it out",
            (0.0, 1.0),
            1.0,
        ),
        Parameter {
            default: DefaultValue::Value(1e-3),
            ..Parameter::scalar(
                "width",
                "roughness to which the mirror reflection is widened",
                (1e-4, 0.1),
                1e-3,
            )
        },
        Parameter::weight("ks", "weight of all but the uniform diffuse part", 1.0),
        Parameter::base("kd", "albedo of the uniform diffuse part", 0.0),
    ],
    laws: Laws {
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "sigma=0.18,tau=3,index=al,lambda=rgb,width=0.02",
        "sigma=0.6,tau=4,f0=1,width=0.02",
        "sigma=0.03,tau=0.4,n=1.5,kd=0.4,width=0.02",
        "sigma=2,tau=20,mirror=0,index=cu,lambda=rgb",
        "sigma=0,tau=1,width=0.05,f0=0.5,ks=0.9,kd=0.1",
        "sigma=0.02,tau=0.05,mirror=0.5,width=0.03,kd=0.2",
        // the mirror reflection as narrow as it is by default
        "sigma=0.05,tau=3,n=1.5,kd=0.3",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    Built::new(He {
        sigma_um: values.scalar("sigma"),
        tau_um: values.scalar("tau"),
        lambda_nm: values.channels("lambda"),
        fresnel: microfacet::fresnel(values),
        specular: values.channels("ks"),
        diffuse: values.channels("kd"),
        mirror: values.scalar("mirror"),
        mirror_width: values.scalar("width"),
    })
}

/// k^2, k = 2 pi/lambda, 1/um^2.
#[inline(always)]
fn wave_number2(lambda_nm: f64) -> f64 {
    let k = 1e3 * TAU / lambda_nm;
    k * k
}

/// e^-x is 0 from here on, as [`exp`] has it.
const NOTHING: f64 = 700.0;

/// What all channels share about a pair of directions.
struct Shared {
    /// S(i) S(o) / (ci co).
    shadow_over_cos2: f64,
    /// (sigma / sigma0)^2.
    apparent: f64,
}

impl Shared {
    #[inline(always)]
    fn new(i: &Smith, o: &Smith) -> Self {
        let s = |d: &Smith| (1.0 - 0.5 * d.erfc_q) * d.g1_over_cos;
        // x e^(x^2/2) = c, so x^2 = W(c^2) and sigma^2 = sigma0^2/(1 + x^2)
        let c2 = (i.tan * i.erfc_q + o.tan * o.erfc_q).powi(2) * (FRAC_1_PI / 8.0);
        Self {
            shadow_over_cos2: s(i) * s(o),
            apparent: 1.0 / (1.0 + lambert_w(c2)),
        }
    }

    /// Over a surface without slopes.
    #[inline(always)]
    fn smooth(wi: DVec3, wo: DVec3) -> Self {
        Self {
            shadow_over_cos2: 1.0 / (wi.z * wo.z),
            apparent: 1.0,
        }
    }
}

impl<const N: usize> He<N> {
    /// Root mean square slope times sqrt 2 of the surface: m = 2 sigma0/tau.
    #[must_use]
    pub fn slope(&self) -> f64 {
        2.0 * self.sigma_um / self.tau_um
    }

    /// The factor F e^-g S of the paper's delta function for light that is mirrored toward `wo`, per channel and
    /// without `specular` and `mirror`: the share of light that is reflected as by a smooth surface.
    #[must_use]
    pub fn specular_albedo(&self, wo: DVec3) -> [f64; N] {
        if wo.z <= MIN_COS {
            return [0.0; N];
        }
        let shared = self.mirrored(wo);
        let (shadow, f) = (
            shared.shadow_over_cos2 * wo.z * wo.z,
            self.fresnel.eval(wo.z.min(1.0)),
        );
        let phase = self.phase(2.0 * wo.z, &shared);
        let k2 = self.lambda_nm.map(wave_number2);
        std::array::from_fn(|c| f[c] * (-k2[c] * phase).exp() * shadow)
    }

    #[inline(always)]
    fn shared(&self, wi: DVec3, wo: DVec3) -> Shared {
        let m = self.slope();
        if m <= 0.0 {
            return Shared::smooth(wi, wo);
        }
        Shared::new(&Smith::new(wi, m), &Smith::new(wo, m))
    }

    /// [`Self::shared`] for light that is mirrored toward `wo`.
    #[inline(always)]
    fn mirrored(&self, wo: DVec3) -> Shared {
        let m = self.slope();
        if m <= 0.0 {
            return Shared::smooth(wo, wo);
        }
        let o = Smith::new(wo, m);
        Shared::new(&o, &o)
    }

    /// (sigma Vz)^2, which is g/k^2.
    #[inline(always)]
    fn phase(&self, v_z: f64, shared: &Shared) -> f64 {
        let x = self.sigma_um * v_z;
        x * x * shared.apparent
    }

    /// `mirror` times the peak of the widened mirror reflection: [`crate::Ward`]'s bounded form but for its exponential,
    /// albedo 1.
    #[inline(always)]
    fn mirror_peak(&self, half: &Half) -> f64 {
        let (z2, alpha) = (half.h.z * half.h.z, self.mirror_width);
        self.mirror * half.len2 * FRAC_1_PI / (z2 * z2 * (alpha * alpha))
    }
}

/// An evaluation, compiled for each instruction set.
struct Eval<'a, const N: usize>(&'a He<N>, DVec3, DVec3);

impl<const N: usize> WithSimd for Eval<'_, N> {
    type Output = [f64; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [f64; N] {
        let Self(he, wi, wo) = self;
        let Some(half) = Half::new(wi, wo) else {
            return [0.0; N];
        };
        let shared = he.shared(wi, wo);
        let terms = Terms::new(he, &half, &shared);
        let fresnel = he.fresnel.eval_at(half.cos_d(), half.sin2_d());
        let mirror = he.mirror_peak(&half) * shared.shadow_over_cos2 * (wi.z * wo.z);
        let mut f = he.diffuse;
        for first in (0..N).step_by(SIDE) {
            let lobes = terms.lobes(he, first, mirror);
            for (c, lobe) in (first..N).zip(lobes) {
                f[c] = f[c] * FRAC_1_PI + he.specular[c] * fresnel[c] * lobe;
            }
        }
        f
    }
}

/// What the series of all channels share.
struct Terms {
    /// g/k^2.
    phase: f64,
    /// w/k^2.
    spread: f64,
    /// (|V|^2/Vz)^2 S tau^2/(16 pi ci co), the factor of the series over k^2.
    factor: f64,
    /// tan^2/width^2 of the mirror reflection.
    mirror_tan2: f64,
}

impl Terms {
    #[inline(always)]
    fn new<const N: usize>(he: &He<N>, half: &Half, shared: &Shared) -> Self {
        let ratio = half.len2 / half.h.z;
        let v_xy2 = half.h.x * half.h.x + half.h.y * half.h.y;
        let tau2 = he.tau_um * he.tau_um;
        Self {
            phase: he.phase(half.h.z, shared),
            spread: 0.25 * tau2 * v_xy2,
            factor: ratio * ratio * shared.shadow_over_cos2 * (FRAC_1_PI / 16.0 * tau2),
            mirror_tan2: half.tan2_over(he.mirror_width, he.mirror_width),
        }
    }

    /// Series and mirror reflection of the channels from `first` on, but for their reflectance; `mirror` is the peak of
    /// the mirror's lobe.
    #[inline(always)]
    fn lobes<const N: usize>(&self, he: &He<N>, first: usize, mirror: f64) -> [f64; SIDE] {
        let count = SIDE.min(N - first);
        let (mut lambda, mut weight) = ([1.0; SIDE], [0.0; SIDE]);
        lambda[..count].copy_from_slice(&he.lambda_nm[first..][..count]);
        weight[..count].copy_from_slice(&he.specular[first..][..count]);
        let (mut k2, mut g, mut w) = ([0.0; SIDE], [0.0; SIDE], [0.0; SIDE]);
        for c in 0..SIDE {
            k2[c] = wave_number2(lambda[c]);
            // fits ask for the lobes one a channel: what has no weight needs no series
            g[c] = if weight[c] > 0.0 {
                k2[c] * self.phase
            } else {
                0.0
            };
            w[c] = k2[c] * self.spread;
        }
        let mut lobes = series(&g, &w);
        for c in 0..SIDE {
            lobes[c] *= k2[c] * self.factor;
        }
        if mirror > 0.0 && self.mirror_tan2 < NOTHING {
            for c in 0..SIDE {
                lobes[c] += mirror * exp::<13>(-(g[c] + self.mirror_tan2));
            }
        }
        lobes
    }
}

impl<const N: usize> Brdf<N> for He<N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        brdf::arch().dispatch(Eval(self, wi, wo))
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

/// How a viewer's directions are drawn: a share of each part, and the width of the directional-diffuse lobe.
struct Plan {
    mirror: f64,
    rough: f64,
    cavities: Cavities,
}

/// Least share of the cosine lobe: the tails of the series are wider than any one lobe, and this bounds the weights.
const COSINE_SHARE: f64 = 0.1;

impl<const N: usize> He<N> {
    fn plan(&self, wo: DVec3) -> Plan {
        let shared = self.mirrored(wo);
        let shadow = shared.shadow_over_cos2 * wo.z * wo.z;
        let f = self.fresnel.eval(wo.z.min(1.0));
        let phase = self.phase(2.0 * wo.z, &shared);
        let k2 = self.lambda_nm.map(wave_number2);
        let (mut mirror, mut rough, mut width2) = (0.0, 0.0, 0.0);
        for c in 0..N {
            // 1 - e^-g of a smooth surface or a low viewer is all digits that 1 - e would lose
            let scattered = -(-k2[c] * phase).exp_m1();
            let weight = self.specular[c] * f[c] * shadow;
            mirror += weight * (1.0 - scattered) * self.mirror;
            rough += weight * scattered;
            // exp(-w/m) as a lobe in tan^2 of the half vector: m = 1 of the series for a smooth surface
            width2 += 1.0 / (k2[c] * self.tau_um * self.tau_um * wo.z * wo.z);
        }
        // and m = g, the geometrical limit, for a rough one
        let geometric = self.slope() * self.slope() * shared.apparent;
        let m = (geometric + width2 / N as f64).sqrt().clamp(1e-5, 1.0);
        let total = mirror + rough + self.diffuse.iter().sum::<f64>();
        // each part by what it reflects, but for the least share of the cosine lobe
        let scale = if mirror + rough > 0.0 {
            total.recip().min((1.0 - COSINE_SHARE) / (mirror + rough))
        } else {
            0.0
        };
        Plan {
            mirror: mirror * scale,
            rough: rough * scale,
            cavities: Cavities { m },
        }
    }

    fn density(&self, plan: &Plan, wi: DVec3, wo: DVec3) -> f64 {
        let Some(half) = Half::new(wi, wo) else {
            return 0.0;
        };
        let alpha = self.mirror_width;
        let tan2 = half.tan2_over(alpha, alpha);
        let mirror = if tan2 < NOTHING && plan.mirror > 0.0 {
            // density of h over 4 (h.wo) = 2 |H|
            let z3 = half.h.z * half.h.z * half.h.z;
            plan.mirror * exp::<13>(-tan2) * 0.5 * half.len2 / z3 * FRAC_1_PI / (alpha * alpha)
        } else {
            0.0
        };
        let rough = if plan.rough > 0.0 {
            plan.rough * plan.cavities.pdf(&half, wo)
        } else {
            0.0
        };
        mirror + rough + (1.0 - plan.mirror - plan.rough) * cosine_pdf(wi)
    }
}

impl<const N: usize> DirectionSampler for He<N> {
    /// `None` also where the mirrored direction would lie below the horizon.
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= MIN_COS {
            return None;
        }
        let plan = self.plan(wo);
        let (p, q) = (plan.mirror, plan.mirror + plan.rough);
        let part = |from: f64, to: f64| {
            DVec2::new(((u.x - from) / (to - from)).clamp(0.0, ONE_MINUS), u.y)
        };
        let wi = if u.x < p {
            let v = part(0.0, p);
            let (sin, cos) = (TAU * v.y).sin_cos();
            let tan2 = -self.mirror_width * self.mirror_width * (-v.x).ln_1p();
            reflect(wo, from_tan2(tan2, cos, sin))
        } else if u.x < q {
            plan.cavities.sample(wo, part(p, q))
        } else {
            cosine(part(q, 1.0))
        };
        let pdf = self.density(&plan, wi, wo);
        (pdf > 0.0).then_some(DirectionSample { wi, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if above(wi, wo) {
            self.density(&self.plan(wo), wi, wo)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{He, RGB_NM};
    use crate::cook_torrance::{CookTorrance, Masking};
    use crate::fresnel::Fresnel;
    use crate::smith::Smith;
    use brdf::{Brdf, direction};
    use glam::DVec3;
    use spectrum::matrix::transform;
    use spectrum::{Observer, XYZ_FROM_LINEAR_SRGB};
    use testkit::assert_relative;

    /// sigma = 40 um over tau = 200 um at 0.5 nm: g of 1e9 and more away from the horizon.
    fn short_wave() -> He<1> {
        He {
            sigma_um: 40.0,
            tau_um: 200.0,
            lambda_nm: [0.5],
            fresnel: Fresnel::from_index([1.6], [0.4]),
            specular: [1.0],
            diffuse: [0.0],
            mirror: 1.0,
            mirror_width: 1e-3,
        }
    }

    fn pairs() -> impl Iterator<Item = (DVec3, DVec3)> {
        let angles = [0.0, 0.2, 0.6, 1.0, 1.3, 1.5];
        angles.into_iter().flat_map(move |ti| {
            angles.into_iter().flat_map(move |to| {
                [0.1, 2.0, 3.0, 3.1].map(|phi| (direction(ti, 0.3), direction(to, 0.3 + phi)))
            })
        })
    }

    #[test]
    fn short_waves_give_the_microfacet_model() {
        // m = 2 sigma/tau with the apparent sigma, masking times the share of facets that face either way
        let he = short_wave();
        for (wi, wo) in pairs() {
            let m = he.slope();
            let shared = he.shared(wi, wo);
            let facets = CookTorrance {
                m: m * shared.apparent.sqrt(),
                masking: Masking::Smith,
                fresnel: he.fresnel,
                specular: [1.0],
                diffuse: [0.0],
            };
            // D F by dividing the masking out, then He's own
            let g1 = |w, m| Smith::new(w, m).g1_over_cos;
            let bare = facets.eval(wi, wo)[0] / (g1(wi, facets.m) * g1(wo, facets.m));
            let facing = |w| 1.0 - 0.5 * Smith::new(w, m).erfc_q;
            let expected = bare * g1(wi, m) * g1(wo, m) * facing(wi) * facing(wo);
            if expected > 1e-200 {
                // the series' own error; the limit is off by 1/g < 1e-9
                assert_relative(he.eval(wi, wo)[0], expected, 2e-5, &format!("{wi} {wo}"));
            }
        }
    }

    #[test]
    fn short_waves_away_from_the_horizon_give_cook_torrance_with_smith() {
        let he = short_wave();
        let facets = CookTorrance {
            m: he.slope(),
            masking: Masking::Smith,
            fresnel: he.fresnel,
            specular: [1.0],
            diffuse: [0.0],
        };
        // at 45 degrees erfc(cot/m) is 4e-4 for m = 0.4; at 30 degrees 1e-9
        for to in [0.0, 0.3, 0.5] {
            for ti in [0.0, 0.2, 0.5] {
                let (wi, wo) = (direction(ti, 0.0), direction(to, 2.5));
                let (f, expected) = (he.eval(wi, wo)[0], facets.eval(wi, wo)[0]);
                assert_relative(f, expected, 2e-5, &format!("{wi} {wo}"));
            }
        }
    }

    #[test]
    fn a_smooth_surface_keeps_its_mirror_reflection() {
        // what the mirror loses the series scatters: e^-g + (1 - e^-g), for scatter that is narrow
        let he = He {
            sigma_um: 0.03,
            tau_um: 60.0,
            lambda_nm: [550.0],
            fresnel: Fresnel::ONE,
            mirror_width: 1e-3,
            ..short_wave()
        };
        let wo = direction(0.4, 0.0);
        let g = (4.0 * std::f64::consts::PI * 0.03 / 0.55 * f64::cos(0.4)).powi(2);
        assert_relative(he.specular_albedo(wo)[0], (-g).exp(), 1e-12, "mirror");
        // polar midpoints about the mirror direction in direction cosines, to 30 widths of the first lobe
        let mut scattered = 0.0;
        let rough = He { mirror: 0.0, ..he };
        let (rings, spokes) = (400, 64);
        let width = 0.55 / (std::f64::consts::PI * 60.0);
        for j in 0..rings {
            let dr = 30.0 * width / f64::from(rings);
            let r = (f64::from(j) + 0.5) * dr;
            for k in 0..spokes {
                let dphi = std::f64::consts::TAU / f64::from(spokes);
                let (s, c) = ((f64::from(k) + 0.5) * dphi).sin_cos();
                let (x, y) = (r * c - wo.x, r * s);
                let wi = DVec3::new(x, y, (1.0 - x * x - y * y).sqrt());
                scattered += rough.eval(wi, wo)[0] * r * dr * dphi;
            }
        }
        // the lobe is 3 mrad wide: cosines vary by its square and by what is odd in it
        assert_relative(scattered, 1.0 - (-g).exp(), 1e-3, "scattered");
    }

    #[test]
    fn wavelengths_are_those_of_the_primaries() {
        // the line from the white point through a primary meets the spectral locus at its dominant wavelength
        let chromaticity = |xyz: [f64; 3]| {
            let sum: f64 = xyz.iter().sum();
            [xyz[0] / sum, xyz[1] / sum]
        };
        let white = chromaticity(transform(&XYZ_FROM_LINEAR_SRGB, [1.0; 3]));
        for c in 0..3 {
            let mut rgb = [0.0; 3];
            rgb[c] = 1.0;
            let primary = chromaticity(transform(&XYZ_FROM_LINEAR_SRGB, rgb));
            let spectral = chromaticity(Observer::CIE_1931.at(RGB_NM[c]));
            let angle = |p: [f64; 2]| (p[1] - white[1]).atan2(p[0] - white[0]);
            // a tenth of a nanometre turns the line by 1e-3 to 3e-3
            let error = (angle(primary) - angle(spectral)).abs();
            assert!(error < 3e-3, "{} nm: {error}", RGB_NM[c]);
        }
    }
}
