//! MERL files as tables: policies, round trips, and MERL stand-ins against the network they come from.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use brdf::{HalfDiff, Status, direction};
use brdf_formats::{MerlFile, MerlReader};
use brdf_table::{CellPolicy, HalfDiffTable, Interpolation, PhiDomain};
use glam::DVec3;
use spectrum::{Basis, RgbSpace};
use std::f64::consts::PI;

const DIMS: [u32; 3] = [4, 5, 6];

/// A file with one cell of each kind; everything else is `1500 (cell + 1)`.
fn file() -> MerlFile {
    MerlFile::from_fn(DIMS, |channel, cell| match (cell, channel) {
        (7, _) => -1.0,
        (8, 1) => -0.5,
        (9, 2) => f64::NAN,
        (10, 0) => f64::INFINITY,
        _ => 1500.0 * (cell + 1) as f64,
    })
    .unwrap()
}

#[test]
fn policies_judge_and_report() {
    for (policy, measured, clamped) in [
        (CellPolicy::AnyNegative, 116, 0),
        (CellPolicy::PerChannel, 117, 1),
        (CellPolicy::AllNegative, 117, 0),
    ] {
        let (table, report) = HalfDiffTable::from_merl(&file(), policy).unwrap();
        assert_eq!(report.cells, 120, "{policy:?}");
        assert_eq!(report.measured, measured, "{policy:?}");
        assert_eq!(table.valid_cells(), measured, "{policy:?}");
        assert_eq!(report.all_negative, 1, "{policy:?}");
        assert_eq!(report.partly_negative, 1, "{policy:?}");
        assert_eq!(report.not_finite, 2, "{policy:?}");
        assert_eq!(report.clamped_channels, clamped, "{policy:?}");
        // cell 8 = theta_h 0, theta_d 1, phi_d 2
        let value = table.value([0, 1, 2]).unwrap()[1];
        let expected = match policy {
            CellPolicy::AnyNegative => 3.0 * 1.15, // the neighbour at smaller theta_d, cell 2
            CellPolicy::PerChannel => 0.0,
            CellPolicy::AllNegative => -0.5 * 1.15 / 1500.0,
        };
        assert!(
            (value - expected as f32).abs() < 1e-6,
            "{policy:?}: {value}"
        );
        let all = (0..120).filter_map(|k| table.value([k / 30, k / 6 % 5, k % 6]).ok());
        assert!(all.flatten().all(|v| v.is_finite()), "{policy:?}");
    }
}

#[test]
fn reader_and_file_give_the_same_table() {
    let bytes = file().to_bytes();
    let reader = MerlReader::new(&bytes[..], bytes.len() as u64).unwrap();
    let a = HalfDiffTable::from_merl_reader(&reader, CellPolicy::AnyNegative).unwrap();
    assert_eq!(
        a,
        HalfDiffTable::from_merl(&file(), CellPolicy::AnyNegative).unwrap()
    );
    let cut = MerlReader::new(&bytes[..bytes.len() - 8], bytes.len() as u64).unwrap();
    let error = HalfDiffTable::from_merl_reader(&cut, CellPolicy::AnyNegative).unwrap_err();
    assert!(error.to_string().contains("byte"), "{error}");
}

#[test]
fn a_file_without_any_measurement_is_black() {
    let file = MerlFile::from_fn(DIMS, |_, _| -1.0).unwrap();
    let (table, report) = HalfDiffTable::from_merl(&file, CellPolicy::AnyNegative).unwrap();
    let mut out = [1.0; 3];
    let status = table.eval(
        direction(0.3, 0.0),
        direction(0.4, 1.0),
        Interpolation::Linear,
        &mut out,
    );
    assert_eq!(
        (status, out, report.measured),
        (Status::Filled, [0.0; 3], 0),
        "black"
    );
}

