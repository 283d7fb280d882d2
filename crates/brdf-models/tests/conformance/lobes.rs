//! Models taken apart into lobes: f is linear in what the registry calls weights, and in nothing else.

use crate::cases::{all, random_direction};
use brdf_models::{MODELS, Role, build_model, parse_model};
use glam::DVec3;
use testkit::Rng;

/// Rounding of sums of a few lobes, some of them large where they cancel: the diffuse part of a peak.
const TOLERANCE: f64 = 1e-12;

#[test]
fn a_model_is_the_sum_of_its_weighted_lobes() {
    for model in all() {
        let (rest, lobes) = model.lobes();
        let mut rng = Rng::new(31);
        for _ in 0..200 {
            let (wi, wo) = (random_direction(&mut rng), random_direction(&mut rng));
            let (whole, f_0) = (model.built.brdf.eval(wi, wo), rest.eval(wi, wo));
            let (mut sum, mut scale) = (f_0, f_0.map(f64::abs));
            for lobe in &lobes {
                let (weights, f_j) = (model.values.get(&lobe.weight), lobe.brdf.eval(wi, wo));
                for c in 0..3 {
                    let w = if weights.len() == 1 {
                        weights[0]
                    } else {
                        weights[c]
                    };
                    sum[c] += w * (f_j[c] - f_0[c]);
                    scale[c] += f_j[c].abs();
                }
            }
            for c in 0..3 {
                let error = (sum[c] - whole[c]).abs() / scale[c].max(whole[c].abs()).max(1e-300);
                assert!(
                    error < TOLERANCE,
                    "{model}: {} {} at {wi} {wo}",
                    sum[c],
                    whole[c]
                );
            }
        }
    }
}

#[test]
fn shapes_are_not_linear() {
    // halving or doubling a shape does not do so to the model: what should be a weight is not missed
    let directions = [
        (DVec3::new(0.48, 0.36, 0.8), DVec3::new(-0.6, 0.0, 0.8)),
        (DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.0, -0.28, 0.96)),
    ];
    for info in MODELS {
        let default = parse_model(info.name).unwrap();
        for p in info.parameters.iter().filter(|p| p.role == Role::Shape) {
            let &[value] = default.values.get(p.name) else {
                continue;
            };
            let factor = if 0.5 * value >= p.range.0 { 0.5 } else { 2.0 };
            let scaled = build_model::<3>(info, &[(p.name, &[factor * value])]).unwrap();
            let linear = directions.iter().all(|(wi, wo)| {
                let (f, g) = (
                    default.built.brdf.eval(*wi, *wo)[0],
                    scaled.built.brdf.eval(*wi, *wo)[0],
                );
                (g - factor * f).abs() < 1e-9 * f
            });
            assert!(!linear, "{}: `{}` is a weight, say so", info.name, p.name);
        }
    }
}
