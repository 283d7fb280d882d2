//! Scattered rows with a known truth, and the genuine Cornell files where they are at hand.

#![expect(clippy::unwrap_used, reason = "helpers of tests fail loudly")]

use brdf::{Measured, Status};
use brdf_formats::{AstmFile, PbrtTextFile};
use brdf_table::scattered::validation::{Scheme, leave_one_ring_out};
use brdf_table::scattered::{Domain, Geometry, non_reciprocity};
use brdf_table::{
    BeyondPolicy, CloudError, DeadRows, GapPolicy, KdNearest, LayerMode, LayeredTable,
    NegativePolicy, Policies, SampleCloud, ThinPlate, resample,
};
use proptest::prelude::*;
use spectrum::{Basis, RgbSpace};
use std::f64::consts::PI;

/// Lambert and an isotropic Ward-like lobe that whitens the colour; 1/sr.
fn truth(g: Geometry) -> [f64; 3] {
    let h = g.half_diff();
    let (alpha, diffuse) = (0.2_f64, [0.3, 0.1, 0.05]);
    let lobe = (-(h.theta_h.tan() / alpha).powi(2)).exp() / (4.0 * PI * alpha * alpha);
    let lobe = 0.3 * lobe / (g.theta_i.cos() * g.theta_o.cos()).sqrt();
    diffuse.map(|d| d / PI + lobe)
}

/// The directions of Cornell's gonioreflectometer: Shirley-Chiu rings, a hole around the light.
fn cornell_grid() -> Vec<[f64; 4]> {
    let mut angles = Vec::new();
    for i in 1..=8 {
        let theta_i = f64::from(i) * 10_f64.to_radians();
        for k in 0..10 {
            let theta_o = 2.0 * (f64::from(k) / 10.0 / 2_f64.sqrt()).asin();
            for j in 0..=4 * k {
                let phi = f64::from(j) * 45_f64.to_radians() / f64::from(k.max(1));
                let g = Geometry {
                    theta_i,
                    theta_o,
                    phi,
                };
                if 2.0 * g.half_diff().theta_d > 17_f64.to_radians() {
                    angles.push([theta_i, 0.0, theta_o, -phi]);
                }
            }
        }
    }
    angles
}

fn geometry(a: &[f64; 4]) -> Geometry {
    Geometry {
        theta_i: a[0],
        theta_o: a[2],
        phi: -a[3],
    }
}

fn synthetic() -> SampleCloud {
    let angles = cornell_grid();
    let values: Vec<f64> = angles.iter().flat_map(|a| truth(geometry(a))).collect();
    SampleCloud::new(Basis::Rgb(RgbSpace::srgb()), &angles, &values).unwrap()
}

fn at(theta_i: f64, theta_o: f64, phi: f64) -> Geometry {
    let [theta_i, theta_o, phi] = [theta_i, theta_o, phi].map(f64::to_radians);
    Geometry {
        theta_i,
        theta_o,
        phi,
    }
}

fn eval(m: &dyn Measured, g: Geometry) -> (Vec<f64>, Status) {
    let (wi, wo) = g.directions();
    let mut out = vec![0.0; m.basis().len()];
    let status = m.eval_native(wi, wo, &mut out);
    (out, status)
}

fn assert_rows_returned(m: &dyn Measured, cloud: &SampleCloud, what: &str) {
    for (row, &g) in cloud.geometry().iter().enumerate() {
        let (have, status) = eval(m, g);
        let want = cloud.values(row);
        let size = want.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
        assert_eq!(status, Status::Measured, "{what}, row {row}");
        for (h, w) in have.iter().zip(want) {
            // the project's own demand: 1e-6 of the row's magnitude
            assert!(
                (h - w).abs() <= 1e-6 * size,
                "{what}, row {row}: {h} for {w}"
            );
        }
    }
}

#[test]
fn every_scheme_returns_its_rows() {
    let cloud = synthetic();
    for mode in [
        LayerMode::Nearest,
        LayerMode::Linear,
        LayerMode::SquaredLambda,
        LayerMode::LogLinear,
    ] {
        assert_rows_returned(
            &LayeredTable::new(&cloud, mode),
            &cloud,
            &format!("{mode:?}"),
        );
    }
    assert_rows_returned(&KdNearest::new(&cloud).unwrap(), &cloud, "k-d tree");
    assert_rows_returned(&ThinPlate::new(&cloud).unwrap(), &cloud, "thin plate");
}

