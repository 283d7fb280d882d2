//! Half-difference tables: symmetries, continuity, hard cases, and the fast path against the reference.

use brdf::{Brdf, HalfDiff, LANES, Lanes3, Measured, Status, direction};
use brdf_table::{
    Gridded, GriddedN, HalfDiffTable, Interpolation, PhiDomain, directional_albedo, mix,
};
use glam::DVec3;
use spectrum::{Basis, RgbSpace};
use std::f64::consts::{FRAC_1_PI, PI, TAU};
use std::sync::Arc;
use testkit::Rng;

const SIZE: [usize; 3] = [30, 30, 60];

fn rgb() -> Basis {
    Basis::Rgb(RgbSpace::srgb())
}

/// White noise in [0, 1): the steepest content a table can have.
fn noise(wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
    for (c, o) in out.iter_mut().enumerate() {
        let seed = wi.x.to_bits() ^ wo.y.to_bits().rotate_left(17) ^ wi.z.to_bits().rotate_left(31);
        *o = Rng::new(seed.wrapping_add(c as u64)).uniform();
    }
    Status::Measured
}

/// A lobe over a floor; smooth.
fn lobe(wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
    let h = (wi + wo).normalize();
    let gloss = (-(h.x * h.x + h.y * h.y) / (0.05 * h.z * h.z)).exp();
    for (c, o) in out.iter_mut().enumerate() {
        *o = 0.1 * (c + 1) as f64 + gloss * (1.0 + wi.dot(h));
    }
    Status::Measured
}

/// Uniform over the hemisphere.
fn above(rng: &mut Rng) -> DVec3 {
    let [a, b] = rng.uniform2();
    direction((1.0 - a).acos(), TAU * b)
}

fn turned(v: DVec3, angle: f64) -> DVec3 {
    let (s, c) = angle.sin_cos();
    DVec3::new(c * v.x - s * v.y, s * v.x + c * v.y, v.z)
}

fn eval(table: &HalfDiffTable, wi: DVec3, wo: DVec3) -> [f64; 3] {
    let mut out = [0.0; 3];
    table.eval(wi, wo, Interpolation::Linear, &mut out);
    out
}

fn is_black(values: [f64; 3]) -> bool {
    values.iter().all(|v| v.abs() <= 0.0)
}

fn eval_at(table: &HalfDiffTable, theta_h: f64, theta_d: f64, phi_d: f64) -> f64 {
    let angles = HalfDiff {
        theta_h,
        theta_d,
        phi_d,
    };
    let mut out = [0.0; 3];
    table.eval_angles(angles, Interpolation::Linear, &mut out);
    out[0]
}

const DOMAINS: [PhiDomain; 3] = [PhiDomain::Reciprocal, PhiDomain::Mirror, PhiDomain::Full];

