//! The two traits everything else is written against.
//!
//! Conventions (docs/conventions.md): directions are unit vectors in the local frame, z = normal;
//! `wi` points toward the light, `wo` toward the viewer; the *known* direction is `wo`.

use crate::lanes::{LANES, Lanes3};
use glam::{DVec2, DVec3};

/// Which symmetries a reflectance has; samplers and grids use them to store less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Symmetry {
    /// f depends on the azimuth difference alone.
    pub isotropic: bool,
    /// f(wi, wo) = f(wo, wi) by construction.
    ///
    /// This is the law of reflection. Of a BSDF that transmits, f(wi, wo)/eta_o^2 = f(wo, wi)/eta_i^2 holds, with
    /// the refractive indices on the sides of the two directions [Veach1997]: the eta^2 belongs here, into the
    /// meaning of this claim, and into [`crate::Material`], which knows what is transported. Only reflection is
    /// implemented, where both indices are the same and cancel.
    pub reciprocal: bool,
}

impl Symmetry {
    /// Isotropic and reciprocal: most models, and the MERL layout.
    pub const FULL: Self = Self {
        isotropic: true,
        reciprocal: true,
    };
}

/// What a surface does with light: f_r in 1/sr for `N` channels, without the cosine.
pub trait Brdf<const N: usize>: Send + Sync {
    /// f_r(wi, wo) in 1/sr. Zero where either direction is at or below the horizon.
    ///
    /// Finite for all unit vectors; may be negative where the measurement is.
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N];

    /// The symmetries that hold exactly.
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    /// Bytes of the tables it holds.
    fn table_bytes(&self) -> usize {
        0
    }

    /// [`Self::eval`] for [`LANES`] pairs at once, in f32: what renderers call.
    ///
    /// The default calls `eval`; override it where speed matters. The two agree to f32 rounding.
    #[inline(always)]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        let mut out = [[0.0; LANES]; N];
        for k in 0..LANES {
            let f = self.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
            for c in 0..N {
                out[c][k] = f[c] as f32;
            }
        }
        out
    }
}

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionSample {
    /// Toward the light, unit, local frame.
    pub wi: DVec3,
    /// Its density per unit solid angle, 1/sr; positive.
    pub pdf: f64,
}

/// [`LANES`] sampled directions; `pdf` is 0 in lanes where nothing was sampled.
#[derive(Clone, Copy, Debug)]
pub struct SampleLanes {
    /// Toward the light.
    pub wi: Lanes3,
    /// Densities per unit solid angle, 1/sr; 0 = no sample.
    pub pdf: [f32; LANES],
}

/// How a direction toward the light is chosen for a known viewer direction `wo`.
///
/// `pdf` is the exact density of `sample` for every `wo`, and is positive wherever the reflectance
/// the sampler was built for is not zero.
pub trait DirectionSampler: Send + Sync {
    /// Draws `wi` from two numbers in [0, 1). `None` when `wo` is at or below the horizon.
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample>;

    /// Density of `wi` given `wo`, per unit solid angle. Zero below the horizon.
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64;

    /// Whether equal strata of `u` stay connected, so that low-discrepancy points keep their gain
    /// (inversion: yes; rejection and alias tables: no).
    fn keeps_stratification(&self) -> bool {
        true
    }

    /// Expected proposals a sample costs at this viewer: 1 but for rejection.
    fn tries_per_sample(&self, wo: DVec3) -> f64 {
        let _ = wo;
        1.0
    }

    /// Bytes of tables the sampler holds.
    fn bytes(&self) -> usize {
        0
    }

    /// [`Self::sample`] for [`LANES`] viewers at once, in f32.
    ///
    /// The density is that of the direction as rounded to f32: in a narrow lobe the two differ, and reflectance over
    /// density stays bounded only if both are asked about the same direction.
    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        let mut out = SampleLanes {
            wi: Lanes3::ZERO,
            pdf: [0.0; LANES],
        };
        for k in 0..LANES {
            let u = DVec2::new(f64::from(u[0][k]), f64::from(u[1][k]));
            let viewer = wo.get(k).as_dvec3();
            if let Some(s) = self.sample(viewer, u) {
                let wi = s.wi.as_vec3();
                out.wi.set(k, wi);
                out.pdf[k] = self.pdf(wi.as_dvec3(), viewer) as f32;
            }
        }
        out
    }

    /// [`Self::pdf`] for [`LANES`] pairs at once, in f32.
    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        std::array::from_fn(|k| self.pdf(wi.get(k).as_dvec3(), wo.get(k).as_dvec3()) as f32)
    }
}

impl<const N: usize, T: Brdf<N> + ?Sized> Brdf<N> for std::sync::Arc<T> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        (**self).eval(wi, wo)
    }
    fn symmetry(&self) -> Symmetry {
        (**self).symmetry()
    }
    fn table_bytes(&self) -> usize {
        (**self).table_bytes()
    }
    #[inline(always)]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        (**self).eval_lanes(wi, wo)
    }
}

impl<T: DirectionSampler + ?Sized> DirectionSampler for std::sync::Arc<T> {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        (**self).sample(wo, u)
    }
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        (**self).pdf(wi, wo)
    }
    fn keeps_stratification(&self) -> bool {
        (**self).keeps_stratification()
    }
    fn tries_per_sample(&self, wo: DVec3) -> f64 {
        (**self).tries_per_sample(wo)
    }
    fn bytes(&self) -> usize {
        (**self).bytes()
    }
    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        (**self).sample_lanes(wo, u)
    }
    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        (**self).pdf_lanes(wi, wo)
    }
}
