//! RGL tables against Mitsuba's values, and the file's own sampling against its density.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use brdf::{Brdf, DirectionSampler, LANES, Lanes3, Measured, Status, direction};
use brdf_formats::RglFile;
use brdf_table::{RglN, RglTable};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[expect(
    clippy::disallowed_methods,
    reason = "test data from the folder the environment names"
)]
fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap()
}

fn dir() -> Option<PathBuf> {
    Some(testkit::data_dir_or_skip()?.join("rgl"))
}

fn load(dir: &Path, name: &str) -> RglTable {
    RglTable::new(&RglFile::from_bytes(read(&dir.join(name))).unwrap()).unwrap()
}

/// Rows of a golden file by the name of the table.
fn golden(dir: &Path, name: &str) -> BTreeMap<String, Vec<Vec<f64>>> {
    let mut rows = BTreeMap::<_, Vec<_>>::new();
    for line in String::from_utf8(read(&dir.join(name)))
        .unwrap()
        .lines()
        .skip(1)
    {
        let (file, numbers) = line.split_once(',').unwrap();
        let numbers = numbers.split(',').map(|v| v.parse().unwrap()).collect();
        rows.entry(file.to_owned()).or_default().push(numbers);
    }
    rows
}

/// Relative to the value, with a floor for values that are differences of larger ones.
fn close(got: f64, expected: f64, scale: f64, tolerance: f64) -> f64 {
    (got - expected).abs() / expected.abs().max(tolerance * scale).max(1e-30)
}

#[test]
fn values_and_density_agree_with_mitsuba() {
    let Some(dir) = dir() else { return };
    for (name, rows) in golden(&dir, "golden_eval_mitsuba3.9.1_scalar_rgb.csv") {
        let table = load(&dir, &name);
        let (mut worst_f, mut worst_pdf) = (0.0_f64, 0.0_f64);
        for row in rows {
            // the golden file's wi is the known direction: the viewer here
            let (known, sampled) = (DVec3::from_slice(&row[..3]), DVec3::from_slice(&row[3..6]));
            let mut f_cos = [0.0; 3];
            table.eval_f_cos(sampled, known, &mut f_cos);
            let scale = row[6..9].iter().fold(0.0_f64, |a, v| a.max(v.abs()));
            for c in 0..3 {
                worst_f = worst_f.max((f_cos[c] - row[6 + c]).abs() / scale.max(1e-12));
            }
            let mut f = [0.0; 3];
            table.eval_native(sampled, known, &mut f);
            assert!(
                (f[0] * sampled.z - f_cos[0]).abs() <= 1e-12 * scale,
                "f times cosine"
            );
            worst_pdf = worst_pdf.max(close(table.pdf(sampled, known), row[9], 1.0, 1e-6));
        }
        println!("{name}: f cos {worst_f:.1e}, pdf {worst_pdf:.1e}");
        // relative to the largest channel; Mitsuba computes in single precision
        assert!(worst_f < 1e-5, "{name}: f cos differs by {worst_f:e}");
        assert!(worst_pdf < 1e-5, "{name}: pdf differs by {worst_pdf:e}");
    }
}

#[test]
fn samples_agree_with_mitsuba() {
    let Some(dir) = dir() else { return };
    for (name, rows) in golden(&dir, "golden_sample_mitsuba3.9.1_scalar_rgb.csv") {
        let table = load(&dir, &name);
        let (mut direction, mut density, mut weight) = (0.0_f64, 0.0_f64, 0.0_f64);
        for row in rows {
            let known = DVec3::from_slice(&row[..3]);
            let expected = DVec3::from_slice(&row[5..8]);
            let Some(s) = table.sample(known, DVec2::new(row[3], row[4])) else {
                assert!(
                    row[8] == 0.0 || expected.z <= 1e-5,
                    "{name}: nothing sampled for {row:?}"
                );
                continue;
            };
            direction = direction.max((s.wi - expected).length());
            density = density.max((s.pdf / row[8] - 1.0).abs());
            let mut f_cos = [0.0; 3];
            table.eval_f_cos(s.wi, known, &mut f_cos);
            let scale = row[9..12].iter().fold(0.0_f64, |a, v| a.max(v.abs()));
            for c in 0..3 {
                weight = weight.max((f_cos[c] / s.pdf - row[9 + c]).abs() / scale.max(1e-12));
            }
        }
        println!("{name}: direction {direction:.1e}, pdf {density:.1e}, weight {weight:.1e}");
        assert!(
            direction < 1e-5 && density < 1e-4 && weight < 1e-4,
            "{name}: {direction:e} {density:e} {weight:e}"
        );
    }
}