#[test]
fn the_surface_passes_through_its_rows() {
    // beside a row the surface itself answers: it must not jump from the row's value
    let cloud = synthetic();
    let plate = ThinPlate::new(&cloud).unwrap();
    for (row, &g) in cloud.geometry().iter().enumerate().step_by(7) {
        let beside = Geometry {
            theta_i: g.theta_i - 4e-6,
            ..g
        };
        let (have, status) = eval(&plate, beside);
        assert_ne!(status, Status::Measured, "row {row}");
        for (h, w) in have.iter().zip(cloud.values(row)) {
            // the lobe's steepest relative slope is below 30 per radian: 4e-6 * 30
            assert!(
                (h - w).abs() <= 1.2e-4 * w.abs(),
                "row {row}: {h} beside {w}"
            );
        }
    }
}

#[test]
fn the_thin_plate_finds_the_truth_between_rows_and_the_thesis_does_not() {
    let cloud = synthetic();
    let plate = ThinPlate::new(&cloud).unwrap();
    let thesis = LayeredTable::new(&cloud, LayerMode::SquaredLambda);
    let rms = |m: &dyn Measured| {
        let mut sum = 0.0;
        for k in 0..40 {
            // near the mirror direction, between the rings
            let theta = 24.0 + 1.2 * f64::from(k);
            let g = at(theta, theta + 2.0, 178.0);
            let (have, status) = eval(m, g);
            assert_eq!(status, Status::Interpolated, "{g:?}");
            sum += (have[1] / truth(g)[1]).ln().powi(2);
        }
        (sum / 40.0_f64).sqrt()
    };
    // 0.05 is what the project asks of the near-specular region
    assert!(rms(&plate) < 0.05, "thin plate: {}", rms(&plate));
    assert!(rms(&thesis) > 2.0 * rms(&plate), "thesis: {}", rms(&thesis));
}

#[test]
fn squared_lambda_weighs_the_upper_entry_by_the_square() {
    // one incidence, two rings: at a quarter of the way the thesis' rule gives 1/16
    let angles = [[0.5, 0.0, 0.3, 0.0], [0.5, 0.0, 0.7, 0.0]];
    let cloud = SampleCloud::new(Basis::Xyz, &angles, &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]).unwrap();
    let g = Geometry {
        theta_i: 0.5,
        theta_o: 0.4,
        phi: 0.0,
    };
    for (mode, want) in [
        (LayerMode::SquaredLambda, 1.0 + 1.0 / 16.0),
        (LayerMode::Linear, 1.25),
        (LayerMode::LogLinear, 2_f64.powf(0.25)),
        (LayerMode::Nearest, 1.0),
    ] {
        let table = LayeredTable::new(&cloud, mode);
        let (have, status) = eval(&table, g);
        // the rounding of a few operations; the floor under the log changes it by 1e-6
        assert!(
            (have[1] - want).abs() < 2e-6,
            "{mode:?}: {} for {want}",
            have[1]
        );
        assert_eq!(status, Status::Interpolated, "{mode:?}");
        let (_, status) = eval(&table, Geometry { theta_i: 0.6, ..g });
        assert_eq!(status, Status::Filled, "{mode:?} beyond the only incidence");
    }
}

#[test]
fn unmeasured_regions_are_filled_and_say_so() {
    let cloud = synthetic();
    let plate = ThinPlate::new(&cloud).unwrap();
    let policies = Policies {
        beyond: BeyondPolicy::Nearest,
        gap: GapPolicy::Nearest,
        ..Policies::default()
    };
    let nearest = ThinPlate::with_policies(&cloud, policies).unwrap();
    let hole = at(40.0, 42.0, 1.0);
    for g in [
        hole,
        at(3.0, 30.0, 90.0),
        at(85.0, 40.0, 170.0),
        at(60.0, 86.0, 20.0),
        at(88.0, 89.0, 0.5),
    ] {
        for m in [&plate, &nearest] {
            let (values, status) = eval(m, g);
            assert_eq!(status, Status::Filled, "{g:?}");
            assert!(
                values.iter().all(|v| v.is_finite() && *v > 0.0),
                "{g:?}: {values:?}"
            );
        }
    }
    let ratio = eval(&plate, hole).0[0] / truth(hole)[0];
    // no data within 17 degrees, where the truth is nearly flat
    assert!((ratio - 1.0).abs() < 0.05, "retro hole: {ratio}");
    assert!(plate.report().albedo_beyond <= 1.0, "{:?}", plate.report());
}

