//! The Fresnel parameters that all microfacet models share.

use super::{DefaultValue, Parameter, Role, Values};
use crate::fresnel::{Fresnel, METALS};

/// Names accepted for n: metals, in RGB.
const N_WORDS: &[(&str, [f64; 3])] = &[
    (METALS[0].symbol, METALS[0].n),
    (METALS[1].symbol, METALS[1].n),
    (METALS[2].symbol, METALS[2].n),
    (METALS[3].symbol, METALS[3].n),
];

/// Names accepted for k.
const K_WORDS: &[(&str, [f64; 3])] = &[
    (METALS[0].symbol, METALS[0].k),
    (METALS[1].symbol, METALS[1].k),
    (METALS[2].symbol, METALS[2].k),
    (METALS[3].symbol, METALS[3].k),
];

/// Reflectance at normal incidence.
pub(crate) const F0: Parameter = Parameter {
    excludes: &["n", "k"],
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
    words: N_WORDS,
    excludes: &["f0"],
};

/// Imaginary part of the index.
pub(crate) const K: Parameter = Parameter {
    name: "k",
    title: "extinction coefficient of the facets; 0 (a dielectric) if only n is given",
    range: (0.0, 1e3),
    words: K_WORDS,
    ..N
};

/// The Fresnel term of [`F0`], [`N`] and [`K`], which exclude each other.
pub(crate) fn fresnel<const CH: usize>(values: &Values) -> Fresnel<CH> {
    let or = |name, default| {
        if values.is_given(name) {
            values.channels(name)
        } else {
            [default; CH]
        }
    };
    if values.is_given("n") || values.is_given("k") {
        Fresnel::from_index(or("n", 1.0), or("k", 0.0))
    } else {
        Fresnel::from_f0(or("f0", 1.0))
    }
}
