//! From `name:key=value,key=value/value/value` to a model.

use super::{DefaultValue, MODELS, ModelError, ModelInfo, Parameter, ParsedModel, Values, build};

/// [`parse_model_n`] for RGB.
///
/// # Errors
/// Says which part of the text is wrong, what was expected there and what was found.
///
/// ```
/// let model = brdf_models::parse_model("ggx:alpha=0.1,f0=0.9/0.6/0.3")?;
/// assert_eq!(model.info.name, "ggx");
/// assert!(brdf_models::parse_model("ggx:alpha=7").is_err());
/// # Ok::<(), brdf_models::ModelError>(())
/// ```
pub fn parse_model(text: &str) -> Result<ParsedModel<3>, ModelError> {
    parse_model_n(text)
}

/// Builds a model of `N` channels from its name and parameters, `ward:alpha=0.15,kd=0.2/0.1/0.05`.
///
/// Per-channel parameters take one value or `N`, separated by `/`; whatever is not given has its default.
/// Names of metals (`n=cu`) are known for three channels only.
///
/// # Errors
/// Says which part of the text is wrong, what was expected there and what was found.
pub fn parse_model_n<const N: usize>(text: &str) -> Result<ParsedModel<N>, ModelError> {
    let (name, rest) = text.trim().split_once(':').unwrap_or((text.trim(), ""));
    let unknown = || ModelError::UnknownModel {
        name: name.into(),
        known: MODELS.iter().map(|m| m.name).collect::<Vec<_>>().join(", "),
    };
    let info = MODELS.iter().find(|m| m.name == name).ok_or_else(unknown)?;
    let values = complete(info, given::<N>(info, rest)?);
    let built = build(name, &values).ok_or_else(unknown)?;
    Ok(ParsedModel {
        info,
        values,
        built,
    })
}

/// The parameters the text names.
fn given<const N: usize>(info: &'static ModelInfo, text: &str) -> Result<Values, ModelError> {
    let mut values = Values {
        entries: Vec::new(),
    };
    for pair in text.split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let (key, value) = pair.split_once('=').ok_or_else(|| ModelError::NotAPair {
            model: info.name,
            text: pair.into(),
        })?;
        let parameter = find(info, key.trim())?;
        if values.is_given(parameter.name) {
            return Err(ModelError::Repeated {
                model: info.name,
                name: parameter.name,
            });
        }
        if let Some(other) = parameter.excludes.iter().find(|e| values.is_given(e)) {
            return Err(ModelError::Exclusive {
                model: info.name,
                first: other,
                second: parameter.name,
            });
        }
        values
            .entries
            .push((parameter.name, numbers::<N>(info, parameter, value.trim())?));
    }
    Ok(values)
}

fn find(info: &'static ModelInfo, key: &str) -> Result<&'static Parameter, ModelError> {
    info.parameters
        .iter()
        .find(|p| p.name == key)
        .ok_or_else(|| ModelError::UnknownParameter {
            model: info.name,
            name: key.into(),
            known: info
                .parameters
                .iter()
                .map(|p| p.name)
                .collect::<Vec<_>>()
                .join(", "),
        })
}

/// `0.2/0.1/0.05`, `0.3` or a word of the parameter.
fn numbers<const N: usize>(
    info: &ModelInfo,
    p: &Parameter,
    text: &str,
) -> Result<Vec<f64>, ModelError> {
    if let Some((_, rgb)) = p
        .words
        .iter()
        .find(|(word, _)| text.eq_ignore_ascii_case(word))
    {
        return if N == rgb.len() {
            Ok(rgb.to_vec())
        } else {
            Err(ModelError::WrongCount {
                model: info.name,
                name: p.name,
                expected: format!("one or {N} numbers (`{text}` is known in RGB alone)"),
                found: rgb.len(),
            })
        };
    }
    let values = text
        .split('/')
        .map(|t| number(info, p, t.trim()))
        .collect::<Result<Vec<_>, _>>()?;
    if values.len() == 1 || (p.per_channel && values.len() == N) {
        return Ok(values);
    }
    Err(ModelError::WrongCount {
        model: info.name,
        name: p.name,
        expected: if p.per_channel {
            format!("one value or {N}")
        } else {
            "one value".into()
        },
        found: values.len(),
    })
}

fn number(info: &ModelInfo, p: &Parameter, text: &str) -> Result<f64, ModelError> {
    let value = text
        .parse::<f64>()
        .ok()
        .filter(|v| !v.is_nan())
        .ok_or_else(|| {
            let words: String = p.words.iter().map(|(w, _)| format!(" or {w}")).collect();
            ModelError::NotANumber {
                model: info.name,
                name: p.name,
                expected: format!("a number{words}"),
                text: text.into(),
            }
        })?;
    let (min, max) = p.range;
    if (min..=max).contains(&value) {
        return Ok(value);
    }
    Err(ModelError::OutOfRange {
        model: info.name,
        name: p.name,
        value,
        min,
        max,
    })
}

/// Adds the defaults, in the order of the registry. A parameter is left out when one it excludes was given.
fn complete(info: &ModelInfo, given: Values) -> Values {
    let mut all = Values {
        entries: Vec::new(),
    };
    for p in info.parameters {
        let excluded = p.excludes.iter().any(|e| given.is_given(e));
        let value = match (given.get(p.name), p.default) {
            ([], DefaultValue::Absent) => continue,
            ([], _) if excluded => continue,
            ([], DefaultValue::Value(v)) => vec![v],
            ([], DefaultValue::SameAs(other)) => all.get(other).to_vec(),
            (v, _) => v.to_vec(),
        };
        all.entries.push((p.name, value));
    }
    all
}
