//! What the exports evaluate keeps the contract of a reflectance.

use brdf::{Brdf, direction};
use brdf_fit::Part;
use brdf_fit::export::{MetalMix, Model3, Shadowing};

fn cases() -> Vec<Box<dyn Brdf<3>>> {
    let mix = |shadowing| MetalMix {
        amount: 0.4,
        diffuse: [0.5, 0.3, 0.1],
        reflectance: [0.9, 0.5, 0.04],
        alpha: 0.3,
        shadowing,
    };
    let part = |text: &str, scale: [f64; 3]| Part {
        text: text.into(),
        scale: scale.into(),
    };
    let sum = [
        part("lambert:kd=0.3", [1.0; 3]),
        part("ward-gmd:alpha=0.2,ks=0.1,kd=0", [2.0, 1.0, 0.5]),
    ];
    vec![
        Box::new(mix(Shadowing::Correlated)),
        Box::new(mix(Shadowing::Separable)),
        Box::new(Model3::new(&sum).unwrap()),
    ]
}

#[test]
fn reciprocal_and_black_below_the_horizon() {
    for model in cases() {
        for k in 0..100 {
            let k = f64::from(k);
            // 90 degrees is never met: steps of the golden angle and of another irrational
            let (wi, wo) = (
                direction(1.57 * (0.618 * k).fract(), 2.4 * k),
                direction(1.57 * (0.755 * k).fract(), 1.1 * k),
            );
            let (a, b) = (model.eval(wi, wo), model.eval(wo, wi));
            for c in 0..3 {
                assert!(
                    (a[c] - b[c]).abs() <= 1e-12 * a[c] && a[c] >= 0.0,
                    "{wi} {wo}: {a:?} {b:?}"
                );
            }
            assert!(
                model.eval(-wi, wo).iter().all(|f| *f <= 0.0),
                "light below the horizon"
            );
            assert!(
                model.eval(wi, -wo).iter().all(|f| *f <= 0.0),
                "viewer below the horizon"
            );
        }
    }
}