#[test]
fn cell_centres_return_their_cells() {
    for phi in DOMAINS {
        let table = HalfDiffTable::from_fn(SIZE, phi, rgb(), noise);
        for how in [Interpolation::Nearest, Interpolation::Linear] {
            for cell in table.cell_indices().filter(|&c| table.is_valid(c)) {
                let mut out = [0.0; 3];
                let status = table.eval_angles(table.centre(cell), how, &mut out);
                assert_eq!(status, Status::Measured, "{phi:?} {how:?} {cell:?}");
                for (o, v) in out.iter().zip(table.value(cell).unwrap()) {
                    // 1e-12: position of the centre in f64, times a step of at most 1
                    assert!(
                        (o - f64::from(*v)).abs() < 1e-12,
                        "{phi:?} {how:?} {cell:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn values_sit_at_centres_not_edges() {
    // f = theta_d: trilinear returns it exactly between centres; edge placement would be off by half a cell
    let table = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), |wi, wo, out| {
        out.fill(HalfDiff::new(wi, wo).theta_d);
        Status::Measured
    });
    for k in 0..100 {
        let theta_d = 0.03 + 0.01 * f64::from(k);
        let value = eval_at(&table, 0.2, theta_d, 1.5);
        assert!((value - theta_d).abs() < 1e-6, "{theta_d}: {value}"); // f32 storage
    }
}

#[test]
fn reciprocal_tables_are_reciprocal_to_the_bit() {
    let table = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), noise);
    let mut rng = Rng::new(1);
    for _ in 0..100_000 {
        let (wi, wo) = (above(&mut rng), above(&mut rng));
        let bits = |a, b| eval(&table, a, b).map(f64::to_bits);
        assert_eq!(bits(wi, wo), bits(wo, wi), "{wi} {wo}");
    }
    assert!(table.symmetry().reciprocal, "it says so");
}

#[test]
fn other_domains_tell_the_order_of_directions_apart() {
    let f = |wi: DVec3, wo: DVec3, out: &mut [f64]| {
        out.fill(1.0 + wi.z - 0.5 * wo.z);
        Status::Measured
    };
    let mut rng = Rng::new(2);
    for phi in [PhiDomain::Mirror, PhiDomain::Full] {
        let table = HalfDiffTable::from_fn([60, 60, 120], phi, rgb(), f);
        assert!(!table.symmetry().reciprocal, "{phi:?}");
        for _ in 0..5000 {
            let (wi, wo) = (above(&mut rng), above(&mut rng));
            if wi.z.min(wo.z) > 0.1 {
                // 2e-3: a cell is 1.5 degrees, curvature of the cosine 1/8 of its square, three axes
                let error = eval(&table, wi, wo)[0] - (1.0 + wi.z - 0.5 * wo.z);
                assert!(error.abs() < 2e-3, "{phi:?} {wi} {wo}: {error}");
            }
        }
    }
}

#[test]
fn turning_the_pair_about_the_normal_changes_nothing() {
    let mut rng = Rng::new(3);
    for phi in DOMAINS {
        let table = HalfDiffTable::from_fn(SIZE, phi, rgb(), lobe);
        for _ in 0..20_000 {
            let (wi, wo, angle) = (above(&mut rng), above(&mut rng), TAU * rng.uniform());
            let (a, b) = (
                eval(&table, wi, wo),
                eval(&table, turned(wi, angle), turned(wo, angle)),
            );
            for c in 0..3 {
                assert!(
                    (a[c] - b[c]).abs() < 1e-12,
                    "{phi:?} {wi} {wo} by {angle}: {a:?} {b:?}"
                );
            }
        }
    }
}

#[test]
fn interpolation_is_continuous_at_the_wrap_and_at_the_poles() {
    const STEP: f64 = 1e-9;
    // values within [0, 1], so a displacement of STEP changes them by at most STEP x cells per radian
    let mut rng = Rng::new(4);
    for phi in DOMAINS {
        let table = HalfDiffTable::from_fn(SIZE, phi, rgb(), noise);
        for _ in 0..2000 {
            let (h, d, p) = (
                rng.uniform() * 1.5,
                rng.uniform() * 1.5,
                rng.uniform() * TAU,
            );
            let wrap = eval_at(&table, h, d, STEP) - eval_at(&table, h, d, -STEP);
            assert!(wrap.abs() < 2.0 * STEP * 60.0 / PI, "wrap: {wrap}");
            let half = eval_at(&table, h, d, PI + STEP) - eval_at(&table, h, d, PI - STEP);
            assert!(half.abs() < 2.0 * STEP * 60.0 / PI, "half turn: {half}");
            let pole_h = eval_at(&table, STEP, d, p) - eval_at(&table, 0.0, d, 0.0);
            // 4 n^2 (2/pi) cells per radian of theta_h below the first centre
            assert!(pole_h.abs() < STEP * 4.0 * 900.0, "theta_h pole: {pole_h}");
            let pole_d = eval_at(&table, h, STEP, p) - eval_at(&table, h, 0.0, 0.0);
            assert!(pole_d.abs() < STEP * 2.0 * 30.0, "theta_d pole: {pole_d}");
        }
    }
}

#[test]
fn poles_hold_the_mean_over_phi_d() {
    let table = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), noise);
    let mean = |h, d| {
        let row = (0..SIZE[2]).map(|p| f64::from(table.value([h, d, p]).unwrap()[0]));
        row.sum::<f64>() / SIZE[2] as f64
    };
    let theta_d = table.centre([0, 7, 0]).theta_d;
    assert!(
        (eval_at(&table, 0.0, theta_d, 1.0) - mean(0, 7)).abs() < 1e-6,
        "theta_h = 0"
    );
    let theta_h = table.centre([9, 0, 0]).theta_h;
    assert!(
        (eval_at(&table, theta_h, 0.0, 1.0) - mean(9, 0)).abs() < 1e-6,
        "theta_d = 0"
    );
}

