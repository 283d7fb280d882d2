//! Directions and parameters at their extremes.

use brdf::direction;
use brdf_models::{MODELS, ModelInfo, Parameter, ParsedModel, parse_model};
use glam::{DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Polar angles: the pole, a hair beside it, ordinary ones, and down to 1e-7 rad above the horizon.
pub(crate) const THETAS: [f64; 8] = [
    0.0,
    1e-9,
    1e-4,
    0.3,
    1.2,
    FRAC_PI_2 - 1e-3,
    FRAC_PI_2 - 1e-5,
    FRAC_PI_2 - 1e-7,
];

/// A direction and what is special about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Named {
    pub(crate) w: DVec3,
    pub(crate) what: &'static str,
}

/// Viewers: every polar angle at azimuths on an axis and off it.
pub(crate) fn viewers() -> Vec<DVec3> {
    THETAS
        .iter()
        .flat_map(|&t| [0.0, 0.8].map(|p| direction(t, p)))
        .collect()
}

/// Lights for a viewer: where lobes have their peaks and flanks, and where formulas divide by little.
pub(crate) fn lights(wo: DVec3) -> Vec<Named> {
    let mut all = vec![
        Named {
            w: wo,
            what: "wi = wo",
        },
        // -wo, lifted by what keeps it above the horizon
        Named {
            w: DVec3::new(-wo.x, -wo.y, (-wo.z).max(1e-7)).normalize(),
            what: "wi = -wo",
        },
        Named {
            w: DVec3::new(-wo.x, -wo.y, wo.z),
            what: "h at the pole",
        },
        Named {
            w: DVec3::Z,
            what: "wi at the pole",
        },
    ];
    // half vectors tilted by less and more than any lobe is wide; no round numbers, which critical angles might be
    for tilt in [
        1.1e-12, 1.1e-9, 1.1e-6, 1.1e-5, 1.1e-4, 3.3e-4, 1.1e-3, 1.1e-2, 0.11, 0.3, 0.8,
    ] {
        for azimuth in [0.0, 2.0, 4.0] {
            let h = direction(tilt, azimuth);
            all.push(Named {
                w: (2.0 * wo.dot(h) * h - wo).normalize(),
                what: "about the mirror",
            });
        }
    }
    for (k, &theta) in THETAS.iter().enumerate() {
        for p in [0.0, PI, 2.6] {
            all.push(Named {
                w: direction(theta, p + 1e-3 * k as f64),
                what: "anywhere",
            });
        }
    }
    all.retain(|n| n.w.z > 0.0);
    all
}

/// Every `step`-th pair of viewer and light (wi, wo), with what is special about it.
pub(crate) fn pairs(step: usize) -> Vec<(Named, DVec3)> {
    let all = viewers()
        .into_iter()
        .flat_map(|wo| lights(wo).into_iter().map(move |wi| (wi, wo)));
    all.step_by(step).collect()
}

/// A direction of which both precisions see the same numbers.
pub(crate) fn in_f32(w: DVec3) -> Vec3 {
    w.as_vec3()
}

/// What a parameter is set to: every choice, or values over its range.
fn texts(p: &Parameter) -> Vec<String> {
    match p.choices {
        [] => values(p).iter().map(f64::to_string).collect(),
        choices => choices.iter().map(|c| (*c).to_owned()).collect(),
    }
}

/// Values of a parameter over its range, both ends included: by powers of ten where the range spans many.
pub(crate) fn values(p: &Parameter) -> Vec<f64> {
    let (low, high) = p.range;
    let mut all = vec![low, high];
    if high <= 100.0 * low.abs() || low < 0.0 {
        all.extend([0.25, 0.5, 0.75].map(|t| low + t * (high - low)));
    } else {
        // seven decades below the top, or as many as there are
        all.extend((1..=7).map(|k| high * 10_f64.powi(-k)).filter(|v| *v > low));
    }
    all
}

/// A model at one extreme: the default with one parameter moved, and its examples.
pub(crate) fn settings(info: &'static ModelInfo) -> Vec<ParsedModel<3>> {
    let moved = info
        .parameters
        .iter()
        .flat_map(|p| texts(p).into_iter().map(move |v| format!("{}={v}", p.name)));
    let examples = info.examples.iter().map(|e| (*e).to_owned());
    moved
        .chain(examples)
        // what a model does not accept together is no setting of it
        .filter_map(|text| parse_model(&format!("{}:{text}", info.name)).ok())
        .collect()
}

/// All models there are.
pub(crate) fn models() -> impl Iterator<Item = &'static ModelInfo> {
    MODELS.iter()
}

#[cfg(test)]
mod tests {
    use super::{models, pairs, settings, viewers};
    use std::f64::consts::{FRAC_PI_2, PI};

    /// All values of a parameter on the grid.
    fn on_the_grid(model: &str, parameter: &str) -> Vec<f64> {
        let info = models().find(|m| m.name == model).unwrap();
        let all = settings(info).into_iter();
        all.flat_map(|s| s.values.get(parameter).to_vec()).collect()
    }

    #[test]
    fn what_was_asked_for_is_on_it() {
        for (model, parameter) in [
            ("ggx", "alpha_x"),
            ("ward", "alpha_y"),
            ("cook-torrance", "m"),
        ] {
            let all = on_the_grid(model, parameter);
            assert!(
                all.contains(&1e-4) && all.contains(&1.0),
                "{model}: {all:?}"
            );
        }
        for model in ["phong", "lewis", "blinn-phong", "lafortune"] {
            assert!(on_the_grid(model, "n").contains(&1e6), "{model}");
        }
        // g = (4 pi sigma/lambda)^2 of He toward the normal
        let g = on_the_grid("he", "sigma").into_iter();
        let g: Vec<f64> = g.map(|s| (4.0 * PI * s / 0.55).powi(2)).collect();
        let within = |low: f64, high: f64| g.iter().any(|g| (low..high).contains(g));
        assert!(within(1e-9, 1e-6) && within(1e6, 1e9), "{g:?}");
        assert!(
            (-6..6)
                .step_by(2)
                .all(|k| within(10_f64.powi(k), 10_f64.powi(k + 2))),
            "{g:?}"
        );
        let lowest = viewers().iter().fold(1.0_f64, |z, w| z.min(w.z));
        assert!(
            (lowest / (FRAC_PI_2 - 1e-7).cos() - 1.0).abs() < 1e-6,
            "{lowest:e}"
        );
        for what in ["wi = wo", "wi = -wo", "h at the pole", "wi at the pole"] {
            assert!(pairs(1).iter().any(|(n, _)| n.what == what), "{what}");
        }
    }
}
