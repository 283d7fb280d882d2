//! The families that can be fitted: models of the registry with the parameters a fit searches for.

mod albedo;
mod koenderink;
mod lafortune;
mod registry;

use crate::FitError;
use crate::family::{Family, Part, Scale, ShapeParameter};
use brdf_models::{MODELS, ParsedModel, parse_model_n};
use std::ops::Range;

/// Starts of roughnesses: half a decade apart and closer where materials crowd.
const ROUGHNESSES: &[f64] = &[0.003, 0.01, 0.03, 0.06, 0.12, 0.25, 0.5, 0.9];
/// Starts of exponents, n = 2/alpha^2 of [`ROUGHNESSES`] and like them.
const EXPONENTS: &[f64] = &[2.0, 8.0, 32.0, 140.0, 560.0, 2200.0, 2e4, 1e5];
/// Starts of reflectances at normal incidence: dielectrics and metals.
const REFLECTANCES: &[f64] = &[0.04, 0.5];
/// Reflectances are searched for short of the mirror, whose index is infinite.
const REFLECTANCE_RANGE: (f64, f64) = (1e-4, 0.9999);
/// Exponents below are flatter than any lobe.
const EXPONENT_RANGE: (f64, f64) = (0.1, 1e6);

/// Most lobes of a sum.
pub(crate) const MAX_LOBES: usize = 3;

/// Names of all families, in the order of the documentation. `koenderink-8`, whose 55 weights a channel are for few
/// measurements rather than for millions of cells, is known by name but not listed.
#[must_use]
pub fn families() -> Vec<&'static str> {
    let mut names: Vec<_> = registry::ENTRIES.iter().map(|e| e.name).collect();
    names.extend([lafortune::NAME, koenderink::NAMES[0]]);
    names.extend(albedo::ENTRIES.iter().map(|e| e.name));
    names
}

/// The family called `name` with so many specular lobes.
///
/// # Errors
/// [`FitError::UnknownModel`] and [`FitError::Lobes`].
pub fn family(name: &str, lobes: usize) -> Result<Box<dyn Family>, FitError> {
    let expect = |ok: bool, expected: String| {
        if ok {
            return Ok(());
        }
        Err(FitError::Lobes {
            model: name.into(),
            expected,
            found: lobes,
        })
    };
    let several = || {
        expect(
            (1..=MAX_LOBES).contains(&lobes),
            format!("1 to {MAX_LOBES} lobes"),
        )
    };
    if let Some(entry) = registry::ENTRIES.iter().find(|e| e.name == name) {
        if entry.has_lobe() {
            several()?;
        } else {
            expect(lobes == 1, "one lobe".into())?;
        }
        return Ok(Box::new(registry::Registered::new(entry, lobes)));
    }
    if let Some(entry) = albedo::ENTRIES.iter().find(|e| e.name == name) {
        expect(lobes == 1, "one lobe".into())?;
        return Ok(Box::new(albedo::Albedo::new(entry)));
    }
    match name {
        lafortune::NAME => {
            several()?;
            Ok(Box::new(lafortune::Lafortune::new(lobes)))
        }
        _ if koenderink::NAMES.contains(&name) => {
            expect(lobes == 1, "one lobe".into())?;
            Ok(Box::new(koenderink::KoenderinkVanDoorn::new(name)))
        }
        _ => Err(FitError::UnknownModel {
            name: name.into(),
            known: families().join(", "),
        }),
    }
}

/// `name` of lobe number `lobe`, 0, 1, ...: the first has no number, the second is called 2.
fn numbered(name: &str, lobe: usize) -> String {
    if lobe == 0 {
        name.into()
    } else {
        format!("{name}{}", lobe + 1)
    }
}

/// An exponent to search for.
fn exponent(lobe: usize) -> ShapeParameter {
    ShapeParameter {
        name: numbered("n", lobe),
        range: EXPONENT_RANGE,
        scale: Scale::Log,
        starts: EXPONENTS.into(),
    }
}

/// A model whose text the families wrote themselves.
#[expect(
    clippy::panic,
    reason = "families keep to the ranges of the registry; tests build every one"
)]
fn build<const K: usize>(text: &str) -> ParsedModel<K> {
    parse_model_n(text).unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// One weight of every channel as text, `0.1/0.2/0.3`.
fn channels(weights: &[Vec<f64>], index: usize) -> String {
    let values: Vec<String> = weights.iter().map(|w| w[index].to_string()).collect();
    values.join("/")
}

/// What brings the weights `lobes` of all channels into the range of `model`'s text, in which they are called `name`: 1
/// unless one of them is larger.
fn excess(weights: &[Vec<f64>], lobes: Range<usize>, (model, name): (&str, &str)) -> f64 {
    let info = MODELS.iter().find(|m| m.name == model);
    let parameter = info.and_then(|m| m.parameters.iter().find(|p| p.name == name));
    let most = parameter.map_or(f64::INFINITY, |p| p.range.1);
    let all = weights.iter().flat_map(|w| &w[lobes.clone()]);
    let largest = all.copied().fold(0.0, f64::max);
    if largest > most { largest } else { 1.0 }
}

/// All weights over `factor`.
fn over(weights: &[Vec<f64>], factor: f64) -> Vec<Vec<f64>> {
    let one = |w: &Vec<f64>| w.iter().map(|w| w / factor).collect();
    weights.iter().map(one).collect()
}

/// A part without a factor.
fn whole(text: String, channels: usize) -> Part {
    times(1.0, text, channels)
}

/// A part with one factor for all channels.
fn times(factor: f64, text: String, channels: usize) -> Part {
    Part {
        text,
        scale: vec![factor; channels],
    }
}

/// The Lambert lobe of the weights `index`, with what goes beyond an albedo of 1 in the factor.
fn lambert(weights: &[Vec<f64>], index: usize) -> Part {
    let largest = weights.iter().map(|w| w[index]).fold(1.0, f64::max);
    let kd = channels(&over(weights, largest), index);
    times(largest, format!("lambert:kd={kd}"), weights.len())
}

#[cfg(test)]
mod tests {
    use super::{families, family};
    use brdf::direction;
    use brdf_models::parse_model;

    #[test]
    fn weights_beyond_what_a_text_may_hold_go_into_the_factor() {
        let (wi, wo) = (direction(0.5, 0.0), direction(0.6, 2.9));
        let mut seen = 0;
        for name in families() {
            let family = family(name, 1).unwrap();
            if family.weights().len() != 2 {
                continue;
            }
            seen += 1;
            let shape: Vec<f64> = family.shape().iter().map(|s| s.starts[0]).collect();
            for ks in [[0.5, 0.2, 0.1], [5000.0, 2.0, 300.0]] {
                let weights = ks.map(|ks| vec![0.2, ks]);
                let mut lobes = [0.0; 2];
                family.lobes(&shape).eval(wi, wo, &mut lobes);
                let mut sum = [0.0; 3];
                for part in family.parts(&shape, &weights) {
                    let f = parse_model(&part.text).unwrap().built.brdf.eval(wi, wo);
                    (0..3).for_each(|c| sum[c] += part.scale[c] * f[c]);
                }
                for c in 0..3 {
                    let expected = 0.2 * lobes[0] + ks[c] * lobes[1];
                    assert!((sum[c] / expected - 1.0).abs() < 1e-12, "{name}: {sum:?}");
                }
            }
        }
        assert!(seen > 10, "only {seen} families have a lobe");
    }
}
