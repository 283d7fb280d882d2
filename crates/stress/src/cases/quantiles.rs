//! What confidence intervals and checks stand on: quantiles, tails, quadrature, running sums.

use crate::case::Case;
use crate::real::Real;
use sampling::integrate::{gauss_legendre, hemisphere};
use sampling::special::{chi2_tail, student_two_sided};
use sampling::{Welford, student_quantile};
use std::f64::consts::TAU;

pub(super) fn cases() -> Vec<Case> {
    vec![
        Case::new(
            "statistics/student quantile",
            1e-9,
            "tails of 1e-9 are differences from 1 in f64; documented as 1e-12 (1 + t^2)",
            |_, tally| {
                let levels = [0.01, 0.5, 0.9, 0.95, 0.99, 0.999_999];
                for c in levels {
                    // closed forms: 1 and 2 degrees of freedom
                    let one = Real::pi() * 0.5 * c;
                    let exact = (one.sin() / one.cos()).to_f64();
                    tally.value(student_quantile(c, 1), exact, 0.0, || format!("1, {c}"));
                    let exact = c * (2.0 / (1.0 - Real::new(c).sqr())).sqrt();
                    let value = student_quantile(c, 2);
                    tally.value(value, exact.to_f64(), 0.0, || format!("2, {c}"));
                    for dof in [3_u32, 7, 15, 100, 9_999, 100_000] {
                        let t = student_quantile(c, dof);
                        let tail = student_two_sided(t, f64::from(dof));
                        tally.value(tail, 1.0 - c, 1e-3, || format!("{dof}, {c}"));
                    }
                }
            },
        ),
        Case::new(
            "statistics/chi-square tail",
            1e-10,
            "ln Gamma of 1e3 to 1e-13, exponentiated",
            |_, tally| {
                for half in [1_u32, 5, 50, 500, 5_000] {
                    for ratio in [0.01, 0.5, 0.9, 1.0, 1.1, 1.5, 3.0] {
                        let x = ratio * 2.0 * f64::from(half);
                        // even degrees of freedom: e^-y sum_k y^k/k!
                        let y = Real::new(0.5 * x);
                        let (mut term, mut sum) = (Real::new(1.0), Real::new(1.0));
                        for k in 1..half {
                            term = term * &y / f64::from(k);
                            sum = sum + &term;
                        }
                        let exact = ((-&y).exp() * sum).to_f64();
                        let value = chi2_tail(x, 2.0 * f64::from(half));
                        tally.value(value, exact, 1e-30, || format!("dof {}, x {x}", 2 * half));
                    }
                }
            },
        ),
        Case::new(
            "statistics/spherical quadrature",
            1e-12,
            "Gauss rules are exact for polynomials; hundreds of terms of one sign",
            |_, tally| {
                for (n, last) in [(2_usize, 3), (16, 31), (64, 127), (256, 511)] {
                    let weights: f64 = gauss_legendre(n).iter().map(|(_, w)| w).sum();
                    tally.value(weights, 2.0, 0.0, || format!("weights of {n}"));
                    for power in [0, 1, last / 2, last] {
                        let value = hemisphere(|w| w[2].powi(power), n);
                        let exact = TAU / (f64::from(power) + 1.0);
                        tally.value(value, exact, 0.0, || format!("z^{power}, {n} nodes"));
                    }
                }
            },
        ),
        Case::new(
            "statistics/variance beside a large mean",
            1e-6,
            "1e-16 of a mean of 1e9 is 1e-7 of the deviation",
            |effort, tally| {
                let n = effort.pick(10_000, 1_000_000) as u32;
                for mean in [0.0, 1e3, 1e6, 1e9] {
                    // deviations of -1, 0, 1, 0
                    let values = (0..n).map(|k| mean + [-1.0, 0.0, 1.0, 0.0][k as usize % 4]);
                    let w: Welford = values.collect();
                    let exact = 0.5 * f64::from(n) / f64::from(n - 1);
                    tally.value(w.variance(), exact, 0.0, || {
                        format!("variance, mean {mean:e}")
                    });
                    tally.signed(w.mean(), mean, 1.0, || format!("mean {mean:e}"));
                }
            },
        ),
    ]
}
