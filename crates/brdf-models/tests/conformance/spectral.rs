//! Models by wavelength (`Tinted` facets, He's waves, K-correlation) keep the laws they keep in RGB.

use crate::cases::{all, random_direction};
use brdf::{Brdf, LANES, Lanes3};
use brdf_models::Seeing;
use spectrum::{LinearUplift, Spectrum};
use std::sync::Arc;
use testkit::Rng;

const LAMBDA_NM: [f64; 8] = [420.0, 450.0, 480.0, 510.0, 540.0, 580.0, 620.0, 680.0];

/// Every example that knows wavelengths, at eight of them.
fn spectral() -> Vec<(String, Arc<dyn Brdf<8>>)> {
    let uplift = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(|rgb| LAMBDA_NM.map(|nm| LinearUplift::spectrum(rgb).at(nm)));
    let project = |s: &Spectrum| LAMBDA_NM.iter().map(|nm| s.at(*nm)).collect();
    let seeing = Seeing {
        lambda_nm: &LAMBDA_NM,
        project: &project,
        uplift: std::array::from_fn(|c| &uplift[c][..]),
    };
    all()
        .filter_map(|m| Some((m.to_string(), m.spectral()?.in_channels(&seeing))))
        .collect()
}

#[test]
fn models_by_wavelength_are_reciprocal_positive_and_the_same_in_packets() {
    let models = spectral();
    assert!(
        models.len() >= 5,
        "{} examples know wavelengths",
        models.len()
    );
    let mut rng = Rng::new(11);
    for (text, model) in models {
        for _ in 0..200 {
            let (wi, wo) = (random_direction(&mut rng), random_direction(&mut rng));
            let (f, back) = (model.eval(wi, wo), model.eval(wo, wi));
            for c in 0..8 {
                assert!(f[c] >= 0.0 && f[c].is_finite(), "{text}: {f:?}");
                assert!(
                    (f[c] - back[c]).abs() <= 1e-12 * f[c],
                    "{text}: {f:?} {back:?}"
                );
            }
            let (mut i, mut o) = (Lanes3::ZERO, Lanes3::ZERO);
            for k in 0..LANES {
                i.set(k, wi.as_vec3());
                o.set(k, wo.as_vec3());
            }
            let lanes = model.eval_lanes(&i, &o);
            let exact = model.eval(i.get(0).as_dvec3(), o.get(0).as_dvec3());
            for c in 0..8 {
                // narrow lobes feel the rounding of f32 half vectors by their inverse width
                let (found, exact) = (f64::from(lanes[c][0]), exact[c]);
                assert!(
                    (found - exact).abs() <= 1e-3 * exact + 1e-6,
                    "{text}: {found} {exact}"
                );
            }
        }
    }
}
