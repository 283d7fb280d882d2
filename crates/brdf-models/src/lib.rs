//! Analytic reflectance models, one a file, and the list of them.
//!
//! Every model is a plain struct of its parameters, implements [`brdf::Brdf`] for any number of channels
//! and [`brdf::DirectionSampler`] with the exact density of its own sampling. [`MODELS`] lists them with
//! their parameters and the laws they keep; [`parse_model`] makes one from `name:key=value,...`.
//!
//! Goals: correct to the last digits at the extremes (roughness 1e-4, exponents of 1e6, grazing angles),
//! f64 first, f32 packets for what renderers call most. Not here: fitting, measured data, files.

mod abc;
mod abg;
mod ashikhmin_shirley;
mod beckmann;
mod blinn_phong;
mod cook_torrance;
mod elementary;
mod eon;
mod fresnel;
mod generated;
mod ggx;
mod half;
mod harvey_shack;
mod he;
mod index;
mod k_correlation;
mod koenderink;
mod lafortune;
mod lambert;
mod lanes;
mod lobe;
mod oren_nayar;
mod phong;
mod power_law;
mod registry;
mod sgd;
mod shift_invariant;
mod smith;
mod spectral;
mod ward;

pub use abc::Abc;
pub use abg::Abg;
pub use ashikhmin_shirley::{AshikhminBase, AshikhminShirley};
pub use blinn_phong::BlinnPhong;
pub use cook_torrance::{CookTorrance, Masking};
pub use eon::Eon;
pub use fresnel::{Fresnel, Mix};
pub use ggx::Ggx;
pub use harvey_shack::HarveyShack;
pub use he::He;
pub use index::{SUBSTANCES, Seen, Substance, seen};
pub use k_correlation::KCorrelation;
pub use koenderink::{Koenderink, KoenderinkBasis};
pub use lafortune::{Lafortune, LafortuneLobe};
pub use lambert::Lambert;
pub use oren_nayar::OrenNayar;
pub use phong::{Phong, PhongForm};
pub use registry::{
    Built, DefaultValue, Laws, Lobe, MODELS, ModelError, ModelInfo, Parameter, ParsedModel, Role,
    Values, build_model, parse_model, parse_model_n,
};
pub use sgd::{Sgd, SgdShape};
pub use spectral::{Seeing, SpectralModel};
pub use ward::{Ward, WardForm};