#[test]
fn tables_survive_the_way_through_a_file() {
    let f = |wi: DVec3, wo: DVec3, out: &mut [f64]| {
        out.copy_from_slice(&[wi.z * wo.z, wi.z + 0.3 * wo.z, 2.0 * wo.z]);
        Status::Measured
    };
    let basis = Basis::Rgb(RgbSpace::srgb());
    for (dims, phi) in [
        ([4, 5, 6], PhiDomain::Reciprocal),
        ([4, 5, 20], PhiDomain::Full),
        ([4, 5, 10], PhiDomain::Mirror),
    ] {
        let table = HalfDiffTable::from_fn(dims, phi, basis.clone(), f);
        let (file, loss) = table.to_merl().unwrap();
        assert!(
            !loss.phi_domain && loss.primaries.is_none() && loss.negative_channels == 0,
            "{loss:?}"
        );
        assert!(loss.filled_cells > 0, "cells below the horizon");
        let (back, _) = HalfDiffTable::from_merl(&file, CellPolicy::AnyNegative).unwrap();
        for cell in table.cell_indices() {
            assert_eq!(
                table.is_valid(cell),
                back.is_valid(cell),
                "{phi:?} {cell:?}"
            );
            if table.is_valid(cell) {
                assert_eq!(
                    table.value(cell).unwrap(),
                    back.value(cell).unwrap(),
                    "{phi:?} {cell:?}"
                );
            }
        }
        let mut rng = testkit::Rng::new(1);
        for _ in 0..500 {
            let [a, b] = rng.uniform2();
            let (wi, wo) = (
                direction(0.9 * a, 6.0 * b),
                direction(0.9 * rng.uniform(), 2.0),
            );
            let (mut x, mut y) = ([0.0; 3], [0.0; 3]);
            table.eval(wi, wo, Interpolation::Linear, &mut x);
            back.eval(wi, wo, Interpolation::Linear, &mut y);
            assert!((x[1] - y[1]).abs() < 1e-5, "{phi:?} {wi} {wo}: {x:?} {y:?}");
        }
    }
    let odd = HalfDiffTable::from_fn([4, 5, 7], PhiDomain::Full, basis, f);
    assert!(
        odd.to_merl().unwrap().1.phi_domain,
        "no reader can know this is a full turn"
    );
    let bands = HalfDiffTable::from_fn(
        [2, 2, 2],
        PhiDomain::Full,
        Basis::Bands(vec![500.0]),
        |_, _, _| Status::Measured,
    );
    assert_eq!(
        bands.to_merl().unwrap_err().to_string(),
        "channels: expected R,G,B, found 500nm"
    );
}

/// One material's network [Sztrajman2021]; the layout is described beside the data.
struct Network<'a>(&'a [f64]);

impl Network<'_> {
    fn eval(&self, at: HalfDiff) -> [f64; 3] {
        let (sh, ch) = at.theta_h.sin_cos();
        let (sd, cd) = at.theta_d.sin_cos();
        let (sp, cp) = at.phi_d.sin_cos();
        let relu = |v: f64| v.max(0.0);
        let (a, rest) = dense::<6, 21>([sh, 0.0, ch, sd * cp, sd * sp, cd], self.0);
        let (b, rest) = dense::<21, 21>(a.map(relu), rest);
        let (c, _) = dense::<21, 3>(b.map(relu), rest);
        c.map(|v| relu(v.exp() - 1.0))
    }
}

fn dense<const I: usize, const O: usize>(x: [f64; I], w: &[f64]) -> ([f64; O], &[f64]) {
    let out =
        std::array::from_fn(|o| w[I * O + o] + (0..I).map(|i| x[i] * w[i * O + o]).sum::<f64>());
    (out, &w[I * O + O..])
}

/// The five pairs of directions of the golden values, in the order of their columns.
fn geometries() -> [(&'static str, DVec3, DVec3); 5] {
    let at = |theta: f64, phi: f64| direction(theta.to_radians(), phi.to_radians());
    [
        ("0/0", at(0.0, 0.0), at(0.0, 0.0)),
        ("45/45 specular", at(45.0, 0.0), at(45.0, 180.0)),
        ("30/60 forward", at(30.0, 0.0), at(60.0, 180.0)),
        ("45/30 dphi 90", at(45.0, 0.0), at(30.0, 90.0)),
        ("45/45 retro", at(45.0, 0.0), at(45.0, 0.0)),
    ]
}

#[expect(
    clippy::disallowed_methods,
    reason = "test data from the folder the environment names"
)]
fn read(path: &std::path::Path) -> Vec<u8> {
    std::fs::read(path).unwrap()
}

