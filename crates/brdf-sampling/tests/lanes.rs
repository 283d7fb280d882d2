//! Packets of directions in f32 against the scalar form in f64.

use brdf::{DirectionSampler, LANES, Lanes3, direction};
use brdf_sampling::{Hvt, Preset, Target};
use glam::{DVec2, DVec3};
use testkit::Rng;

/// A lobe of the given width over a diffuse floor.
fn sampler(width: f64) -> Hvt {
    let f = move |wi: DVec3, wo: DVec3| {
        let h = wi + wo;
        let q = 1.0 + (h.x * h.x + h.y * h.y) / (width * width * h.z * h.z);
        0.1 + 1.0 / (width * q * q)
    };
    Hvt::new(Target::new(&f), Preset::Default.options())
}

/// A lobe three times as wide across as along.
fn brushed() -> Hvt {
    let f = |wi: DVec3, wo: DVec3| {
        let h = wi + wo;
        let q = 1.0 + ((h.x / 0.05).powi(2) + (h.y / 0.15).powi(2)) / (h.z * h.z);
        0.1 + 10.0 / (q * q)
    };
    let mut target = Target::new(&f);
    target.symmetry.isotropic = false;
    Hvt::new(target, Preset::Default.options())
}

/// Relative difference at the given quantile.
fn quantile(mut off: Vec<f64>, q: f64) -> f64 {
    off.sort_by(f64::total_cmp);
    off[(q * (off.len() - 1) as f64) as usize]
}

#[test]
fn lanes_agree_with_the_scalar_form() {
    // f32 directions leave h uncertain by 1e-7 and lobes of width w uncertain by 1e-7 / w
    for (width, s, typical, rare) in [
        ("0.5", sampler(0.5), 3e-6, 1e-4),
        ("0.05", sampler(0.05), 1e-5, 1e-3),
        ("0.005", sampler(0.005), 1e-4, 1e-2),
        ("0.05 x 0.15", brushed(), 1e-5, 1e-3),
    ] {
        let mut rng = Rng::new(9);
        let (mut direction_off, mut sampled_off, mut pdf_off) =
            (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..400 {
            let (mut wo, mut u) = (Lanes3::ZERO, [[0.0; LANES]; 2]);
            for k in 0..LANES {
                wo.set(
                    k,
                    direction(1.5 * rng.uniform(), 6.2 * rng.uniform()).as_vec3(),
                );
                u[0][k] = rng.uniform() as f32;
                u[1][k] = rng.uniform() as f32;
            }
            let packet = s.sample_lanes(&wo, &u);
            let pdfs = s.pdf_lanes(&packet.wi, &wo);
            for k in 0..LANES {
                let viewer = wo.get(k).as_dvec3();
                let uk = DVec2::new(f64::from(u[0][k]), f64::from(u[1][k]));
                let one = s.sample(viewer, uk).unwrap();
                let wi = packet.wi.get(k).as_dvec3();
                direction_off.push((wi - one.wi).length());
                sampled_off.push((f64::from(packet.pdf[k]) / one.pdf - 1.0).abs());
                pdf_off.push((f64::from(pdfs[k]) / s.pdf(wi, viewer) - 1.0).abs());
            }
        }
        for (name, off) in [("sampled", sampled_off), ("pdf", pdf_off)] {
            let (median, high) = (quantile(off.clone(), 0.5), quantile(off, 0.999));
            assert!(median < typical, "{name} at width {width}: median {median}");
            assert!(high < rare, "{name} at width {width}: 99.9 % {high}");
        }
        let far = quantile(direction_off, 0.999);
        assert!(far < 2e-4, "directions at width {width}: 99.9 % {far}");
    }
}

#[test]
fn lanes_below_the_horizon_are_zero() {
    let s = sampler(0.1);
    let mut wo = Lanes3::ZERO;
    let mut wi = Lanes3::ZERO;
    for k in 0..LANES {
        let down = if k % 2 == 0 { 0.3 } else { -0.3 };
        wo.set(k, DVec3::new(0.9539392, 0.0, down).as_vec3());
        wi.set(k, DVec3::Z.as_vec3());
    }
    let sampled = s.sample_lanes(&wo, &[[0.5; LANES]; 2]);
    let pdfs = s.pdf_lanes(&wi, &wo);
    for k in 0..LANES {
        assert_eq!(sampled.pdf[k] > 0.0, k % 2 == 0, "sampled lane {k}");
        assert_eq!(pdfs[k] > 0.0, k % 2 == 0, "pdf of lane {k}");
    }
}