/// Rounding to single precision displaces wi + wo by this much; the angles by that over its length, over 2.
const DISPLACED: f64 = 4e-7;

/// The range of the reference over the displacements that rounding to single precision may cause.
fn envelope(table: &HalfDiffTable, wi: DVec3, wo: DVec3) -> (f64, f64) {
    let at = HalfDiff::new(wi, wo);
    let step = DISPLACED / at.theta_d.cos();
    let turn = step / at.theta_h.sin().min(at.theta_d.sin()).max(1e-12);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for h in [-step, 0.0, step] {
        for d in [-DISPLACED, 0.0, DISPLACED] {
            for p in [-turn, -0.5 * turn, 0.0, 0.5 * turn, turn] {
                let v = eval_at(table, at.theta_h + h, at.theta_d + d, at.phi_d + p);
                (low, high) = (low.min(v), high.max(v));
            }
        }
    }
    (low, high)
}

#[test]
fn lanes_agree_with_the_reference_up_to_rounding_of_the_angles() {
    let mut rng = Rng::new(5);
    for phi in DOMAINS {
        for (name, f) in [
            ("noise", noise as fn(DVec3, DVec3, &mut [f64]) -> Status),
            ("lobe", lobe),
        ] {
            let table = Arc::new(HalfDiffTable::from_fn([90, 90, 60], phi, rgb(), f));
            let fast = GriddedN::<3>::new(Arc::clone(&table), Interpolation::Linear).unwrap();
            let (mut worst, mut plain) = (0.0_f64, 0.0_f64);
            for packet in 0..1500 {
                let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
                for k in 0..LANES {
                    let o = above(&mut rng);
                    // every third packet near the mirror direction, where theta_h is small
                    let mirror = DVec3::new(-o.x, -o.y, o.z) + 0.01 * above(&mut rng);
                    let i = if packet % 3 == 0 {
                        mirror.normalize()
                    } else {
                        above(&mut rng)
                    };
                    wi.set(k, i.as_vec3());
                    wo.set(k, o.as_vec3());
                }
                let lanes = fast.eval_lanes(&wi, &wo);
                for k in 0..LANES {
                    let (i, o) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                    let (low, high) = envelope(&table, i, o);
                    let got = f64::from(lanes[0][k]);
                    let outside = (low - got).max(got - high).max(0.0);
                    worst = worst.max(outside / high);
                    plain = plain.max((got / fast.eval(i, o)[0] - 1.0).abs());
                }
            }
            println!(
                "{phi:?} {name}: outside the envelope {worst:.1e}, plain relative difference {plain:.1e}"
            );
            assert!(
                worst < 1e-5,
                "{phi:?} {name}: {worst:e} outside the envelope"
            );
            assert!(name == "noise" || plain < 3e-4, "{phi:?} {name}: {plain:e}");
        }
    }
}

#[test]
fn nearest_lanes_agree_except_within_rounding_of_a_boundary() {
    let mut rng = Rng::new(6);
    let table = Arc::new(HalfDiffTable::from_fn(
        SIZE,
        PhiDomain::Reciprocal,
        rgb(),
        noise,
    ));
    let fast = GriddedN::<3>::new(table, Interpolation::Nearest).unwrap();
    let mut differ = 0;
    for _ in 0..2000 {
        let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
        for k in 0..LANES {
            wi.set(k, above(&mut rng).as_vec3());
            wo.set(k, above(&mut rng).as_vec3());
        }
        let lanes = fast.eval_lanes(&wi, &wo);
        for k in 0..LANES {
            let reference = fast.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
            differ += u32::from((reference[1] - f64::from(lanes[1][k])).abs() > 1e-6);
        }
    }
    // 32 000 pairs; a pair is within 4e-7 rad of one of some 60 x 3 boundaries with probability below 1e-3
    assert!(differ < 32, "{differ} of 32000");
}

#[test]
fn lanes_survive_anything() {
    let table = Arc::new(HalfDiffTable::from_fn(
        [3, 2, 1],
        PhiDomain::Full,
        rgb(),
        lobe,
    ));
    let odd = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        1e-7,
        1e-30,
        f32::MIN_POSITIVE,
        1e30,
        f32::INFINITY,
        f32::NAN,
    ];
    for how in [Interpolation::Nearest, Interpolation::Linear] {
        let fast = GriddedN::<3>::new(Arc::clone(&table), how).unwrap();
        for (a, x) in odd.iter().enumerate() {
            for (b, y) in odd.iter().enumerate() {
                let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
                for k in 0..LANES {
                    wi.set(k, glam::Vec3::new(*x, *y, odd[k % odd.len()]));
                    wo.set(
                        k,
                        glam::Vec3::new(*y, odd[(k + a) % odd.len()], odd[(k * b) % odd.len()]),
                    );
                }
                fast.eval_lanes(&wi, &wo);
                for k in 0..LANES {
                    fast.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                }
            }
        }
    }
}

