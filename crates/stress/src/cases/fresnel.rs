//! Fresnel's equations at grazing angles, for indices of 1 and of a million.

use crate::case::Case;
use crate::real::Real;
use crate::reference::unpolarised;
use brdf_models::Fresnel;

/// Real parts: below 1 there is total reflection, at 1 nothing.
const N: [f64; 9] = [0.05, 0.9, 1.0, 1.0 + 1e-9, 1.33, 1.5, 100.0, 1e3, 1e6];
/// Imaginary parts.
const K: [f64; 6] = [0.0, 1e-9, 0.1, 3.9, 1e3, 1e6];
/// Cosines, down to 1e-12 rad above the horizon and beside the pole.
const COSINES: [f64; 10] = [
    1e-12,
    1e-9,
    1e-7,
    1e-4,
    0.01,
    0.3,
    0.71,
    0.95,
    1.0 - 1e-9,
    1.0,
];

pub(super) fn cases() -> Vec<Case> {
    vec![Case::new(
        "fresnel/unpolarised",
        1e-11,
        "roundings of f64, grown by n/(n - 1) for indices close to 1",
        |_, tally| {
            for (n, k) in N.into_iter().flat_map(|n| K.map(|k| (n, k))) {
                let fresnel = Fresnel::from_index([n], [k]);
                for c in COSINES {
                    let exact = Real::new(c);
                    let sin2 = (1.0 - &exact) * (1.0 + &exact);
                    let value = fresnel.eval_at(c, sin2.to_f64())[0];
                    let reference = unpolarised(n, k, &exact, &sin2).to_f64();
                    tally.value(value, reference, 1e-25, || {
                        format!("n {n}, k {k}, cos {c:e}")
                    });
                }
            }
        },
    )]
}
