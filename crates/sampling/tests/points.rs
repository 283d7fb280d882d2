//! Point sets as a renderer sees them: range, reproducibility, uniformity, and lower error than chance.

use sampling::points::LANES;
use sampling::{PointSet, Points, Welford};
use testkit::chi2::{Config, test};
use testkit::{Domain, assert_close};

/// Exact comparison.
fn bits<const N: usize>(p: [f32; N]) -> [u32; N] {
    p.map(f32::to_bits)
}

const KINDS: [PointSet; 3] = [PointSet::Independent, PointSet::Halton, PointSet::Sobol];

#[test]
fn values_are_in_the_half_open_interval() {
    for kind in KINDS {
        let points = Points::new(kind, 1);
        for index in (0..20_000).chain(u32::MAX - 100..=u32::MAX) {
            let p = points.get2(index % 7, index, index % 40);
            let single = points.get1(index % 7, index, index % 40);
            for x in [p[0], p[1], single] {
                assert!((0.0..1.0).contains(&x), "{kind:?}, index {index}: {x}");
            }
        }
    }
}

#[test]
fn lanes_give_the_same_numbers() {
    let pixel: [u32; LANES] = std::array::from_fn(|k| 1000 + 3 * k as u32);
    let index: [u32; LANES] = std::array::from_fn(|k| 17 * k as u32);
    for kind in KINDS {
        let points = Points::new(kind, 99);
        for dim in [0, 5, 40] {
            let lanes = points.get2_lanes(pixel, index, dim);
            for k in 0..LANES {
                let one = points.get2(pixel[k], index[k], dim);
                assert_eq!(
                    bits([lanes[0][k], lanes[1][k]]),
                    bits(one),
                    "{kind:?}, lane {k}"
                );
            }
        }
    }
}

#[test]
fn numbers_stay_the_same_from_version_to_version() {
    // Golden renders rest on these; a change here changes every image.
    let raw = |kind| {
        let p = Points::new(kind, 42).get2(7, 11, 3);
        p.map(|x| (f64::from(x) * f64::from(1 << 24)) as u32)
    };
    assert_eq!(raw(PointSet::Independent), [2662782, 9900707]);
    assert_eq!(raw(PointSet::Sobol), [16080113, 9307862]);
    assert_eq!(raw(PointSet::Halton), [6833967, 4279506]);
}

#[test]
fn seeds_pixels_and_dimensions_differ() {
    for kind in KINDS {
        let points = Points::new(kind, 1);
        let [x, y] = points.get2(1, 1, 1);
        let others = [
            Points::new(kind, 2).get2(1, 1, 1),
            points.get2(2, 1, 1),
            points.get2(1, 2, 1),
            points.get2(1, 1, 2),
            [points.get1(1, 1, 1), points.get1(1, 1, 2)],
        ];
        for [a, b] in others {
            assert!(
                (a - x).abs() > 1e-6 && (b - y).abs() > 1e-6,
                "{kind:?}: {x} {y}, {a} {b}"
            );
        }
    }
}

/// One fixed index, many randomisations: each point alone must be uniform, or estimates are biased.
#[test]
fn every_point_is_uniform_over_seeds() {
    for kind in KINDS {
        for (index, dim) in [(0, 0), (5, 1), (1000, 7)] {
            let config = Config {
                domain: Domain::Square,
                tests: 9,
                ..Config::default()
            };
            let mut pixel = 0;
            let sample = |_: &mut testkit::Rng| {
                pixel += 1;
                let [x, y] = Points::new(kind, 5).get2(pixel, index, dim);
                Some([f64::from(x), f64::from(y), 0.0])
            };
            let report = test(&config, sample, |_| 1.0);
            assert!(report.ok, "{kind:?}, index {index}, dim {dim}: {report}");
        }
    }
}

/// Dimensions that are combined in one path must not know of each other.
#[test]
fn dimension_pairs_are_unrelated() {
    for kind in KINDS {
        for (first, second) in [(0, 1), (1, 2), (3, 9)] {
            let config = Config {
                domain: Domain::Square,
                tests: 18,
                ..Config::default()
            };
            for side in 0..2 {
                let mut k = 0_u32;
                let sample = |_: &mut testkit::Rng| {
                    k += 1;
                    // 16 samples in each of many pixels, as in a render
                    let (pixel, index) = (k / 16, k % 16);
                    let points = Points::new(kind, 6);
                    let x = points.get2(pixel, index, first)[side];
                    let y = points.get2(pixel, index, second)[side];
                    Some([f64::from(x), f64::from(y), 0.0])
                };
                let report = test(&config, sample, |_| 1.0);
                assert!(report.ok, "{kind:?}, {first}/{second}[{side}]: {report}");
            }
        }
    }
}

