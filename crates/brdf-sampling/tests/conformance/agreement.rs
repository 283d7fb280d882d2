//! `sample` and `pdf` name the same density, over very many draws.

use crate::viewer;
use brdf::{DirectionSampler, direction};
use brdf_sampling::{Hvt, Preset, Target};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

#[test]
fn slow_sample_and_pdf_agree_over_a_million_draws() {
    const DRAWS: usize = 1_000_000;
    for preset in Preset::ALL {
        for width in [0.005, 0.1] {
            let f = move |wi: DVec3, wo: DVec3| {
                let h = wi + wo;
                let q = 1.0 + (h.x * h.x + h.y * h.y) / (width * width * h.z * h.z);
                0.1 + 1.0 / (width * q * q)
            };
            let sampler = Hvt::new(Target::new(&f), preset.options());
            let mut rng = testkit::Rng::new(17);
            let mut off: Vec<f64> = (0..DRAWS)
                .map(|_| {
                    let [x, y] = rng.uniform2();
                    let wo = direction((1.0 - x).acos(), TAU * y);
                    let wo = if wo.z > 0.0 { wo } else { viewer(89.0) };
                    let s = sampler.sample(wo, DVec2::from(rng.uniform2()));
                    let s = s.expect("nothing is wasted");
                    (sampler.pdf(s.wi, wo) / s.pdf - 1.0).abs()
                })
                .collect();
            off.sort_by(f64::total_cmp);
            let high = off[DRAWS - DRAWS / 10_000];
            assert!(
                high < 1e-6,
                "{preset:?}, width {width}: 99.99 % at {high:e}"
            );
        }
    }
}
