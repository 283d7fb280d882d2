//! `sample` and `pdf` name the same density, over very many draws.

use crate::viewer;
use brdf::{DirectionSampler, direction};
use brdf_sampling::{Hvt, Preset, Target};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Lobes of widths `x` and `y` over a diffuse floor.
fn agree(preset: Preset, [x, y]: [f64; 2], draws: usize) {
    let f = move |wi: DVec3, wo: DVec3| {
        let h = wi + wo;
        let q = 1.0 + ((h.x / x).powi(2) + (h.y / y).powi(2)) / (h.z * h.z);
        0.1 + 1.0 / (x * q * q)
    };
    let mut target = Target::new(&f);
    target.symmetry.isotropic = x.to_bits() == y.to_bits();
    let sampler = Hvt::new(target, preset.options());
    let mut rng = testkit::Rng::new(17);
    let mut off: Vec<f64> = (0..draws)
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
    let high = off[draws - draws / 10_000];
    assert!(high < 1e-6, "{preset:?}, {x} x {y}: 99.99 % at {high:e}");
}

#[test]
fn sample_and_pdf_agree_on_hard_lobes() {
    for preset in [Preset::Tiny, Preset::Default, Preset::Fine] {
        agree(preset, [0.005, 0.005], 100_000);
    }
    agree(Preset::Tiny, [0.005, 0.02], 100_000);
}

#[test]
fn slow_sample_and_pdf_agree_over_a_million_draws() {
    for preset in Preset::ALL {
        for width in [0.005, 0.1] {
            agree(preset, [width, width], 1_000_000);
        }
    }
    agree(Preset::Default, [0.005, 0.05], 1_000_000);
}
