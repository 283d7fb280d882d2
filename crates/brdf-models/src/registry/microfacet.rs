//! The Fresnel parameters that all microfacet models share.

use super::{DefaultValue, Parameter, Role, Values};
use crate::fresnel::Fresnel;
use crate::index::{SUBSTANCE_NAMES, Substance};

/// Reflectance at normal incidence.
pub(crate) const F0: Parameter = Parameter {
    excludes: &["n", "k", "index"],
    ..Parameter::albedo(
        "f0",
        "facet reflectance at normal incidence, 1 = a mirror at every angle",
        1.0,
    )
};

/// Real part of the index.
pub(crate) const N: Parameter = Parameter {
    name: "n",
    title: "refractive index of the facets, in place of f0; 1 if only k is given",
    unit: "",
    range: (1e-3, 1e3),
    default: DefaultValue::Absent,
    per_channel: true,
    role: Role::Shape,
    repeats: false,
    words: &[],
    choices: &[],
    excludes: &["f0", "index"],
};

/// Imaginary part of the index.
pub(crate) const K: Parameter = Parameter {
    name: "k",
    title: "extinction coefficient of the facets; 0 (a dielectric) if only n is given",
    range: (0.0, 1e3),
    ..N
};

/// Both of a substance, by wavelength.
pub(crate) const INDEX: Parameter = Parameter {
    name: "index",
    title: "substance of the facets, in place of f0, n and k",
    range: (0.0, SUBSTANCE_NAMES.len() as f64 - 1.0),
    per_channel: false,
    choices: &SUBSTANCE_NAMES,
    excludes: &["f0", "n", "k"],
    ..N
};

/// The Fresnel term of [`F0`], [`N`] and [`K`], or [`INDEX`], which exclude each other.
pub(crate) fn fresnel<const CH: usize>(values: &Values) -> Fresnel<CH> {
    let or = |name, default| {
        if values.is_given(name) {
            values.channels(name)
        } else {
            [default; CH]
        }
    };
    if let Some(substance) = values.choice("index").and_then(Substance::named) {
        substance.in_srgb()
    } else if values.is_given("n") || values.is_given("k") {
        Fresnel::from_index(or("n", 1.0), or("k", 0.0))
    } else {
        Fresnel::from_f0(or("f0", 1.0))
    }
}