/// Root mean square error of the mean of `n` points of a smooth function over 64 pixels; its integral is 1.
fn rmse(kind: PointSet, n: u32, f: impl Fn(&Points, u32, u32) -> f64) -> f64 {
    let points = Points::new(kind, 7);
    let squares: Welford = (0..64)
        .map(|pixel| {
            let mean: Welford = (0..n).map(|index| f(&points, pixel, index)).collect();
            (mean.mean() - 1.0).powi(2)
        })
        .collect();
    squares.mean().sqrt()
}

/// (pi/2)^2 sin(pi x) sin(pi y), integral 1.
fn smooth([x, y]: [f32; 2]) -> f64 {
    use std::f64::consts::{FRAC_PI_2, PI};
    let s = |t: f32| FRAC_PI_2 * (PI * f64::from(t)).sin();
    s(x) * s(y)
}

#[test]
fn low_discrepancy_beats_chance_on_smooth_integrands() {
    let f = |p: &Points, pixel, index| smooth(p.get2(pixel, index, 2));
    let chance = rmse(PointSet::Independent, 1024, f);
    // Owen's rate n^-1.5 gives far more than these; the margin is for 64 pixels' noise (9 %).
    let halton = rmse(PointSet::Halton, 1024, f);
    let sobol = rmse(PointSet::Sobol, 1024, f);
    assert!(
        halton < chance / 10.0,
        "Halton {halton}, independent {chance}"
    );
    assert!(
        sobol < chance / 100.0,
        "Sobol {sobol}, independent {chance}"
    );
    // the rate: 16 times the points, 64 times less error (16^1.5), half of it asked for
    let more = rmse(PointSet::Sobol, 16 * 1024, f);
    assert!(more < sobol / 32.0, "1024: {sobol}, 16384: {more}");
}

#[test]
fn independent_points_err_as_theory_says() {
    // variance of the integrand: (pi^2/8)^2 - 1 = 0.522
    let expected = (0.522_f64 / 1024.0).sqrt();
    let f = |p: &Points, pixel, index| smooth(p.get2(pixel, index, 2));
    // 64 pixels know their RMSE to 9 %
    assert_close(
        rmse(PointSet::Independent, 1024, f) / expected,
        1.0,
        0.3,
        "RMSE",
    );
}

#[test]
fn padding_keeps_the_gain_of_sums_over_dimension_pairs() {
    let f = |p: &Points, pixel, index| {
        let sum: f64 = (0..8).map(|dim| smooth(p.get2(pixel, index, dim))).sum();
        sum / 8.0
    };
    let (chance, sobol) = (
        rmse(PointSet::Independent, 256, f),
        rmse(PointSet::Sobol, 256, f),
    );
    assert!(sobol < chance / 20.0, "Sobol {sobol}, independent {chance}");
}

/// The largest deviation of the share of points in [0, x) x [0, y) from the area x y, over a grid.
#[test]
fn star_discrepancy_is_lower_than_by_chance() {
    let discrepancy = |kind| {
        let points = Points::new(kind, 8);
        let set: Vec<[f32; 2]> = (0..1024).map(|index| points.get2(0, index, 0)).collect();
        let mut worst = 0.0_f64;
        for i in 1..=64_u16 {
            for j in 1..=64_u16 {
                let (x, y) = (f32::from(i) / 64.0, f32::from(j) / 64.0);
                let inside = set.iter().filter(|p| p[0] < x && p[1] < y).count();
                let share = inside as f64 / set.len() as f64;
                worst = worst.max((share - f64::from(x * y)).abs());
            }
        }
        worst
    };
    let chance = discrepancy(PointSet::Independent);
    for kind in [PointSet::Halton, PointSet::Sobol] {
        assert!(discrepancy(kind) < chance / 3.0, "{kind:?}");
    }
}