#[test]
fn special_pairs_are_finite_and_below_the_horizon_is_black() {
    let table = Arc::new(HalfDiffTable::from_fn(
        SIZE,
        PhiDomain::Reciprocal,
        rgb(),
        lobe,
    ));
    let grid = Gridded {
        table,
        interpolation: Interpolation::Linear,
    };
    let mut out = [1.0; 3];
    for theta in [0.0, 1e-9, 0.3, 1.2, PI / 2.0 - 1e-7] {
        let w = direction(theta, 0.4);
        for other in [
            w,
            DVec3::new(-w.x, -w.y, w.z),
            direction(PI / 2.0 - 1e-7, 3.0),
            DVec3::Z,
        ] {
            assert!(
                grid.eval_native(w, other, &mut out) >= Status::Interpolated,
                "{theta}"
            );
            assert!(
                out.iter().all(|v| v.is_finite() && *v > 0.0),
                "{w} {other}: {out:?}"
            );
        }
        assert_eq!(
            grid.eval_native(w, -w, &mut out),
            Status::Filled,
            "wi = -wo"
        );
        assert!(is_black(out), "wi = -wo: {out:?}");
    }
}

#[test]
fn a_single_spike_stays_within_its_neighbours() {
    let spike = [5, 6, 7];
    let probe = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), |_, _, _| {
        Status::Measured
    });
    let (si, so) = probe.centre(spike).directions();
    let table = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), |wi, wo, out| {
        out.fill(if (wi - si).length() + (wo - so).length() < 1e-9 {
            1e6
        } else {
            0.0
        });
        Status::Measured
    });
    assert!(
        (eval(&table, si, so)[0] - 1e6).abs() < 1e-3,
        "the spike itself"
    );
    let mut rng = Rng::new(7);
    for _ in 0..20_000 {
        let (wi, wo) = (above(&mut rng), above(&mut rng));
        let at = HalfDiff::new(wi, wo);
        let far = (at.theta_d - probe.centre(spike).theta_d).abs() > PI / 60.0 + 1e-9;
        let value = eval(&table, wi, wo)[0];
        assert!(
            (0.0..=1e6).contains(&value) && !(far && value > 0.0),
            "{at:?}: {value}"
        );
    }
    assert!(is_black(eval(&probe, si, so)), "an all-zero table is zero");
}

#[test]
fn filled_cells_keep_their_value_and_say_so() {
    // measured in part of the range only; NaN counts as no value
    let table = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), |wi, wo, out| {
        let theta_d = HalfDiff::new(wi, wo).theta_d;
        out.fill(if theta_d > 1.0 { f64::NAN } else { theta_d });
        if theta_d > 0.8 {
            Status::Filled
        } else {
            Status::Measured
        }
    });
    let status = |theta_d| {
        let mut out = [0.0; 3];
        let angles = HalfDiff {
            theta_h: 0.1,
            theta_d,
            phi_d: 1.4,
        };
        (
            table.eval_angles(angles, Interpolation::Linear, &mut out),
            out[0],
        )
    };
    assert_eq!(status(0.5).0, Status::Interpolated, "inside");
    assert_eq!(status(0.9).0, Status::Filled, "filled by its maker");
    assert!(
        (status(0.9).1 - 0.9).abs() < 1e-6,
        "and its value kept: {:?}",
        status(0.9)
    );
    assert_eq!(status(1.3).0, Status::Filled, "padded");
    assert!(
        (status(1.3).1 - 1.0).abs() < 0.06,
        "with the last value: {:?}",
        status(1.3)
    );
}

