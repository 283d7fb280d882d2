//! The shifted gamma distribution of microfacets, fitted to the MERL materials [Bagher2012].

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};

use crate::half::{Half, from_tan2, reflect};
use crate::lobe::{ONE_MINUS, SpecularLobe};
use crate::power_law::{ln_power, power_mass};
use crate::registry::{Built, Laws, ModelInfo, Parameter, Values};

/// Everything but the weights, for one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SgdShape {
    /// Width of the distribution and its shift.
    pub alpha: f64,
    /// Power of the distribution.
    pub p: f64,
    /// Reflectance at normal incidence.
    pub f0: f64,
    /// Linear term of the Fresnel curve.
    pub f1: f64,
    /// kappa, factor of the distribution.
    pub kappa: f64,
    /// lambda of the shadowing.
    pub lambda: f64,
    /// c of the shadowing.
    pub c: f64,
    /// k of the shadowing.
    pub k: f64,
    /// theta_0 of the shadowing, rad.
    pub theta_0: f64,
}

/// f = (kd + ks F D G1(wi) G1(wo)/(ci co))/pi, each channel with its own shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sgd<const N: usize> {
    /// Shapes of the channels.
    pub shapes: [SgdShape; N],
    /// Weight of the lobe per channel.
    pub specular: [f64; N],
    /// Albedo of the Lambert lobe.
    pub diffuse: [f64; N],
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "sgd",
    title: "shifted gamma distribution of microfacets, Bagher, Soler and Holzschuch",
    formula: "kd/pi + ks (F D G1(wi) G1(wo))_+/(pi ci co), D = kap exp(-x)/(pi x^p hz^4), x = alpha + tan^2 d/alpha, F = f0 - f1 h.wi + (1-f0)(1-h.wi)^5, G1 = 1 + lambda (1 - exp(c (t-theta0)_+^k)) clamped to 0 ... 1",
    citation: "Bagher2012",
    parameters: &[
        channel("alpha", "width of the distribution", (1e-5, 10.0), 0.03),
        channel("p", "power of the distribution", (0.0, 4.0), 0.5),
        channel("f0", "reflectance at normal incidence", (0.0, 100.0), 0.1),
        channel(
            "f1",
            "linear term of the Fresnel curve",
            (-10.0, 100.0),
            0.0,
        ),
        channel("kap", "factor of the distribution", (0.0, 1e6), 25.0),
        channel("lambda", "shadowing: height", (0.0, 1e8), 3.0),
        channel("c", "shadowing: rate", (0.0, 1e38), 1e-7),
        channel("k", "shadowing: power", (0.0, 1e3), 36.0),
        Parameter {
            unit: "rad",
            ..channel("theta0", "shadowing: onset", (-FRAC_PI_2, FRAC_PI_2), 0.1)
        },
        Parameter::weight("ks", "weight of the lobe", 0.5),
        Parameter::base("kd", "albedo of the Lambert lobe", 0.05),
    ],
    laws: Laws {
        conserves_energy: false,
        sampler_complete: false,
        ..Laws::KEPT
    },
    examples: &[
        "alpha=0.0148/0.03/0.049,p=0.459/0.45/0.5295,f0=6.055/0.2358/0.5806,f1=5.055/0.1828/0.4761,kap=46.38/24.6/14.83,lambda=2.607/2.974/2.783,c=1.127e-7/1.064e-7/5.28e-8,k=47.78/36.28/31.61,theta0=0.2056/0.0663/-0.0661,ks=0.0365/0.665/0.2688,kd=0.0479/0.0314/0.0201",
        "alpha=0.3,p=1,ks=1,f0=1,kd=0.5",
        "alpha=0.8,p=0,kap=4,kd=0.3",
        "alpha=2,p=1.7,kap=30,lambda=0,ks=0.2,kd=0.1",
    ],
};

const fn channel(
    name: &'static str,
    title: &'static str,
    range: (f64, f64),
    default: f64,
) -> Parameter {
    Parameter {
        per_channel: true,
        ..Parameter::scalar(name, title, range, default)
    }
}

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    let of = |name: &str| values.channels::<N>(name);
    let [alpha, p, f0, f1, kappa, lambda, c, k, theta_0] = [
        "alpha", "p", "f0", "f1", "kap", "lambda", "c", "k", "theta0",
    ]
    .map(of);
    Built::new(Sgd {
        shapes: std::array::from_fn(|i| SgdShape {
            alpha: alpha[i],
            p: p[i],
            f0: f0[i],
            f1: f1[i],
            kappa: kappa[i],
            lambda: lambda[i],
            c: c[i],
            k: k[i],
            theta_0: theta_0[i],
        }),
        specular: of("ks"),
        diffuse: of("kd"),
    })
}

impl SgdShape {
    /// D(h), 1/sr up to the factor kappa.
    #[inline]
    fn ndf(&self, tan2: f64) -> f64 {
        let x = self.alpha + tan2 / self.alpha;
        let e = (-x - self.p * x.ln()).exp();
        // at grazing half vectors tan^2 may overflow: the exponential has won long before
        if e > 0.0 {
            let sec2 = 1.0 + tan2;
            self.kappa * FRAC_1_PI * e * sec2 * sec2
        } else {
            0.0
        }
    }

