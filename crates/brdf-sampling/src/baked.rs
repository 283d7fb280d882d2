//! A reflectance evaluated through the table that samples it: no noise in a bounce, at the price of an approximation.

use crate::albedo::AlbedoTable;
use crate::hvt::Hvt;
use brdf::{Brdf, Symmetry};
use glam::DVec3;

/// f_c(wi, wo) = a_c(wo) p(wi | wo) / cos theta_i, with p the density of an [`Hvt`] and a_c the albedo of channel c.
///
/// Sampled by that very table every weight is a_c: the variance of a bounce is 0. What is rendered is *not* the target:
///
/// - its relative squared error in the norm of the density is the relative variance of the exact mode (5 % for 0.0025);
/// - all channels share the luminance's shape; hue depends on the viewer alone, so colour differences between highlight
///   and body are lost. (A ratio of chromatic averages per direction would keep them and bring the noise back.)
/// - it is not reciprocal.
///
/// Albedos are those of the target, so energy is kept. Never a default.
#[derive(Clone, Debug)]
pub struct BakedHvt<const N: usize> {
    sampler: Hvt,
    albedo: AlbedoTable,
    isotropic: bool,
}

impl<const N: usize> BakedHvt<N> {
    /// Tabulates the albedos of `brdf` for 46 elevations (and 16 azimuths unless it is isotropic); `sampler` is a table
    /// built for its luminance.
    #[must_use]
    pub fn new(brdf: &impl Brdf<N>, sampler: Hvt) -> Self {
        let f = |wi: DVec3, wo: DVec3, out: &mut [f64]| out.copy_from_slice(&brdf.eval(wi, wo));
        let symmetry = brdf.symmetry();
        Self {
            sampler,
            albedo: AlbedoTable::new(&f, N, symmetry),
            isotropic: symmetry.isotropic,
        }
    }

    /// The table: what this must be sampled by.
    #[must_use]
    pub fn sampler(&self) -> &Hvt {
        &self.sampler
    }

    /// Bytes of table and albedos.
    #[must_use]
    pub fn bytes(&self) -> usize {
        brdf::DirectionSampler::bytes(&self.sampler) + self.albedo.bytes()
    }
}

impl<const N: usize> Brdf<N> for BakedHvt<N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return [0.0; N];
        }
        let shape = brdf::DirectionSampler::pdf(&self.sampler, wi, wo) / wi.z;
        std::array::from_fn(|c| shape * self.albedo.at(wo, c))
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: self.isotropic,
            reciprocal: false,
        }
    }
}