#[test]
fn the_continuation_beyond_the_edge_neither_jumps_nor_falls() {
    let cloud = synthetic();
    let plate = ThinPlate::new(&cloud).unwrap();
    let edge = Domain::new(&cloud).theta_o[1].to_degrees();
    for phi in [30.0, 90.0, 150.0, 180.0] {
        let (inside, outside) = (at(70.0, edge - 1e-4, phi), at(70.0, edge + 1e-4, phi));
        let (a, b) = (eval(&plate, inside).0[1], eval(&plate, outside).0[1]);
        // 2e-4 degrees apart, relative slope below 30 per radian
        assert!((a / b - 1.0).abs() < 1.1e-4, "phi {phi}: {a} | {b}");
    }
    let mirror = (82..90).map(|t| eval(&plate, at(f64::from(t), f64::from(t), 180.0)).0[1]);
    let mirror: Vec<f64> = mirror.collect();
    assert!(mirror.windows(2).all(|w| w[1] >= w[0]), "{mirror:?}");
}

/// Largest ratio of luminances, floored at a thousandth of the rows' mean, between neighbours 0.1 degree apart
/// on random lines over all of the hemisphere's pairs, and on lines beside the edge.
fn steepest(m: &dyn Measured, cloud: &SampleCloud) -> (f64, Geometry) {
    let weights = m.basis().luminance_weights();
    let rows = cloud.len();
    let floor = 1e-3 * (0..rows).map(|r| cloud.luminance(r).abs()).sum::<f64>() / rows as f64;
    let size = |g: Geometry| {
        let f = eval(m, g).0;
        f.iter()
            .zip(&weights)
            .map(|(f, w)| f * w)
            .sum::<f64>()
            .max(0.0)
            + floor
    };
    let mut rng = sampling::Rng::new(0x5ca7);
    let mut worst = (1.0, at(0.0, 0.0, 0.0));
    for line in 0..240 {
        let mut point = [60.0, 60.0, 0.0].map(|least| least + (89.0 - least) * rng.uniform());
        point[2] = 180.0 * rng.uniform();
        let mut along = [rng.normal(), rng.normal(), rng.normal()];
        if line % 3 > 0 {
            // beside the last rows of one of the two directions
            point[line % 3 - 1] = 80.0 + 0.5 * (rng.uniform() - 0.5);
            along[line % 3 - 1] *= 0.02;
        }
        let step = 0.1 / (along[0].powi(2) + along[1].powi(2) + along[2].powi(2)).sqrt();
        let pair = |k: i32| {
            let x: [f64; 3] = std::array::from_fn(|a| point[a] + f64::from(k) * step * along[a]);
            let inside = x[0].max(x[1]) < 89.9 && x[0].min(x[1]) > 20.0;
            (inside && (0.0..=180.0).contains(&x[2])).then(|| at(x[0], x[1], x[2]))
        };
        let sizes: Vec<(f64, Geometry)> = (0..60).map_while(pair).map(|g| (size(g), g)).collect();
        for w in sizes.windows(2) {
            let ratio = (w[0].0 / w[1].0).max(w[1].0 / w[0].0);
            if ratio > worst.0 {
                worst = (ratio, w[1].1);
            }
        }
    }
    worst
}

#[test]
fn neighbours_never_differ_by_much() {
    let cloud = synthetic();
    let worst = steepest(&ThinPlate::new(&cloud).unwrap(), &cloud);
    // the lobe's steepest relative slope is below 30 per radian: 1.05 over 0.1 degree
    assert!(worst.0 < 1.1, "{worst:?}");
}

