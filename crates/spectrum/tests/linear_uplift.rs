//! The linear basis does what its paper promises.

use spectrum::matrix::transform;
use spectrum::{LinearUplift, Viewing, table_srgb_from_xyz};
use testkit::assert_close;

const PRIMARIES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

#[test]
fn the_round_trip_is_exact_for_any_colour() {
    let viewing = Viewing::standard();
    let matrix = table_srgb_from_xyz(&viewing);
    let others = [[1.0; 3], [0.2, 0.5, 0.1], [-0.3, 2.5, 0.0]];
    for rgb in PRIMARIES.into_iter().chain(others) {
        let found = transform(&matrix, viewing.xyz(&LinearUplift::spectrum(rgb)));
        for c in 0..3 {
            // nine decimals of the table
            assert_close(found[c], rgb[c], 3e-9, &format!("{rgb:?}"));
        }
    }
}

#[test]
fn the_primaries_are_reflectances_that_sum_to_one() {
    let [r, g, b] = PRIMARIES.map(LinearUplift::spectrum);
    for k in 0..r.values().len() {
        let parts = [&r, &g, &b].map(|s| s.values()[k]);
        assert!(parts.iter().all(|v| (0.0..=1.0).contains(v)), "{parts:?}");
        assert_close(parts.iter().sum(), 1.0, 1e-15, "white");
    }
}

#[test]
fn each_primary_reflects_where_it_should() {
    // smooth steps: blue below, green between, red above
    let [r, g, b] = PRIMARIES.map(LinearUplift::spectrum);
    for (light, dark, nm) in [
        (&b, [&r, &g], 450.0),
        (&g, [&r, &b], 545.0),
        (&r, [&g, &b], 650.0),
    ] {
        assert!(light.at(nm) > 0.95, "{nm}: {}", light.at(nm));
        assert!(dark.iter().all(|s| s.at(nm) < 0.05), "{nm}");
    }
}
