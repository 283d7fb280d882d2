//! The models and angles as textbooks print them, in [`Real`] numbers: no rearrangement, no series, no switch of form.
//!
//! A pair of f64 directions is taken as exact. They are of unit length to 1e-16 only, so that formulas which agree for unit
//! vectors differ by that much; the reference takes |H|/2 for the cosine at the half vector, since wi.h of rounded
//! directions has lost all digits where wi and wo are nearly opposite; and |wi - wo|/2 for the sine.

mod diffuse;
mod fitted;
mod fresnel;
mod he;
mod microfacet;
mod phong;
mod scatter;
mod ward;
mod zernike;

pub(crate) use fresnel::unpolarised;

use crate::real::Real;
use brdf_models::Values;
use glam::DVec3;

/// A vector.
#[derive(Clone, Debug)]
pub(crate) struct Vector {
    pub(crate) x: Real,
    pub(crate) y: Real,
    pub(crate) z: Real,
}

impl Vector {
    pub(crate) fn new(v: DVec3) -> Self {
        Self {
            x: Real::new(v.x),
            y: Real::new(v.y),
            z: Real::new(v.z),
        }
    }

    pub(crate) fn dot(&self, other: &Self) -> Real {
        &self.x * &other.x + &self.y * &other.y + &self.z * &other.z
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            x: &self.x + &other.x,
            y: &self.y + &other.y,
            z: &self.z + &other.z,
        }
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        Self {
            x: &self.x - &other.x,
            y: &self.y - &other.y,
            z: &self.z - &other.z,
        }
    }

    pub(crate) fn cross(&self, other: &Self) -> Self {
        Self {
            x: &self.y * &other.z - &self.z * &other.y,
            y: &self.z * &other.x - &self.x * &other.z,
            z: &self.x * &other.y - &self.y * &other.x,
        }
    }

    pub(crate) fn length(&self) -> Real {
        self.dot(self).sqrt()
    }

    /// Sine of the angle to z, whatever the length: 1 - sine must not see that it is 1 to 1e-16 only.
    pub(crate) fn sine(&self) -> Real {
        let across = self.x.sqr() + self.y.sqr();
        (&across / (&across + self.z.sqr())).sqrt()
    }
}

/// A model's parameters and a pair of directions, both above the horizon.
pub(crate) struct Args<'a> {
    pub(crate) values: &'a Values,
    /// Which channel is compared.
    pub(crate) channel: usize,
    pub(crate) wi: Vector,
    pub(crate) wo: Vector,
    /// wi + wo.
    pub(crate) half: Vector,
    /// Length of `half`.
    pub(crate) len: Real,
}

