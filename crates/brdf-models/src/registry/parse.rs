//! From `name:key=value,key=value/value/value` to a model.

use super::assemble::{Given, Named, assemble, unknown};
use super::{MODELS, ModelError, ModelInfo, ParsedModel};

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
/// Names (`index=cu`, `lambda=rgb`) are known for three channels only, those of linear sRGB.
///
/// # Errors
/// Says which part of the text is wrong, what was expected there and what was found.
pub fn parse_model_n<const N: usize>(text: &str) -> Result<ParsedModel<N>, ModelError> {
    let (name, rest) = text.trim().split_once(':').unwrap_or((text.trim(), ""));
    let info = (MODELS.iter().find(|m| m.name == name)).ok_or_else(|| unknown(name))?;
    assemble(info, given::<N>(info, rest)?)
}

/// The parameters the text names.
fn given<const N: usize>(info: &'static ModelInfo, text: &str) -> Result<Given, ModelError> {
    let mut given = Given::new(info);
    for pair in text.split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let (key, value) = pair.split_once('=').ok_or_else(|| ModelError::NotAPair {
            model: info.name,
            text: pair.into(),
        })?;
        let named = given.find(key.trim())?;
        let values = numbers::<N>(info, &named, value.trim())?;
        given.push::<N>(named, values)?;
    }
    Ok(given)
}

/// `0.2/0.1/0.05`, `0.3` or a word of the parameter.
fn numbers<const N: usize>(
    info: &ModelInfo,
    named: &Named,
    text: &str,
) -> Result<Vec<f64>, ModelError> {
    let choices = named.parameter.choices;
    if !choices.is_empty() {
        let place = choices.iter().position(|c| text.eq_ignore_ascii_case(c));
        return match place {
            Some(place) => Ok(vec![place as f64]),
            None => Err(ModelError::NotANumber {
                model: info.name,
                name: named.name.to_string(),
                expected: format!("one of {}", choices.join(", ")),
                text: text.into(),
            }),
        };
    }
    let words = named.parameter.words;
    let Some((_, rgb)) = words.iter().find(|(w, _)| text.eq_ignore_ascii_case(w)) else {
        return (text.split('/'))
            .map(|t| number(info, named, t.trim()))
            .collect();
    };
    if N == rgb.len() {
        return Ok(rgb.to_vec());
    }
    Err(ModelError::WrongCount {
        model: info.name,
        name: named.name.to_string(),
        expected: format!("one or {N} numbers (`{text}` is known in RGB alone)"),
        found: rgb.len(),
    })
}

fn number(info: &ModelInfo, named: &Named, text: &str) -> Result<f64, ModelError> {
    let value = text.parse::<f64>().ok().filter(|v| !v.is_nan());
    value.ok_or_else(|| {
        let words = named.parameter.words.iter();
        let words: String = words.map(|(w, _)| format!(" or {w}")).collect();
        ModelError::NotANumber {
            model: info.name,
            name: named.name.to_string(),
            expected: format!("a number{words}"),
            text: text.into(),
        }
    })
}
