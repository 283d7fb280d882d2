//! What a sampler is built for: a reflectance as one non-negative number.

use brdf::{LANES, Lanes3, Symmetry};
use glam::DVec3;
use sampling::Rng;
use std::f64::consts::TAU;
use std::fmt;

/// f(wi, wo) in 1/sr for a packet of pairs, called from several threads at once.
pub type TargetLanes<'a> = dyn Fn(&Lanes3, &Lanes3) -> [f32; LANES] + Sync + 'a;

/// A reflectance reduced to one number, f(wi, wo) in 1/sr **without** the cosine, such as luminance.
///
/// Negative, infinite and NaN values count as zero, so any function will do.
#[derive(Clone, Copy)]
pub struct Target<'a> {
    /// f(wi, wo), called from several threads at once.
    pub f: &'a (dyn Fn(DVec3, DVec3) -> f64 + Sync),
    /// The same in f32 for the [`LANES`] pairs of a packet, if there is such a form: half-vector tables are built by it.
    pub lanes: Option<&'a TargetLanes<'a>>,
    /// The symmetries of `f`; samplers use `isotropic` alone.
    pub symmetry: Symmetry,
}

impl<'a> Target<'a> {
    /// An isotropic, reciprocal target.
    pub fn new(f: &'a (dyn Fn(DVec3, DVec3) -> f64 + Sync)) -> Self {
        Self {
            f,
            lanes: None,
            symmetry: Symmetry::FULL,
        }
    }

    /// f(wi, wo) cos theta_i, the density wanted up to its integral: finite and >= 0; 0 below the horizon.
    #[inline]
    #[must_use]
    pub fn f_cos(&self, wi: DVec3, wo: DVec3) -> f64 {
        sanitised(self.f, wi, wo)
    }

    /// [`Self::f_cos`] for a packet.
    pub(crate) fn f_cos_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f64; LANES] {
        let mut out = [0.0; LANES];
        match self.lanes {
            Some(lanes) => {
                let f = lanes(wi, wo);
                for k in 0..LANES {
                    let (above, g) = (wi.z[k] > 0.0 && wo.z[k] > 0.0, f[k] * wi.z[k]);
                    out[k] = if above && g > 0.0 && g.is_finite() {
                        f64::from(g)
                    } else {
                        0.0
                    };
                }
            }
            None => {
                for k in 0..LANES {
                    out[k] = self.f_cos(wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                }
            }
        }
        out
    }

    /// What turning both directions about the normal does to f. The half turn, which [`Symmetry`] does not name, is
    /// looked for at random pairs of directions; should it be missed or seen in vain, samplers lose variance only.
    pub(crate) fn turning(&self) -> Turning {
        if self.symmetry.isotropic {
            return Turning::Isotropic;
        }
        let mut rng = Rng::new(71);
        let mut draw = || {
            let u = rng.uniform2();
            brdf::direction((1.0 - 0.999 * u.x).acos(), TAU * u.y)
        };
        let turned = |w: DVec3| DVec3::new(-w.x, -w.y, w.z);
        let differs = (0..PAIRS).any(|_| {
            let (wi, wo) = (draw(), draw());
            let (here, there) = (self.f_cos(wi, wo), self.f_cos(turned(wi), turned(wo)));
            (here - there).abs() > 1e-6 * (here + there)
        });
        if differs {
            Turning::FullTurn
        } else {
            Turning::HalfTurn
        }
    }
}

/// Pairs of directions at which [`Target::turning`] looks.
const PAIRS: usize = 400;

/// The smallest turn about the normal that leaves a reflectance as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turning {
    /// Any.
    Isotropic,
    /// Half a turn: brushed surfaces, most fabrics.
    HalfTurn,
    /// None.
    FullTurn,
}

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
