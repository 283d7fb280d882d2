//! The forms that rendering calls, `GriddedN`, `BinnedGrid` and `RglN`, answer like the tables they show: in f64 exactly, in
//! lanes up to the rounding of f32 directions; packed tables up to their 16 bits.

use crate::table_kinds::{gloss_grid, rgl_table};
use brdf::{Brdf, LANES, Lanes3, Measured};
use brdf_table::{BinnedGrid, Gridded, GriddedN, Interpolation, PhiDomain, RglN};
use glam::DVec3;
use std::sync::Arc;

/// Pairs of directions, a packet at a time, away from the horizon and from each other's retro direction.
fn packets() -> Vec<(Lanes3, Lanes3)> {
    let at = |k: usize, step: f64| {
        brdf::direction(0.05 + 1.4 * (k as f64 * step).fract(), k as f64 * 2.399_963)
    };
    (0..16)
        .map(|p| {
            let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
            for k in 0..LANES {
                let n = p * LANES + k + 1;
                wi.set(k, at(n, 0.618_034).as_vec3());
                wo.set(k, at(n + 5, 0.754_878).as_vec3());
            }
            (wi, wo)
        })
        .collect()
}

/// Largest differences of `brdf` from `native`, relative to the largest value seen: in f64, and in lanes.
fn differences(brdf: &dyn Brdf<3>, native: &dyn Measured) -> [f64; 2] {
    let (mut exact, mut lanes, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (wi, wo) in packets() {
        let packet = brdf.eval_lanes(&wi, &wo);
        for k in 0..LANES {
            let (i, o): (DVec3, DVec3) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
            let mut expected = [0.0; 3];
            native.eval_native(i, o, &mut expected);
            let found = brdf.eval(i, o);
            for c in 0..3 {
                exact = exact.max((found[c] - expected[c]).abs());
                lanes = lanes.max((f64::from(packet[c][k]) - expected[c]).abs());
                largest = largest.max(expected[c].abs());
            }
        }
    }
    [exact / largest, lanes / largest]
}

#[test]
fn rendering_forms_answer_like_their_tables() {
    for interpolation in [Interpolation::Nearest, Interpolation::Linear] {
        let table = Arc::new(gloss_grid(PhiDomain::Reciprocal));
        let shown = GriddedN::<3>::new(Arc::clone(&table), interpolation).unwrap();
        let one = |b: usize, c: usize| if b == c { 1.0 } else { 0.0 };
        let rows: [[f64; 3]; 3] = std::array::from_fn(|b| std::array::from_fn(|c| one(b, c)));
        let packed = BinnedGrid::<1, 3>::new(&table, interpolation, &rows).unwrap();
        let native = Gridded {
            table,
            interpolation,
        };
        let [single, packets] = differences(&packed, &native);
        // half a step of 15 bits, and f32 directions
        assert!(
            single.max(packets) < 4e-5,
            "BinnedGrid {interpolation:?}: {single:e}, in lanes {packets:e}"
        );
        let [exact, lanes] = differences(&shown, &native);
        assert!(exact <= 0.0, "GriddedN {interpolation:?}: {exact:e}");
        // a direction of f32 moves a smooth table by about 1e-6; a nearest cell may flip at its border, which these pairs avoid
        assert!(
            lanes < 1e-5,
            "GriddedN {interpolation:?} in lanes: {lanes:e}"
        );
    }
    let table = rgl_table();
    let shown = RglN::<3>::new(Arc::clone(&table)).unwrap();
    let [exact, lanes] = differences(&shown, &*table);
    assert!(exact < 1e-12, "RglN: {exact:e}");
    // warps are inverted in f32
    assert!(lanes < 1e-4, "RglN in lanes: {lanes:e}");
}
