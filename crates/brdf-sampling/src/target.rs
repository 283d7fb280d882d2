//! What a sampler is built for: a reflectance as one non-negative number.

use brdf::Symmetry;
use glam::DVec3;
use std::f64::consts::TAU;
use std::fmt;

/// A reflectance reduced to one number, f(wi, wo) in 1/sr **without** the cosine, such as luminance.
///
/// Negative, infinite and NaN values count as zero, so any function will do.
#[derive(Clone, Copy)]
pub struct Target<'a> {
    /// f(wi, wo), called from several threads at once.
    pub f: &'a (dyn Fn(DVec3, DVec3) -> f64 + Sync),
    /// The symmetries of `f`; samplers use `isotropic` alone.
    pub symmetry: Symmetry,
}

impl<'a> Target<'a> {
    /// An isotropic, reciprocal target.
    pub fn new(f: &'a (dyn Fn(DVec3, DVec3) -> f64 + Sync)) -> Self {
        Self {
            f,
            symmetry: Symmetry::FULL,
        }
    }

    /// f(wi, wo) cos theta_i, the density wanted up to its integral: finite and >= 0; 0 below the horizon.
    #[inline]
    #[must_use]
    pub fn f_cos(&self, wi: DVec3, wo: DVec3) -> f64 {
        sanitised(self.f, wi, wo)
    }

    /// The mean of f over both directions turned about the normal together, by eighths of a turn: what a sampler
    /// without azimuth slices is built for.
    pub(crate) fn turned_mean(&self, wi: DVec3, wo: DVec3) -> f64 {
        let turned = |k: u32| {
            let (s, c) = (f64::from(k) * TAU / f64::from(TURNS)).sin_cos();
            let turn = |w: DVec3| DVec3::new(c * w.x - s * w.y, s * w.x + c * w.y, w.z);
            let f = (self.f)(turn(wi), turn(wo));
            if f > 0.0 && f.is_finite() { f } else { 0.0 }
        };
        (0..TURNS).map(turned).sum::<f64>() / f64::from(TURNS)
    }
}

/// Azimuths of [`Target::turned_mean`].
const TURNS: u32 = 8;

impl fmt::Debug for Target<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Target")
            .field("symmetry", &self.symmetry)
            .finish_non_exhaustive()
    }
}

/// `f` cos theta_i with everything that is not a finite positive number replaced by 0.
#[inline]
pub(crate) fn sanitised(f: &(impl Fn(DVec3, DVec3) -> f64 + ?Sized), wi: DVec3, wo: DVec3) -> f64 {
    if wi.z <= 0.0 || wo.z <= 0.0 {
        return 0.0;
    }
    let g = f(wi, wo) * wi.z;
    if g > 0.0 && g.is_finite() { g } else { 0.0 }
}
