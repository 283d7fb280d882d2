//! f(wi, wo) = f(wo, wi), and isotropy where it is claimed.

use crate::cases::{all, examples, random_direction};
use brdf_models::{MODELS, ParsedModel};
use glam::{DMat3, DVec3};
use testkit::Rng;

/// Rounding of a dozen operations; the models are written symmetrically.
const TOLERANCE: f64 = 1e-12;

fn worst(model: &ParsedModel<3>, other: impl Fn(DVec3, DVec3) -> (DVec3, DVec3)) -> f64 {
    let mut rng = Rng::new(11);
    let mut worst = 0.0_f64;
    for _ in 0..3000 {
        let (wi, wo) = (random_direction(&mut rng), random_direction(&mut rng));
        let (a, b) = other(wi, wo);
        let (f, g) = (model.built.brdf.eval(wi, wo), model.built.brdf.eval(a, b));
        for c in 0..3 {
            // values far below a billionth of Lambert's are tails of exponentials: absolute there
            worst = worst.max((f[c] - g[c]).abs() / f[c].abs().max(g[c].abs()).max(1e-9));
        }
    }
    worst
}

#[test]
fn reciprocal_or_said_not_to_be() {
    for info in MODELS {
        let error = examples(info)
            .map(|m| worst(&m, |wi, wo| (wo, wi)))
            .fold(0.0, f64::max);
        if info.laws.reciprocal {
            assert!(error < TOLERANCE, "{}: {error:e}", info.name);
        } else {
            assert!(
                error > 0.01,
                "{} is reciprocal: say so in its laws ({error:e})",
                info.name
            );
        }
    }
}

#[test]
fn symmetry_is_what_it_says() {
    let turn = DMat3::from_rotation_z(1.1);
    for model in all() {
        let symmetry = model.built.brdf.symmetry();
        assert_eq!(symmetry.reciprocal, model.info.laws.reciprocal, "{model}");
        let error = worst(&model, |wi, wo| (turn * wi, turn * wo));
        // a turned direction is rounded anew, and narrow lobes feel it: 1e-16 / (width^2), width >= 0.01
        assert_eq!(error < 1e-10, symmetry.isotropic, "{model}: {error:e}");
    }
}