#[test]
fn sampling_follows_its_density() {
    let Some(dir) = dir() else { return };
    let names = ["cc_ibiza_sunset_rgb.bsdf", "paper_white_rgb.bsdf"];
    let angles = [0.2_f64, 1.2];
    for name in names {
        let table = load(&dir, name);
        for theta in angles {
            let wo = direction(theta, 0.7);
            let config = testkit::chi2::Config {
                samples: 40_000,
                seed: 11,
                tests: names.len() * angles.len(),
                ..Default::default()
            };
            let report = testkit::chi2::test(
                &config,
                |rng| {
                    let [a, b] = rng.uniform2();
                    Some(table.sample(wo, DVec2::new(a, b))?.wi.to_array())
                },
                |wi| table.pdf(DVec3::from_array(wi), wo),
            );
            println!(
                "{name} at {theta}: p = {:.3}, waste {:.4}",
                report.p_value,
                table.waste(wo, 64)
            );
            assert!(report.ok, "{name} at {theta}: {report}");
        }
    }
}

#[test]
fn a_density_that_forgets_the_waste_is_found() {
    let Some(dir) = dir() else { return };
    let table = load(&dir, "paper_white_rgb.bsdf");
    let wo = direction(0.2, 0.7);
    let kept = 1.0 - table.waste(wo, 64);
    let config = testkit::chi2::Config {
        samples: 40_000,
        seed: 12,
        ..Default::default()
    };
    let report = testkit::chi2::test(
        &config,
        |rng| {
            let [a, b] = rng.uniform2();
            Some(table.sample(wo, DVec2::new(a, b))?.wi.to_array())
        },
        |wi| table.pdf(DVec3::from_array(wi), wo) / kept,
    );
    assert!(!report.ok, "a density normalised to 1 passed: {report}");
}

#[test]
fn hard_cases_are_finite() {
    let Some(dir) = dir() else { return };
    let table = Arc::new(load(&dir, "vch_golden_yellow_rgb.bsdf"));
    let three = RglN::<3>::new(Arc::clone(&table)).unwrap();
    assert!(
        RglN::<4>::new(Arc::clone(&table)).is_none(),
        "three channels are not four"
    );
    assert!(
        !Measured::symmetry(&*table).reciprocal,
        "the tables are not reciprocal"
    );
    let grazing = std::f64::consts::FRAC_PI_2 - 1e-7;
    for (a, b) in [
        (0.0, 0.0),
        (0.5, 0.5),
        (grazing, grazing),
        (0.0, grazing),
        (grazing, 0.3),
    ] {
        for phi in [0.0, 1.0, std::f64::consts::PI] {
            let (wi, wo) = (direction(a, 0.0), direction(b, phi));
            let mut f = [0.0; 3];
            assert_eq!(
                table.eval_native(wi, wo, &mut f),
                Status::Interpolated,
                "{wi} {wo}"
            );
            assert!(f.iter().all(|v| v.is_finite()), "{wi} {wo}: {f:?}");
            assert_eq!(
                three.eval(wi, wo).map(f64::to_bits),
                f.map(f64::to_bits),
                "one value, two ways"
            );
            assert!(table.pdf(wi, wo).is_finite(), "{wi} {wo}");
            assert_eq!(
                table.eval_native(-wi, wo, &mut f),
                Status::Filled,
                "below the horizon"
            );
            let sum: f64 = f.iter().map(|v| v.abs()).sum();
            assert!(sum + table.pdf(-wi, wo) <= 0.0, "below the horizon: {f:?}");
        }
        for u in [
            DVec2::ZERO,
            DVec2::splat(1.0 - f64::EPSILON),
            DVec2::new(0.0, 0.999),
        ] {
            if let Some(s) = table.sample(direction(b, 1.0), u) {
                assert!(
                    s.wi.is_normalized() && s.pdf > 0.0 && s.pdf.is_finite(),
                    "{s:?}"
                );
            }
        }
    }
}

