//! Parameters: what a model takes, and the values it was given.

use std::borrow::Cow;
use std::fmt;

/// How f depends on a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// In some way or other: roughness, exponent, refractive index. Fits search for it.
    Shape,
    /// Linearly, channel by channel: for fixed shapes f is a sum of lobes, each times its weight
    /// ([`super::ParsedModel::lobes`]). Fits solve for it.
    Weight,
}

/// What a parameter is when the text does not say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultValue {
    /// This number in every channel.
    Value(f64),
    /// Whatever this other parameter, listed before it, is.
    SameAs(&'static str),
    /// Nothing: the model does without it.
    Absent,
}

/// One parameter of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// What is typed.
    pub name: &'static str,
    /// What it means, one line.
    pub title: &'static str,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// Smallest and largest accepted value.
    pub range: (f64, f64),
    /// Value when not given.
    pub default: DefaultValue,
    /// Takes one value, or one a channel.
    pub per_channel: bool,
    /// How f depends on it.
    pub role: Role,
    /// Belongs to a lobe that may be there any number of times: `ks2`, `ks3` ... are the same of further lobes.
    pub repeats: bool,
    /// Names that stand for values in R/G/B.
    pub words: &'static [(&'static str, [f64; 3])],
    /// What it is one of, by name; empty for a number. The value is the place in this list.
    pub choices: &'static [&'static str],
    /// Parameters that may not be given beside it.
    pub excludes: &'static [&'static str],
}

impl Parameter {
    /// A pure number for all channels together.
    pub(crate) const fn scalar(
        name: &'static str,
        title: &'static str,
        range: (f64, f64),
        default: f64,
    ) -> Self {
        Self {
            name,
            title,
            unit: "",
            range,
            default: DefaultValue::Value(default),
            per_channel: false,
            role: Role::Shape,
            repeats: false,
            words: &[],
            choices: &[],
            excludes: &[],
        }
    }

    /// A reflectance, one or one a channel, [0, 1].
    pub(crate) const fn albedo(name: &'static str, title: &'static str, default: f64) -> Self {
        Self {
            per_channel: true,
            ..Self::scalar(name, title, (0.0, 1.0), default)
        }
    }

    /// The albedo of a lobe that enters linearly, one or one a channel, [0, 1].
    pub(crate) const fn base(name: &'static str, title: &'static str, default: f64) -> Self {
        Self {
            role: Role::Weight,
            ..Self::albedo(name, title, default)
        }
    }

    /// The factor of a lobe, one or one a channel, [0, 1000]: where 1 stands for all of the light, larger ones
    /// break the energy, but measured data may ask for them.
    pub(crate) const fn weight(name: &'static str, title: &'static str, default: f64) -> Self {
        Self {
            range: (0.0, 1e3),
            ..Self::base(name, title, default)
        }
    }

    /// A microfacet roughness, [1e-4, 1].
    pub(crate) const fn roughness(name: &'static str, title: &'static str, default: f64) -> Self {
        Self::scalar(name, title, (1e-4, 1.0), default)
    }

    /// An exponent of a cosine, [0, 1e6].
    pub(crate) const fn exponent(name: &'static str, title: &'static str, default: f64) -> Self {
        Self::scalar(name, title, (0.0, 1e6), default)
    }

    /// A roughness that follows another one unless given.
    pub(crate) const fn same(name: &'static str, title: &'static str, other: &'static str) -> Self {
        Self {
            default: DefaultValue::SameAs(other),
            ..Self::roughness(name, title, 0.0)
        }
    }
}

impl Entry {
    pub(super) fn new(parameter: &Parameter, name: Cow<'static, str>, numbers: Vec<f64>) -> Self {
        // a place in a short list: exact
        let place = numbers.first().map_or(0, |v| *v as usize);
        Self {
            choice: parameter.choices.get(place).copied(),
            name,
            numbers,
        }
    }
}

/// The values of a model's parameters, complete: defaults are filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    pub(super) entries: Vec<Entry>,
}

/// One parameter and its value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) name: Cow<'static, str>,
    pub(super) numbers: Vec<f64>,
    /// The name the number stands for, where it is one of several.
    pub(super) choice: Option<&'static str>,
}

impl Values {
    /// The numbers of `name`; empty if the parameter is absent.
    #[must_use]
    pub fn get(&self, name: &str) -> &[f64] {
        self.entry(name).map_or(&[], |e| &e.numbers)
    }

    /// What was chosen for `name`, a parameter that is one of several names.
    #[must_use]
    pub fn choice(&self, name: &str) -> Option<&'static str> {
        self.entry(name)?.choice
    }

    fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|e| e.name == name)
    }

    /// True unless the parameter is absent.
    #[must_use]
    pub fn is_given(&self, name: &str) -> bool {
        !self.get(name).is_empty()
    }

    /// Name and numbers of every parameter that is not absent.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[f64])> {
        (self.entries.iter()).map(|e| (&*e.name, e.numbers.as_slice()))
    }

    /// A parameter that has one number; NaN if it is absent.
    pub(crate) fn scalar(&self, name: &str) -> f64 {
        self.get(name).first().copied().unwrap_or(f64::NAN)
    }

    /// One number a channel; a single one stands for all. NaN if it is absent.
    pub(crate) fn channels<const N: usize>(&self, name: &str) -> [f64; N] {
        let v = self.get(name);
        std::array::from_fn(|c| {
            if v.len() == 1 {
                v[0]
            } else {
                v.get(c).copied().unwrap_or(f64::NAN)
            }
        })
    }
}

/// `alpha=0.1,kd=0.2/0.1/0.05`.
impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, entry) in self.entries.iter().enumerate() {
            let numbers: Vec<_> = entry.numbers.iter().map(f64::to_string).collect();
            let value = entry
                .choice
                .map_or_else(|| numbers.join("/"), str::to_owned);
            let comma = if i == 0 { "" } else { "," };
            write!(f, "{comma}{}={value}", entry.name)?;
        }
        Ok(())
    }
}