/// Name, golden values and weights.
type Material = (String, Vec<f64>, Vec<f64>);

/// All materials; `None` without data.
fn networks() -> Option<Vec<Material>> {
    let dir = testkit::data_dir_or_skip()?.join("nbrdf");
    let text = |name| String::from_utf8(read(&dir.join(name))).unwrap();
    let weights: Vec<f64> = read(&dir.join("merl_nbrdf_weights.f32le"))
        .chunks_exact(4)
        .map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap())))
        .collect();
    let names = text("merl_nbrdf_names.txt");
    let golden = text("merl_nbrdf_eval.csv");
    let rows = golden
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect::<Vec<_>>());
    let of = |name: &str| {
        let row = rows.clone().find(|r| r[0] == name).unwrap();
        row[1..].iter().map(|v| v.parse().unwrap()).collect()
    };
    let weights = weights.chunks_exact(675).map(<[f64]>::to_vec);
    let named = names.split_whitespace().zip(weights);
    Some(named.map(|(n, w)| (n.to_owned(), of(n), w)).collect())
}

/// On a pole (theta_h or theta_d = 0) one pair of directions has every phi_d.
fn on_pole(at: HalfDiff) -> bool {
    at.theta_h.min(at.theta_d) < 1e-9
}

/// The network as a reciprocal, isotropic table knows it: phi_d within [0, pi), the mean over phi_d on a pole.
/// Networks depend on phi_d on the poles and on the order of the directions; no MERL file can.
fn physical(net: &Network<'_>, at: HalfDiff) -> [f64; 3] {
    if !on_pole(at) {
        let phi_d = at.phi_d.rem_euclid(PI);
        let folded = net.eval(HalfDiff { phi_d, ..at });
        if phi_d.min(PI - phi_d) > 1e-9 {
            return folded;
        }
        // in the plane of incidence: on the wrap, half way between both orders
        let other = net.eval(HalfDiff {
            phi_d: PI - phi_d,
            ..at
        });
        return std::array::from_fn(|c| 0.5 * (folded[c] + other[c]));
    }
    let mut mean = [0.0; 3];
    for k in 0..180 {
        let phi_d = (f64::from(k) + 0.5) * PI / 180.0;
        let v = net.eval(HalfDiff { phi_d, ..at });
        (0..3).for_each(|c| mean[c] += v[c] / 180.0);
    }
    mean
}

/// How much the network varies over the cells around `at`: what a grid of one degree can't resolve.
fn variation(net: &Network<'_>, at: HalfDiff, channel: usize) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    let u = (at.theta_h / (PI / 2.0)).sqrt();
    let azimuths = if on_pole(at) { 0..=180 } else { -1..=1 };
    for h in -1..=1 {
        for d in -1..=1 {
            for p in azimuths.clone() {
                let u = (u + f64::from(h) / 90.0).max(0.0);
                let v = net.eval(HalfDiff {
                    theta_h: u * u * PI / 2.0,
                    theta_d: (at.theta_d + f64::from(d) * PI / 180.0).clamp(0.0, PI / 2.0),
                    phi_d: at.phi_d + f64::from(p) * PI / 180.0,
                })[channel];
                (low, high) = (low.min(v), high.max(v));
            }
        }
    }
    high - low
}

/// Largest relative interpolation error at the five geometries, over all materials.
const GRID_ERROR: f64 = 0.03;

/// Golden values carry five digits.
const DIGITS: f64 = 1e-4;
/// They were made in single precision, and exp(x) - 1 cancels where they are small.
const ROUNDING: f64 = 3e-6;

