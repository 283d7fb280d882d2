//! Every parameter at both ends of its range, directions at every edge: finite, never negative.

use crate::cases::{examples, random_direction};
use brdf::direction;
use brdf_models::{DefaultValue, MODELS, ModelInfo, Parameter, ParsedModel, parse_model};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// The model with one parameter at an end of its range, or at one of its choices, the rest at default.
fn at_ends(
    info: &'static ModelInfo,
    p: &'static Parameter,
) -> impl Iterator<Item = ParsedModel<3>> {
    let values: Vec<String> = match p.choices {
        [] => [p.range.0, p.range.1].map(|v| v.to_string()).to_vec(),
        choices => choices.iter().map(|c| (*c).to_owned()).collect(),
    };
    values.into_iter().map(move |value| {
        parse_model(&format!("{}:{}={value}", info.name, p.name)).expect("an end of a range")
    })
}

/// Directions at the pole, ordinary ones, and down to 1e-7 and 1e-12 rad above the horizon.
fn directions() -> Vec<DVec3> {
    let thetas = [
        0.0,
        1e-9,
        1e-4,
        0.3,
        1.2,
        FRAC_PI_2 - 1e-3,
        FRAC_PI_2 - 1e-7,
        FRAC_PI_2 - 1e-12,
    ];
    let phis = [0.0, 1e-9, 0.8, PI - 1e-9, PI, -2.0];
    let mut all: Vec<_> = thetas
        .iter()
        .flat_map(|&t| phis.map(|p| direction(t, p)))
        .collect();
    // opposite along the surface, and so low that squares underflow
    all.extend([
        DVec3::new(1.0, 0.0, 1e-170),
        DVec3::new(-1.0, 0.0, 1e-170),
        DVec3::new(-1.0, 0.0, 1e-50),
    ]);
    all
}

fn check(model: &ParsedModel<3>) {
    let directions = directions();
    for &wo in &directions {
        for &wi in &directions {
            let f = model.built.brdf.eval(wi, wo);
            assert!(
                f.iter()
                    .all(|v| v.is_finite() && (*v >= 0.0 || !model.info.laws.non_negative)),
                "{model}: f({wi}, {wo}) = {f:?}"
            );
            let pdf = model.built.sampler.pdf(wi, wo);
            assert!(
                pdf.is_finite() && pdf >= 0.0,
                "{model}: pdf({wi}, {wo}) = {pdf}"
            );
        }
        for u in [0.0, 1e-12, 0.3, 0.9, 1.0 - f64::EPSILON] {
            for v in [0.0, 0.25, 0.5, 0.77, 1.0 - f64::EPSILON] {
                if let Some(s) = model.built.sampler.sample(wo, DVec2::new(u, v)) {
                    let sound =
                        s.wi.is_finite() && s.pdf.is_finite() && s.pdf > 0.0 && s.wi.z > 0.0;
                    assert!(sound, "{model}: sample({wo}, {u}, {v}) = {s:?}");
                    assert!(
                        (s.wi.length() - 1.0).abs() < 1e-9,
                        "{model}: {s:?} is not of unit length"
                    );
                }
            }
        }
    }
}

#[test]
fn both_ends_of_every_range() {
    for info in MODELS {
        check(&parse_model(info.name).unwrap());
        for p in info.parameters {
            at_ends(info, p).for_each(|model| check(&model));
        }
    }
}

#[test]
fn negative_where_it_is_said() {
    let mut rng = testkit::Rng::new(7);
    for info in MODELS.iter().filter(|m| !m.laws.non_negative) {
        let negative = examples(info).any(|model| {
            (0..2000).any(|_| {
                let (wi, wo) = (random_direction(&mut rng), random_direction(&mut rng));
                model.built.brdf.eval(wi, wo).iter().any(|v| *v < 0.0)
            })
        });
        assert!(
            negative,
            "{} is nowhere negative: say so in its laws",
            info.name
        );
    }
}

#[test]
fn defaults_are_in_range() {
    for p in MODELS.iter().flat_map(|m| m.parameters) {
        if let DefaultValue::Value(v) = p.default {
            assert!((p.range.0..=p.range.1).contains(&v), "{p:?}");
        }
    }
}
