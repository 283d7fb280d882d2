//! What may be chosen about a material.

use crate::scene::{
    BeyondName, ColourChoice, FileMaterial, GapName, InterpolationName, ModelMaterial,
    NegativeName, SamplerName, Weight,
};

/// Choices; every one has a default that suits the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialOptions {
    /// Between measured directions.
    pub interpolation: InterpolationName,
    /// What negative values mean.
    pub negatives: NegativeName,
    /// What answers in the hole around the incident direction; `None`: what the interpolation does best.
    pub gap: Option<GapName>,
    /// What answers beyond the most grazing rows; `None`: what the interpolation does best.
    pub beyond: Option<BeyondName>,
    /// What the numbers of the file mean, where it is not to be believed.
    pub colour: ColourChoice,
    /// Factor per linear sRGB channel, applied last.
    pub scale: [f64; 3],
    /// How directions are chosen.
    pub sampler: SamplerName,
}

impl Default for MaterialOptions {
    fn default() -> Self {
        Self {
            interpolation: InterpolationName::Auto,
            negatives: NegativeName::Auto,
            gap: None,
            beyond: None,
            colour: ColourChoice::default(),
            scale: [1.0; 3],
            sampler: SamplerName::Auto,
        }
    }
}

impl MaterialOptions {
    /// What a scene says about a file; `sampler` where it names none.
    #[must_use]
    pub fn of_file(file: &FileMaterial, sampler: SamplerName) -> Self {
        Self {
            interpolation: file.interpolation.unwrap_or(InterpolationName::Auto),
            negatives: file.negatives.unwrap_or(NegativeName::Auto),
            gap: file.gap,
            beyond: file.beyond,
            colour: file.colour,
            scale: plain_scale(file.scale),
            sampler: file.sampler.unwrap_or(sampler),
        }
    }

    /// What a scene says about a model; `sampler` where it names none.
    #[must_use]
    pub fn of_model(model: &ModelMaterial, sampler: SamplerName) -> Self {
        Self {
            interpolation: model.interpolation.unwrap_or(InterpolationName::Auto),
            scale: plain_scale(model.scale),
            sampler: model.sampler.unwrap_or(sampler),
            ..Self::default()
        }
    }
}

fn plain_scale(scale: Option<[Weight; 3]>) -> [f64; 3] {
    scale.map_or([1.0; 3], |s| s.map(|w| w.0))
}
