//! From the parameters that were given to the whole model: names, ranges, defaults, exclusions.

use super::parameter::Entry;
use super::{DefaultValue, MODELS, ModelError, ModelInfo, Parameter, ParsedModel, Values, build};
use std::borrow::Cow;

/// Most lobes a model may have: far more than anyone fits, few enough that a slip of the keyboard does no harm.
const MAX_LOBES: usize = 64;

/// Channels of linear sRGB.
pub(super) const RGB: usize = 3;

/// The parameter `name` of lobe number `lobe`, 1, 2, ...: the first lobe's have no number.
pub(crate) fn numbered(name: &str, lobe: usize) -> Cow<'_, str> {
    if lobe == 1 {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(format!("{name}{lobe}"))
    }
}

/// A parameter under the name it goes by in one lobe.
#[derive(Clone, Debug)]
pub(super) struct Named {
    pub(super) parameter: &'static Parameter,
    pub(super) name: Cow<'static, str>,
    lobe: usize,
}

/// The parameters given so far.
pub(super) struct Given {
    info: &'static ModelInfo,
    values: Values,
    /// Largest number of a lobe among them.
    lobes: usize,
}

/// Builds `info` from numbers: as [`super::parse_model_n`], with names and values in place of text.
///
/// Per-channel parameters take one value or `N`; whatever is not given has its default.
///
/// # Errors
/// Says which parameter is wrong, what was expected there and what was found.
///
/// ```
/// let ggx = brdf_models::MODELS.iter().find(|m| m.name == "ggx").unwrap();
/// let model = brdf_models::build_model::<3>(ggx, &[("alpha", &[0.3]), ("f0", &[0.9, 0.6, 0.3])])?;
/// assert_eq!(model.to_string(), "ggx:alpha=0.3,alpha_x=0.3,alpha_y=0.3,f0=0.9/0.6/0.3,ks=1,kd=0");
/// # Ok::<(), brdf_models::ModelError>(())
/// ```
pub fn build_model<const N: usize>(
    info: &'static ModelInfo,
    values: &[(&str, &[f64])],
) -> Result<ParsedModel<N>, ModelError> {
    let mut given = Given::new(info);
    for (name, numbers) in values {
        let named = given.find(name)?;
        given.push::<N>(named, numbers.to_vec())?;
    }
    assemble(info, given)
}

/// Fills in the defaults and builds.
pub(super) fn assemble<const N: usize>(
    info: &'static ModelInfo,
    given: Given,
) -> Result<ParsedModel<N>, ModelError> {
    let values = given.complete();
    let built = build(info.name, &values).ok_or_else(|| unknown(info.name))?;
    Ok(ParsedModel {
        info,
        values,
        built,
    })
}

pub(super) fn unknown(name: &str) -> ModelError {
    ModelError::UnknownModel {
        name: name.into(),
        known: MODELS.iter().map(|m| m.name).collect::<Vec<_>>().join(", "),
    }
}

impl Given {
    pub(super) const fn new(info: &'static ModelInfo) -> Self {
        Self {
            info,
            values: Values {
                entries: Vec::new(),
            },
            lobes: 1,
        }
    }

    /// The parameter called `key`, of the first lobe or of another (`ks2`).
    pub(super) fn find(&self, key: &str) -> Result<Named, ModelError> {
        let parameters = self.info.parameters;
        if let Some(parameter) = parameters.iter().find(|p| p.name == key) {
            return Ok(Named {
                parameter,
                name: Cow::Borrowed(parameter.name),
                lobe: 1,
            });
        }
        let stem = key.trim_end_matches(|c: char| c.is_ascii_digit());
        let lobe = key[stem.len()..].parse().unwrap_or(0);
        parameters
            .iter()
            .filter(|p| p.repeats && p.name == stem && (2..=MAX_LOBES).contains(&lobe))
            // not `n02`
            .find(|_| numbered(stem, lobe) == key)
            .map(|parameter| Named {
                parameter,
                name: Cow::Owned(numbered(stem, lobe).into_owned()),
                lobe,
            })
            .ok_or_else(|| self.no_such(key))
    }

    fn no_such(&self, key: &str) -> ModelError {
        let known = self.info.parameters.iter().map(|p| {
            if p.repeats {
                format!("{0} ({0}2, {0}3, ...)", p.name)
            } else {
                p.name.to_owned()
            }
        });
        ModelError::UnknownParameter {
            model: self.info.name,
            name: key.into(),
            known: known.collect::<Vec<_>>().join(", "),
        }
    }

    /// Takes the values of one parameter.
    pub(super) fn push<const N: usize>(
        &mut self,
        named: Named,
        values: Vec<f64>,
    ) -> Result<(), ModelError> {
        let (model, p, name) = (self.info.name, named.parameter, named.name);
        if self.values.is_given(&name) {
            let name = name.into_owned();
            return Err(ModelError::Repeated { model, name });
        }
        if let Some(other) = p.excludes.iter().find(|e| self.values.is_given(e)) {
            return Err(ModelError::Exclusive {
                model,
                first: (*other).to_owned(),
                second: name.into_owned(),
            });
        }
        if !(values.len() == 1 || (p.per_channel && values.len() == N)) {
            return Err(ModelError::WrongCount {
                model,
                name: name.into_owned(),
                expected: if p.per_channel {
                    format!("one value or {N}")
                } else {
                    "one value".into()
                },
                found: values.len(),
            });
        }
        let (min, max) = p.range;
        if let Some(&value) = values.iter().find(|v| !(min..=max).contains(*v)) {
            return Err(ModelError::OutOfRange {
                model,
                name: name.into_owned(),
                value,
                min,
                max,
            });
        }
        if !p.choices.is_empty() && N != RGB {
            // the indices of a colour are mixtures of three
            return Err(ModelError::WrongCount {
                model,
                name: name.into_owned(),
                expected: format!("numbers in {N} channels (names are known in RGB alone)"),
                found: RGB,
            });
        }
        self.lobes = self.lobes.max(named.lobe);
        self.values.entries.push(Entry::new(p, name, values));
        Ok(())
    }

    /// Adds the defaults: what belongs to a lobe first, lobe by lobe, then the rest, in the order of the registry.
    /// A parameter is left out when one it excludes was given.
    fn complete(self) -> Values {
        let mut all = Values {
            entries: Vec::new(),
        };
        let (of_lobes, of_all): (Vec<&Parameter>, Vec<&Parameter>) =
            self.info.parameters.iter().partition(|p| p.repeats);
        let of_lobes = (1..=self.lobes).flat_map(|k| of_lobes.iter().map(move |p| (*p, k)));
        for (p, lobe) in of_lobes.chain(of_all.iter().map(|p| (*p, 1))) {
            let name = match numbered(p.name, lobe) {
                Cow::Borrowed(_) => Cow::Borrowed(p.name),
                Cow::Owned(name) => Cow::Owned(name),
            };
            let excluded = p.excludes.iter().any(|e| self.values.is_given(e));
            let value = match (self.values.get(&name), p.default) {
                ([], DefaultValue::Absent) => continue,
                ([], _) if excluded => continue,
                ([], DefaultValue::Value(v)) => vec![v],
                ([], DefaultValue::SameAs(other)) => all.get(&numbered(other, lobe)).to_vec(),
                (v, _) => v.to_vec(),
            };
            all.entries.push(Entry::new(p, name, value));
        }
        all
    }
}