#[test]
fn mixing_is_linear_and_intersects_the_masks() {
    let half = |low: bool| {
        move |wi: DVec3, wo: DVec3, out: &mut [f64]| {
            noise(wi, wo, out);
            let first = HalfDiff::new(wi, wo).theta_d < 0.5;
            if first == low {
                Status::Filled
            } else {
                Status::Measured
            }
        }
    };
    let all = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), lobe);
    let high = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), half(true));
    let low = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), half(false));
    let mixed = mix(&[(&all, 0.25), (&high, 2.0)]).unwrap();
    for cell in all.cell_indices() {
        assert_eq!(
            mixed.is_valid(cell),
            all.is_valid(cell) && high.is_valid(cell),
            "{cell:?}"
        );
    }
    let mut rng = Rng::new(8);
    for _ in 0..5000 {
        let (wi, wo) = (above(&mut rng), above(&mut rng));
        let at = HalfDiff::new(wi, wo);
        if at.theta_d > 0.6 && at.theta_h > 0.01 {
            let expected = 0.25 * eval(&all, wi, wo)[2] + 2.0 * eval(&high, wi, wo)[2];
            // f32 rounding of the mixed cells
            assert!((eval(&mixed, wi, wo)[2] - expected).abs() < 1e-6, "{at:?}");
        }
    }
    assert_eq!(
        mix(&[(&high, 1.0), (&low, 1.0)]).unwrap().valid_cells(),
        0,
        "disjoint masks"
    );
}

#[test]
fn mixing_refuses_what_does_not_fit() {
    let table = |dims, phi, basis| HalfDiffTable::from_fn(dims, phi, basis, lobe);
    let a = table([3, 4, 5], PhiDomain::Reciprocal, rgb());
    let b = table([3, 4, 6], PhiDomain::Reciprocal, rgb());
    let c = table([3, 4, 5], PhiDomain::Reciprocal, Basis::Xyz);
    let message = |parts: &[(&HalfDiffTable, f64)]| mix(parts).unwrap_err().to_string();
    assert_eq!(message(&[]), "no table given");
    assert_eq!(
        message(&[(&a, 1.0), (&a, f64::NAN)]),
        "weight 1 is not finite"
    );
    assert_eq!(
        message(&[(&a, 1.0), (&b, 1.0)]),
        "table 1: grid 3 x 4 x 6 (Reciprocal) differs from 3 x 4 x 5 (Reciprocal) of table 0; resample it first"
    );
    assert_eq!(
        message(&[(&a, 1.0), (&c, 1.0)]),
        "table 1: its channels mean something else than those of table 0; map them first"
    );
    let resampled = b.resample(a.dims(), a.phi_domain(), Interpolation::Linear);
    assert!(
        mix(&[(&a, 1.0), (&resampled, 1.0)]).is_ok(),
        "resampled explicitly"
    );
}

#[test]
fn channels_are_mapped_cell_by_cell() {
    let table = HalfDiffTable::from_fn(SIZE, PhiDomain::Mirror, rgb(), noise);
    let matrix = [vec![1.0, 0.5], vec![0.0, 2.0], vec![-1.0, 0.25]];
    let mapped = table
        .map_channels(&matrix, Basis::Bands(vec![450.0, 650.0]))
        .unwrap();
    for cell in table.cell_indices() {
        let (old, new) = (table.value(cell).unwrap(), mapped.value(cell).unwrap());
        for j in 0..2 {
            let expected: f32 = (0..3).map(|c| old[c] * matrix[c][j] as f32).sum();
            assert!((new[j] - expected).abs() < 1e-6, "{cell:?}");
        }
        assert_eq!(table.is_valid(cell), mapped.is_valid(cell), "{cell:?}");
    }
    assert!(
        table.map_channels(&matrix[..2], Basis::Xyz).is_err(),
        "one row a channel"
    );
    assert!(
        GriddedN::<3>::new(Arc::new(mapped), Interpolation::Linear).is_err(),
        "2 channels are not 3"
    );
}

#[test]
fn furnace_and_albedo() {
    let white = HalfDiffTable::from_fn(SIZE, PhiDomain::Reciprocal, rgb(), |_, _, out| {
        out.fill(FRAC_1_PI);
        Status::Measured
    });
    let white = Gridded {
        table: Arc::new(white),
        interpolation: Interpolation::Linear,
    };
    let mut worst = 0.0_f64;
    for degrees in [0.0_f64, 30.0, 60.0, 80.0, 87.0] {
        for albedo in directional_albedo(&white, degrees.to_radians(), 180) {
            worst = worst.max((albedo - 1.0).abs());
        }
    }
    println!("white table: albedo off by at most {worst:.1e}");
    assert!(worst < 1e-3, "{worst}"); // midpoint error of 180 x 720
}