#[test]
fn negatives_of_the_thesis_schemes_follow_their_policy() {
    let angles = cornell_grid();
    let values: Vec<f64> = angles.iter().flat_map(|_| [-0.01, 0.2, 0.1]).collect();
    let cloud = SampleCloud::new(Basis::Rgb(RgbSpace::srgb()), &angles, &values).unwrap();
    let build = |negatives| -> Vec<Box<dyn Measured>> {
        let layered = |mode| LayeredTable::new(&cloud, mode).with_negatives(negatives);
        vec![
            Box::new(layered(LayerMode::Linear)),
            Box::new(layered(LayerMode::LogLinear)),
            Box::new(KdNearest::new(&cloud).unwrap().with_negatives(negatives)),
        ]
    };
    // between rows, and at one
    for g in [at(33.0, 44.0, 100.0), cloud.geometry()[0]] {
        for m in build(NegativePolicy::Keep) {
            assert!((eval(&*m, g).0[0] + 0.01).abs() < 1e-9, "kept at {g:?}");
        }
        for m in build(NegativePolicy::Clamp) {
            let out = eval(&*m, g).0;
            assert_eq!(out[0].to_bits(), 0.0_f64.to_bits(), "clamped at {g:?}");
            // a constant, up to the rounding of its log
            assert!((out[1] - 0.2).abs() < 1e-9, "the others stay: {out:?}");
        }
    }
}

#[test]
fn too_many_rows_for_a_dense_system_are_refused() {
    let angle = |k: u32| {
        [
            0.1 + f64::from(k / 100) * 0.01,
            0.0,
            0.1 + f64::from(k % 100) * 0.01,
            1.0,
        ]
    };
    let angles: Vec<[f64; 4]> = (0..6001).map(angle).collect();
    let cloud = SampleCloud::new(Basis::Xyz, &angles, &vec![0.1; 3 * angles.len()]).unwrap();
    let error = ThinPlate::new(&cloud).unwrap_err();
    assert_eq!(
        error,
        CloudError::TooManyRows {
            found: 6001,
            limit: 6000
        },
        "one row above the limit"
    );
    assert!(error.to_string().contains("layered"), "{error}");
}

#[test]
fn directions_below_the_horizon_give_zero() {
    let plate = ThinPlate::new(&synthetic()).unwrap();
    let (out, status) = eval(&plate, at(95.0, 30.0, 10.0));
    assert_eq!(
        (out, status),
        (vec![0.0; 3], Status::Filled),
        "below the horizon"
    );
}

#[test]
fn dead_rows_are_isolated() {
    let angles = cornell_grid();
    let is_dead = |a: &[f64; 4]| {
        (1.04..1.05).contains(&a[0])
            && (1.03..1.04).contains(&a[2])
            && (-3.1..-2.85).contains(&a[3])
    };
    let values = angles.iter().flat_map(|a| {
        if is_dead(a) {
            [0.0; 3]
        } else {
            truth(geometry(a))
        }
    });
    let values: Vec<f64> = values.collect();
    let dead = angles.iter().filter(|a| is_dead(a)).count();
    let cloud = SampleCloud::new(Basis::Xyz, &angles, &values).unwrap();
    let plate = ThinPlate::new(&cloud).unwrap();
    assert!(dead > 1, "the case has {dead} dead rows");
    assert_eq!(
        plate.report().isolated.len(),
        dead,
        "{:?}",
        plate.report().isolated
    );
    assert_rows_returned(&plate, &cloud, "isolated");
    let g = plate.report().isolated[0];
    let beside = Geometry {
        phi: g.phi - 0.01,
        ..g
    };
    let ratio = eval(&plate, beside).0[1] / truth(beside)[1];
    // two rows of the lobe's flank are missing
    assert!((ratio - 1.0).abs() < 0.25, "beside a dead row: {ratio}");
    let keep = Policies {
        dead: DeadRows::Keep,
        ..Policies::default()
    };
    let keep = ThinPlate::with_policies(&cloud, keep).unwrap();
    assert!(
        eval(&keep, beside).0[1] < 0.5 * truth(beside)[1],
        "kept rows take part"
    );
}

#[test]
fn negative_values_follow_their_policy() {
    let angles = cornell_grid();
    let values: Vec<f64> = angles.iter().flat_map(|_| [-0.01, 0.2, 0.1]).collect();
    let cloud = SampleCloud::new(Basis::Rgb(RgbSpace::srgb()), &angles, &values).unwrap();
    let g = at(33.0, 44.0, 100.0);
    let keep = eval(&ThinPlate::new(&cloud).unwrap(), g).0[0];
    // a constant is reproduced to the rounding of the solve
    assert!((keep + 0.01).abs() < 1e-9, "{keep}");
    let policies = Policies {
        negative: NegativePolicy::Clamp,
        ..Policies::default()
    };
    let clamp = eval(&ThinPlate::with_policies(&cloud, policies).unwrap(), g).0[0];
    assert_eq!(clamp.to_bits(), 0.0_f64.to_bits(), "clamped");
    assert_eq!(cloud.negatives(), [cloud.len(), 0, 0], "counted");
}