    /// The Fresnel curve; fitted, so that it may leave 0 ... 1.
    #[inline]
    fn fresnel(&self, cos_d: f64) -> f64 {
        self.f0 - cos_d * self.f1 + (1.0 - self.f0) * (1.0 - cos_d).powi(5)
    }

    #[inline]
    fn g1(&self, theta: f64) -> f64 {
        let t = theta - self.theta_0;
        if t <= 0.0 || self.lambda <= 0.0 {
            return 1.0;
        }
        (1.0 - self.lambda * (self.c * t.powf(self.k)).exp_m1()).clamp(0.0, 1.0)
    }

    /// Density of x that the lobe is drawn from, x >= alpha: x^-p up to 1, e^(1-x) beyond, continuous, over its
    /// [`Self::mass`]. At least the distribution's own e^-x x^-p up to a factor.
    #[inline]
    fn proposal(&self, x: f64) -> f64 {
        let q = if x < 1.0 {
            x.powf(-self.p)
        } else {
            (1.0 - x).exp()
        };
        let (power, tail) = self.mass();
        q / (power + tail)
    }

    /// Integrals of the two pieces of [`Self::proposal`].
    #[inline]
    fn mass(&self) -> (f64, f64) {
        if self.alpha < 1.0 {
            // from 1 down to alpha
            (-power_mass(1.0 - self.p, self.alpha.ln()), 1.0)
        } else {
            (0.0, (1.0 - self.alpha).exp())
        }
    }

    /// tan^2 of a half vector from [`Self::proposal`].
    #[inline]
    fn sample_tan2(&self, u: f64) -> f64 {
        let (power, tail) = self.mass();
        let v = u * (power + tail);
        let x = if v < power {
            // u = 0 is x = alpha
            ln_power(1.0 - v / power, 1.0 - self.p, self.alpha.ln()).exp()
        } else {
            let w = ((v - power) / tail).min(ONE_MINUS);
            self.alpha.max(1.0) - (-w).ln_1p()
        };
        (self.alpha * (x - self.alpha)).max(0.0)
    }

    #[inline]
    fn half_pdf(&self, half: &Half) -> f64 {
        let tan2 = half.tan2();
        let q = self.proposal(self.alpha + tan2 / self.alpha);
        if q > 0.0 {
            // dh = pi alpha dx / (1 + tan^2)^(3/2)
            let sec2 = 1.0 + tan2;
            q * sec2 * sec2.sqrt() / (PI * self.alpha)
        } else {
            0.0
        }
    }
}

impl<const N: usize> Brdf<N> for Sgd<N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let Some(half) = Half::new(wi, wo) else {
            return [0.0; N];
        };
        let theta = |w: DVec3| w.x.hypot(w.y).atan2(w.z);
        let (ti, to, tan2, cos_d) = (theta(wi), theta(wo), half.tan2(), half.cos_d());
        std::array::from_fn(|c| {
            let s = &self.shapes[c];
            let lobe = s.fresnel(cos_d) * s.ndf(tan2) * (s.g1(ti) * s.g1(to)) / (wi.z * wo.z);
            // fitted Fresnel curves dip below zero at angles the fit did not see
            FRAC_1_PI * (self.diffuse[c] + self.specular[c] * lobe.max(0.0))
        })
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

/// Share of samples that goes to the lobe where there is one beside a base: its albedo has no closed form.
const LOBE_SHARE: f64 = 0.7;

impl<const N: usize> SpecularLobe for Sgd<N> {
    #[inline]
    fn probability(&self, _wo: DVec3) -> f64 {
        let any = |w: &[f64; N]| w.iter().any(|&v| v > 0.0);
        match (any(&self.specular), any(&self.diffuse)) {
            (true, true) => LOBE_SHARE,
            // never all of them: where the lobe's density underflows the base must do
            (true, false) => 0.9,
            (false, _) => 0.0,
        }
    }

    fn sample_lobe(&self, wo: DVec3, u: DVec2) -> DVec3 {
        // a channel each with the same share of u.x
        let scaled = u.x * N as f64;
        let c = (scaled as usize).min(N - 1);
        let tan2 = self.shapes[c].sample_tan2((scaled - c as f64).min(ONE_MINUS));
        let (sin, cos) = (TAU * u.y).sin_cos();
        reflect(wo, from_tan2(tan2, cos, sin))
    }

    fn lobe_pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        Half::new(wi, wo).map_or(0.0, |half| {
            let sum: f64 = self.shapes.iter().map(|s| s.half_pdf(&half)).sum();
            // density of h over 4 (h.wo) = 2 |H|
            sum / N as f64 / (2.0 * half.len2.sqrt())
        })
    }
}

impl<const N: usize> DirectionSampler for Sgd<N> {
    /// `None` also where the mirrored direction would lie below the horizon.
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        self.sample_mixture(wo, u)
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.mixture_pdf(wi, wo)
    }
}