/// A function of them.
pub(crate) type Function = fn(&Args<'_>) -> Real;

/// A model's reflectance in 1/sr, and the density of its own sampler in 1/sr.
pub(crate) struct Reference {
    pub(crate) model: &'static str,
    pub(crate) f: Function,
    pub(crate) pdf: Function,
}

const fn reference(model: &'static str, f: Function, pdf: Function) -> Reference {
    Reference { model, f, pdf }
}

/// By name of the model; a test compares the list with the registry.
pub(crate) const REFERENCES: &[Reference] = &[
    reference("lambert", diffuse::lambert, diffuse::cosine),
    reference("oren-nayar", diffuse::oren_nayar, diffuse::cosine),
    reference("eon", diffuse::eon, diffuse::cosine),
    reference("phong", phong::classic, phong::mirror_pdf),
    reference("lewis", phong::lewis, phong::mirror_pdf),
    reference("blinn-phong", phong::blinn, phong::blinn_pdf),
    reference("lafortune", phong::lafortune, phong::lafortune_pdf),
    reference("ashikhmin-shirley", phong::ashikhmin, phong::ashikhmin_pdf),
    reference("ward", ward::original, ward::pdf),
    reference("ward-cheap", ward::cheap, ward::cheap_pdf),
    reference("ward-duer", ward::duer, ward::pdf),
    reference("ward-gmd", ward::bounded, ward::pdf),
    reference(
        "cook-torrance",
        microfacet::cook_torrance,
        microfacet::cook_torrance_pdf,
    ),
    reference(
        "cook-torrance-smith",
        microfacet::cook_torrance_smith,
        microfacet::cook_torrance_pdf,
    ),
    reference("ggx", microfacet::ggx, microfacet::ggx_pdf),
    reference(
        "ashikhmin-lobe",
        phong::ashikhmin_lobe,
        phong::ashikhmin_lobe_pdf,
    ),
    reference("he", he::he, he::he_pdf),
    reference("sgd", fitted::sgd, fitted::sgd_pdf),
    reference("abc", fitted::abc, fitted::abc_pdf),
    reference("koenderink", zernike::koenderink, diffuse::cosine),
    reference("abg", scatter::abg, scatter::abg_pdf),
    reference(
        "harvey-shack",
        scatter::harvey_shack,
        scatter::harvey_shack_pdf,
    ),
    reference(
        "k-correlation",
        scatter::k_correlation,
        scatter::k_correlation_pdf,
    ),
];

impl<'a> Args<'a> {
    pub(crate) fn new(values: &'a Values, channel: usize, wi: DVec3, wo: DVec3) -> Self {
        let (wi, wo) = (Vector::new(wi), Vector::new(wo));
        let half = wi.plus(&wo);
        Self {
            values,
            channel,
            len: half.length(),
            wi,
            wo,
            half,
        }
    }

    /// A parameter that has one value.
    pub(crate) fn scalar(&self, name: &str) -> f64 {
        self.values.get(name).first().copied().unwrap_or(f64::NAN)
    }

    /// A parameter in one channel, or its only value.
    pub(crate) fn in_channel(&self, name: &str, channel: usize) -> f64 {
        let all = self.values.get(name);
        *all.get(channel).or(all.first()).unwrap_or(&f64::NAN)
    }

    /// A parameter in the compared channel.
    pub(crate) fn own(&self, name: &str) -> f64 {
        self.in_channel(name, self.channel)
    }

    /// hz of the half vector of unit length.
    pub(crate) fn hz(&self) -> Real {
        &self.half.z / &self.len
    }

    /// Cosine between the half vector and either direction.
    pub(crate) fn cos_d(&self) -> Real {
        (&self.len * 0.5).min(&Real::new(1.0))
    }

    /// Squared sine of that angle.
    pub(crate) fn sin2_d(&self) -> Real {
        let apart = self.wi.minus(&self.wo);
        (apart.dot(&apart) * 0.25).min(&Real::new(1.0))
    }

    /// One flank of a V-shaped groove: min(1, 2 hz c / h.w).
    pub(crate) fn groove(&self, c: &Real) -> Real {
        (2.0 * self.hz() * c / self.cos_d()).min(&Real::new(1.0))
    }

    /// kd/pi.
    pub(crate) fn diffuse(&self) -> Real {
        self.own("kd") / Real::pi()
    }

    /// What samplers call the share of the lobe, from its energy per channel: s/(s + d) of the channel sums.
    pub(crate) fn share(
        &self,
        specular: impl Fn(usize) -> Real,
        diffuse: impl Fn(usize) -> Real,
    ) -> Real {
        let sum = |f: &dyn Fn(usize) -> Real| f(0) + f(1) + f(2);
        let (s, d) = (sum(&specular), sum(&diffuse));
        let total = &s + &d;
        if total.is_positive() {
            s / total
        } else {
            Real::new(0.0)
        }
    }

    /// share * lobe + (1 - share) cos/pi.
    pub(crate) fn mixture(&self, share: &Real, lobe: Real) -> Real {
        share * lobe + (1.0 - share) * &self.wi.z / Real::pi()
    }
}

#[cfg(test)]
mod tests {
    use super::REFERENCES;
    use brdf_models::MODELS;

    #[test]
    fn every_model_has_one_reference() {
        for model in MODELS {
            let found = REFERENCES.iter().filter(|r| r.model == model.name).count();
            assert_eq!(found, 1, "references of {}", model.name);
        }
        assert_eq!(REFERENCES.len(), MODELS.len(), "a reference of no model");
    }
}