#[test]
fn other_channels_are_the_mapped_answers() {
    let plate = ThinPlate::new(&synthetic()).unwrap();
    let matrix = [[0.4, 0.2, 0.0], [0.3, 0.7, 0.1], [0.2, 0.1, 0.9]];
    let mapped = plate.to_basis(Basis::Xyz, &matrix).unwrap();
    for g in [
        at(33.0, 44.0, 100.0),
        at(70.0, 70.0, 179.0),
        at(84.0, 60.0, 20.0),
    ] {
        let (rgb, _) = eval(&plate, g);
        for (c, have) in eval(&mapped, g).0.into_iter().enumerate() {
            let want: f64 = rgb.iter().zip(matrix).map(|(v, m)| v * m[c]).sum();
            // linear up to rounding, which the system's weights magnify
            assert!(
                (have - want).abs() < 1e-9 * want.abs(),
                "{g:?}: {have} for {want}"
            );
        }
    }
    assert!(
        plate.to_basis(Basis::Xyz, &matrix[..2]).is_err(),
        "a row is missing"
    );
}

#[test]
fn malformed_clouds_are_refused_or_survived() {
    let xyz = |angles: &[[f64; 4]], values: &[f64]| SampleCloud::new(Basis::Xyz, angles, values);
    let row = [0.5, 0.0, 0.3, 1.0];
    assert!(
        matches!(xyz(&[], &[]), Err(CloudError::Empty { .. })),
        "empty"
    );
    assert!(
        matches!(xyz(&[row], &[1.0]), Err(CloudError::Shape { .. })),
        "short"
    );
    assert!(
        matches!(
            xyz(&[row], &[1.0, f64::NAN, 1.0]),
            Err(CloudError::NotFinite { row: 0, .. })
        ),
        "NaN"
    );
    assert!(
        matches!(
            xyz(&[[1.6, 0.0, 0.3, 1.0]], &[1.0; 3]),
            Err(CloudError::Empty { below: 1, .. })
        ),
        "below"
    );
    let twice = xyz(&[row, row], &[1.0, 1.0, 1.0, 3.0, 3.0, 3.0]).unwrap();
    assert_eq!((twice.len(), twice.merged()), (1, 1), "duplicates");
    for cloud in [twice, xyz(&[row, [0.5, 0.0, 0.3, 1.1]], &[0.0; 6]).unwrap()] {
        for scheme in [
            Scheme::ThinPlate,
            Scheme::KdNearest,
            Scheme::Layered(LayerMode::SquaredLambda),
        ] {
            let m = scheme.build(&cloud).unwrap();
            assert_rows_returned(&*m, &cloud, &format!("{scheme:?}"));
            assert!(
                eval(&*m, at(20.0, 50.0, 60.0))
                    .0
                    .iter()
                    .all(|v| v.is_finite()),
                "{scheme:?}"
            );
            assert!(
                leave_one_ring_out(&cloud, scheme).is_err(),
                "{scheme:?}: no ring to leave out"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn no_cloud_panics(
        angles in prop::collection::vec([0.0..1.7_f64, -7.0..7.0, 0.0..1.7, -7.0..7.0], 1..40),
        scale in -1.0..3.0_f64,
        query in [0.0..1.6_f64, 0.0..1.6, 0.0..3.2],
    ) {
        let value = |k: usize| scale * f64::from((k * 7919 % 13) as u32);
        let values: Vec<f64> = (0..angles.len() * 3).map(value).collect();
        if let Ok(cloud) = SampleCloud::new(Basis::Xyz, &angles, &values) {
            for scheme in [Scheme::ThinPlate, Scheme::KdNearest, Scheme::Layered(LayerMode::LogLinear)] {
                if let Ok(m) = scheme.build(&cloud) {
                    let g = Geometry { theta_i: query[0], theta_o: query[1], phi: query[2] };
                    prop_assert!(eval(&*m, g).0.iter().all(|v| v.is_finite()), "{:?}", scheme);
                }
            }
        }
    }
}

#[test]
fn a_reciprocal_truth_is_found_reciprocal() {
    let cloud = synthetic();
    let found = non_reciprocity(&cloud, &ThinPlate::new(&cloud).unwrap()).unwrap();
    // what is left is the interpolation's own error
    assert!(found.slope.abs() < 0.02 && found.median < 0.02, "{found:?}");
}

#[test]
fn a_coarse_grid_knows_its_error() {
    let plate = ThinPlate::new(&synthetic()).unwrap();
    let [coarse, fine] =
        [[12, 12, 8], [24, 24, 16]].map(|dims| resample(&plate, plate.domain(), dims));
    // trilinear: half the step, a quarter of the error where the function is smooth
    assert!(
        fine.relative_error() < 0.5 * coarse.relative_error(),
        "{} {}",
        fine.relative_error(),
        coarse.relative_error()
    );
    assert!(
        (fine.mean / coarse.mean - 1.0).abs() < 1e-12,
        "the mean is the interpolant's"
    );
}

/// A genuine RGB and spectral file of one material.
fn genuine(name: &str) -> Option<(SampleCloud, SampleCloud)> {
    let dir = testkit::data_dir_or_skip()?;
    let read = |path: String| {
        #[expect(clippy::disallowed_methods, reason = "tests read their own data")]
        std::fs::read(dir.join(path)).unwrap()
    };
    let rgb = AstmFile::from_bytes(&read(format!("cornell/{name}_RGB.astm"))).unwrap();
    let bands = PbrtTextFile::from_bytes(&read(format!("cornell-spectral/{name}.brdf"))).unwrap();
    Some((
        SampleCloud::from_astm(&rgb).unwrap(),
        SampleCloud::from_pbrt_text(&bands).unwrap(),
    ))
}

#[test]
fn slow_cornell_files_meet_the_goals() {
    for (name, l2) in [("garnet_red", 0.106), ("krylon_blue", 0.089)] {
        let Some((rgb, _)) = genuine(name) else {
            return;
        };
        let plate = ThinPlate::new(&rgb).unwrap();
        assert_rows_returned(&plate, &rgb, name);
        let scores = leave_one_ring_out(&rgb, Scheme::ThinPlate).unwrap();
        assert!(
            scores.specular_rms_log <= 0.05 && scores.median_log <= 0.02,
            "{name}: {scores:?}"
        );
        assert!(
            scores.relative_l2 < l2,
            "{name}: {scores:?}, a local fit has {l2}"
        );
        let worst = steepest(&plate, &rgb);
        println!("{name}: largest ratio of neighbours {worst:?}");
        assert!(worst.0 < 1.1, "{name}: {worst:?}");
        let grid = resample(&plate, plate.domain(), brdf_table::scattered::DEFAULT_DIMS);
        assert!(
            grid.relative_error() <= 0.01,
            "{name}: {}",
            grid.relative_error()
        );
    }
}

#[test]
fn slow_rgb_and_spectral_files_agree() {
    for name in ["garnet_red", "krylon_blue"] {
        let Some((rgb, bands)) = genuine(name) else {
            return;
        };
        let srgb = |c: &SampleCloud| {
            let matrix = c.basis().to_linear_srgb();
            let plate = ThinPlate::new(c).unwrap();
            plate
                .to_basis(Basis::Rgb(RgbSpace::srgb()), &matrix)
                .unwrap()
        };
        let (a, b) = (srgb(&rgb), srgb(&bands));
        let (mut difference, mut sum) = (0.0, 0.0);
        for k in 0..4000 {
            let step = [0.8191725134, 0.6710436067, 0.5497004779];
            let u = step.map(|s: f64| (s * f64::from(k)).fract());
            let g = at(80.0 * u[0], 80.0 * u[1], 180.0 * u[2]);
            for (x, y) in eval(&a, g).0.iter().zip(eval(&b, g).0) {
                difference += (x - y).abs() * g.theta_o.cos();
                sum += x.abs() * g.theta_o.cos();
            }
        }
        println!(
            "{name}: RGB and spectral file differ by {:.5} of the mean",
            difference / sum
        );
        // the project's own goal for pictures
        assert!(difference / sum < 0.01, "{name}: {}", difference / sum);
    }
}