/// Checks a table at the five geometries. Returns the largest relative difference from the network away from
/// the poles and on them, and by how much the network departs from its own reciprocal, isotropic part.
fn compare(table: &HalfDiffTable, net: &Network<'_>, name: &str, golden: &[f64]) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for (g, (geometry, wi, wo)) in geometries().into_iter().enumerate() {
        let at = HalfDiff::new(wi, wo);
        let (exact, physical) = (net.eval(at), physical(net, at));
        let mut out = [0.0; 3];
        table.eval(wi, wo, Interpolation::Linear, &mut out);
        for c in 0..3 {
            let reference = golden[3 * g + c];
            assert!(
                (exact[c] - reference).abs() <= DIGITS * reference + ROUNDING,
                "{name} {geometry}: the network gives {} for {reference}",
                exact[c]
            );
            let own = (physical[c] - reference).abs();
            let bound = variation(net, at, c) + own + DIGITS * reference;
            assert!(
                (out[c] - reference).abs() <= bound,
                "{name} {geometry} {c}: {} for {reference}, bound {bound}",
                out[c]
            );
            let kind = usize::from(on_pole(at));
            worst[kind] = worst[kind].max((out[c] / physical[c] - 1.0).abs());
            worst[2] = worst[2].max(own / reference);
        }
    }
    worst
}

#[test]
fn tables_of_the_networks_agree_within_the_grid() {
    let Some(all) = networks() else { return };
    // every twelfth material; the slow test takes them all
    check(all.into_iter().step_by(12));
}

#[test]
fn slow_tables_of_all_networks_agree_within_the_grid() {
    let Some(all) = networks() else { return };
    check(all.into_iter());
}

#[expect(clippy::print_stdout, reason = "the measured errors are the point")]
fn check(materials: impl Iterator<Item = Material>) {
    let basis = Basis::Rgb(RgbSpace::srgb());
    for (name, golden, weights) in materials {
        let net = Network(&weights);
        let table = HalfDiffTable::from_fn(
            [90, 90, 180],
            PhiDomain::Reciprocal,
            basis.clone(),
            |wi, wo, out| {
                out.copy_from_slice(&net.eval(HalfDiff::new(wi, wo)));
                Status::Measured
            },
        );
        let worst = compare(&table, &net, &name, &golden);
        println!("{name}: off by {worst:.4?} (away from the poles, on them, the network itself)");
        assert!(worst[0] < GRID_ERROR, "{name}: {worst:?}");
    }
}

#[test]
fn slow_stand_in_files_agree_within_the_grid() {
    let Some(dir) = std::env::var_os("GONIO_STANDINS") else {
        println!("skipped: GONIO_STANDINS is not set");
        return;
    };
    let Some(all) = networks() else { return };
    for (name, golden, weights) in all {
        let path = std::path::Path::new(&dir).join(format!("{name}.binary"));
        if !path.exists() {
            println!("skipped: no stand-in of {name}");
            continue;
        }
        let bytes = read(&path);
        let start = std::time::Instant::now();
        let file = MerlFile::from_bytes(bytes).unwrap();
        let (table, report) = HalfDiffTable::from_merl(&file, CellPolicy::AnyNegative).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        assert_eq!(report.measured, 1_152_174, "{name}: the published mask");
        let worst = compare(&table, &Network(&weights), &name, &golden);
        println!(
            "{name}: table in {seconds:.3} s, {} bytes, off by {worst:.4?}",
            table.bytes()
        );
        assert!(worst[0] < GRID_ERROR, "{name}: {worst:?}");
        assert_stencils_are_valid(&table);
    }
}

/// No look-up above the horizon touches a cell outside MERL's mask.
fn assert_stencils_are_valid(table: &HalfDiffTable) {
    let mut rng = testkit::Rng::new(9);
    let mut out = [0.0; 3];
    for k in 0..200_000 {
        let [a, b] = rng.uniform2();
        // half of the pairs within 5 degrees of grazing
        let cos = if k % 2 == 0 { a } else { a * 0.087 };
        let wi = direction(cos.acos(), 6.3 * b);
        let [a, b] = rng.uniform2();
        let cos = if k % 2 == 0 { a } else { a * 0.087 };
        let wo = direction(cos.acos(), 6.3 * b);
        let status = table.eval(wi, wo, Interpolation::Linear, &mut out);
        assert!(
            status != Status::Filled || wi.z <= 0.0 || wo.z <= 0.0,
            "{wi} {wo}"
        );
    }
}