/// Packets against the scalar form at the same directions.
#[test]
fn packets_agree_with_the_scalar_form() {
    let Some(dir) = dir() else { return };
    let mut rng = sampling::Rng::new(5);
    for name in ["satin_rosaline_rgb.bsdf", "cc_ibiza_sunset_rgb.bsdf"] {
        let table = Arc::new(load(&dir, name));
        let three = RglN::<3>::new(Arc::clone(&table)).unwrap();
        let (mut worst_f, mut worst_pdf, mut worst_wi) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut missed = 0;
        for round in 0..200 {
            let (mut wo, mut wi) = (Lanes3::ZERO, Lanes3::ZERO);
            let mut u = [[0.0; LANES]; 2];
            for k in 0..LANES {
                let [a, b] = [rng.uniform2(), rng.uniform2()];
                // the first lane looks along the normal
                let (theta, phi) = if k == 0 {
                    (0.0, 0.0)
                } else {
                    (1.5 * a.x, TAU * a.y)
                };
                wo.set(k, direction(theta, phi).as_vec3());
                wi.set(k, direction(1.5 * b.x, TAU * b.y).as_vec3());
                let [x, y] = rng.uniform2().to_array();
                (u[0][k], u[1][k]) = (x as f32, y as f32);
            }
            let s = table.sample_lanes(&wo, &u);
            // half of the rounds where the sampling looks, half anywhere
            let wi = if round % 2 == 0 { s.wi } else { wi };
            let (f, pdf) = (three.eval_lanes(&wi, &wo), table.pdf_lanes(&wi, &wo));
            for k in 0..LANES {
                let (i, o) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                let exact = three.eval(i, o);
                let scale = exact.iter().fold(1e-3_f64, |a, v| a.max(v.abs()));
                for c in 0..3 {
                    worst_f = worst_f.max((f64::from(f[c][k]) - exact[c]).abs() / scale);
                }
                let exact = table.pdf(i, o);
                worst_pdf = worst_pdf.max((f64::from(pdf[k]) - exact).abs() / exact.max(1e-2));
                let at = DVec2::new(f64::from(u[0][k]), f64::from(u[1][k]));
                match table.sample(o, at) {
                    Some(exact) if s.pdf[k] > 0.0 => {
                        let off = (exact.wi - s.wi.get(k).as_dvec3()).length();
                        worst_wi = worst_wi.max(off * exact.pdf.sqrt());
                        if round % 2 == 0 {
                            let twice = f64::from((s.pdf[k] / pdf[k] - 1.0).abs());
                            worst_pdf = worst_pdf.max(twice);
                        }
                    }
                    None if s.pdf[k] <= 0.0 => {}
                    // reflected to the very horizon
                    _ => missed += 1,
                }
            }
        }
        println!("{name}: f {worst_f:.1e}, pdf {worst_pdf:.1e}, direction {worst_wi:.1e}");
        // coordinates are good to 4e-7 of the square, which is 5e-5 of a cell of 128, over which values may double
        assert!(worst_f < 2e-4, "{name}: f differs by {worst_f:e}");
        assert!(worst_pdf < 2e-4, "{name}: pdf differs by {worst_pdf:e}");
        assert!(worst_wi < 1e-5, "{name}: directions differ by {worst_wi:e}");
        assert!(missed <= 2, "{name}: {missed} samples in one form alone");
    }
}
