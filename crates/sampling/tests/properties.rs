//! Tables nobody thought of: any values are either refused or sampled within the rules.

use glam::DVec2;
use proptest::prelude::{Strategy, any, prop, prop_assert, prop_oneof, proptest};
use sampling::{AliasTable, Mixture, ONE_MINUS_EPSILON, Piecewise1, Piecewise2};

/// Zeros, ordinary and extreme magnitudes.
fn value() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => 0.0..10.0,
        2 => proptest::strategy::Just(0.0),
        1 => (-200..200_i32).prop_map(|e| 10_f64.powi(e)),
    ]
}

/// Numbers of [0, 1) with both ends.
fn unit() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => 0.0..1.0,
        1 => proptest::strategy::Just(0.0),
        1 => proptest::strategy::Just(ONE_MINUS_EPSILON),
    ]
}

proptest! {
    #[test]
    fn one_dimension(values in prop::collection::vec(value(), 1..40), u in unit()) {
        for table in [Piecewise1::constant(&values), Piecewise1::linear(&values)].into_iter().flatten() {
            let (x, pdf) = table.sample(u);
            prop_assert!((0.0..1.0).contains(&x) && pdf >= 0.0, "{x}, {pdf}");
            let back = table.invert(x);
            // x has an absolute rounding of 1e-16, which pdf turns into probability
            prop_assert!((back - u).abs() <= 1e-12 + 4.0 * f64::EPSILON * pdf, "{back}, {u}");
        }
    }

    #[test]
    fn two_dimensions(values in prop::collection::vec(value(), 1..60), width in 0..9_usize, x in unit(), y in unit()) {
        let tables = [Piecewise2::constant(width, &values), Piecewise2::bilinear(width, &values)];
        for table in tables.into_iter().flatten() {
            let (p, pdf) = table.sample(DVec2::new(x, y));
            prop_assert!(p.min_element() >= 0.0 && p.max_element() < 1.0, "{p}");
            prop_assert!(pdf >= 0.0 && table.pdf(p) >= 0.0, "{pdf}");
            let back = table.invert(p);
            prop_assert!(back.is_finite() && back.min_element() >= 0.0, "{back}");
        }
    }

    #[test]
    fn discrete(values in prop::collection::vec(value(), 1..40), u in unit()) {
        if let Ok(table) = AliasTable::new(&values) {
            let (k, p, rest) = table.sample(u);
            prop_assert!(values[k] > 0.0 && p > 0.0 && (0.0..1.0).contains(&rest), "{k}, {p}, {rest}");
        }
        if let Ok(mixture) = Mixture::new(&values) {
            let (k, rest) = mixture.choose(u);
            prop_assert!(values[k] > 0.0 && (0.0..1.0).contains(&rest), "{k}, {rest}");
        }
    }

    #[test]
    fn nothing_panics_on_any_bits(bits in prop::collection::vec(any::<u64>(), 0..20), width in 0..9_usize) {
        let values: Vec<f64> = bits.into_iter().map(f64::from_bits).collect();
        for table in [Piecewise1::constant(&values), Piecewise1::linear(&values)].into_iter().flatten() {
            prop_assert!(table.sample(0.5).0 < 1.0);
        }
        for table in [Piecewise2::constant(width, &values), Piecewise2::bilinear(width, &values)].into_iter().flatten() {
            prop_assert!(table.sample(DVec2::splat(0.5)).1 >= 0.0);
        }
    }
}
