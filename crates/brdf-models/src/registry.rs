//! The list of models: names, parameters, the laws each keeps, and how `name:key=value,...` becomes one.

mod assemble;
mod built;
mod error;
pub(crate) mod microfacet;
mod parameter;
mod parse;

pub use assemble::build_model;
pub(crate) use assemble::numbered;
pub use built::{Built, Lobe, ParsedModel};
pub use error::ModelError;
pub use parameter::{DefaultValue, Parameter, Role, Values};
pub use parse::{parse_model, parse_model_n};

/// What is promised of a model for every parameter in range, and checked by the conformance tests.
///
/// A law that is not kept is broken on purpose, because the published model breaks it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each law is kept or broken, independent of the others"
)]
pub struct Laws {
    /// f(wi, wo) = f(wo, wi).
    pub reciprocal: bool,
    /// The directional albedo stays at or below 1 as long as the weights add up to at most 1.
    pub conserves_energy: bool,
    /// f is nowhere negative.
    pub non_negative: bool,
    /// The sampler's density integrates to 1; otherwise to less, the rest being directions below the horizon.
    pub sampler_complete: bool,
}

impl Laws {
    /// All of them.
    pub const KEPT: Self = Self {
        reciprocal: true,
        conserves_energy: true,
        non_negative: true,
        sampler_complete: true,
    };
}

/// A model as the user sees it.
#[derive(Clone, Copy, Debug)]
pub struct ModelInfo {
    /// What is typed.
    pub name: &'static str,
    /// One line.
    pub title: &'static str,
    /// f_r in plain text; symbols as in docs/models.md.
    pub formula: &'static str,
    /// Key in docs/references.bib.
    pub citation: &'static str,
    /// What it takes.
    pub parameters: &'static [Parameter],
    /// What it keeps.
    pub laws: Laws,
    /// Parameter texts that exercise it: tests, benches and documentation run over them.
    pub examples: &'static [&'static str],
}

impl ModelInfo {
    /// The entry of a parameter, also of one of a further lobe (`ks2`).
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        let exact = self.parameters.iter().find(|p| p.name == name);
        exact.or_else(|| {
            let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
            let mut repeated = self.parameters.iter().filter(|p| p.repeats);
            repeated.find(|p| p.name == stem)
        })
    }

    /// How f depends on the parameter called `name`; a shape if there is none.
    #[must_use]
    pub fn role(&self, name: &str) -> Role {
        self.parameter(name).map_or(Role::Shape, |p| p.role)
    }
}

/// Lists the models once: the registry and its constructor come from the same lines.
macro_rules! models {
    ($($module:ident :: $info:ident => $build:ident),* $(,)?) => {
        /// Every model, in the order of the documentation.
        pub const MODELS: &[ModelInfo] = &[$(crate::$module::$info),*];

        /// Builds the model called `name` from its complete values; `None` for a name that is not listed.
        fn build<const N: usize>(name: &str, values: &Values) -> Option<Built<N>> {
            $(if name == crate::$module::$info.name {
                return Some(crate::$module::$build(values));
            })*
            None
        }
    };
}

models! {
    lambert::INFO => build,
    phong::CLASSIC => build_classic,
    phong::LEWIS => build_lewis,
    blinn_phong::INFO => build,
    lafortune::INFO => build,
    ward::ORIGINAL => build_original,
    ward::CHEAP => build_cheap,
    ward::DUER => build_duer,
    ward::BOUNDED => build_bounded,
    cook_torrance::INFO => build_grooves,
    cook_torrance::SMITH => build_smith,
    ggx::INFO => build,
    oren_nayar::INFO => build,
    eon::INFO => build,
    ashikhmin_shirley::INFO => build,
    ashikhmin_shirley::LOBE => build_lobe,
    he::INFO => build,
    sgd::INFO => build,
    abc::INFO => build,
    koenderink::INFO => build,
    abg::INFO => build,
    harvey_shack::INFO => build,
    k_correlation::INFO => build,
}
