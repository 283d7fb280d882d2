//! The special functions behind p-values: incomplete gamma and beta functions.

use std::f64::consts::PI;

/// ln Gamma(x) for x > 0, relative error below 1e-13: Lanczos' approximation, g = 7, n = 9 [Press2007, 6.1].
#[must_use]
pub fn ln_gamma(x: f64) -> f64 {
    const C: [f64; 9] = [
        0.99999999999980993,
        676.5203681218851,
        -1259.1392167224028,
        771.32342877765313,
        -176.61502916214059,
        12.507343278686905,
        -0.13857109526572012,
        9.9843695780195716e-6,
        1.5056327351493116e-7,
    ];
    if x < 0.5 {
        return (PI / (PI * x).sin()).ln() - ln_gamma(1.0 - x);
    }
    let x = x - 1.0;
    let t = x + 7.5;
    let sum = C
        .iter()
        .enumerate()
        .skip(1)
        .fold(C[0], |s, (k, c)| s + c / (x + k as f64));
    0.5 * (2.0 * PI).ln() + (x + 0.5) * t.ln() - t + sum.ln()
}

/// Iterations after which a series or continued fraction is taken as it stands; both converge in about
/// 10 sqrt(a) steps, so this serves a million degrees of freedom.
const MAX_STEPS: usize = 20_000;

/// Regularised upper incomplete gamma function Q(a, x) = Gamma(a, x) / Gamma(a), a > 0 [Press2007, 6.2].
///
/// Q(k/2, x/2) is the probability that chi-square with k degrees of freedom exceeds x. 1 for x <= 0.
#[must_use]
pub fn gamma_q(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    if x.is_infinite() {
        return 0.0;
    }
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        1.0 - scale * gamma_series(a, x)
    } else {
        scale * gamma_fraction(a, x)
    }
}

/// sum over n of x^n / (a (a+1) ... (a+n)).
fn gamma_series(a: f64, x: f64) -> f64 {
    let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
    for _ in 0..MAX_STEPS {
        n += 1.0;
        term *= x / n;
        sum += term;
        if term < sum * f64::EPSILON {
            break;
        }
    }
    sum
}

/// Lentz' method for 1/(x+1-a- 1(1-a)/(x+3-a- 2(2-a)/(x+5-a- ...))).
fn gamma_fraction(a: f64, x: f64) -> f64 {
    let mut b = x + 1.0 - a;
    let mut c = 1.0 / f64::MIN_POSITIVE;
    let mut d = 1.0 / b;
    let mut h = d;
    for k in 1..MAX_STEPS {
        let k = k as f64;
        let numerator = -k * (k - a);
        b += 2.0;
        d = 1.0 / nonzero(numerator * d + b);
        c = nonzero(b + numerator / c);
        let step = c * d;
        h *= step;
        if (step - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    h
}

fn nonzero(x: f64) -> f64 {
    if x.abs() < f64::MIN_POSITIVE {
        f64::MIN_POSITIVE
    } else {
        x
    }
}

/// Probability that chi-square with `dof` > 0 degrees of freedom is at least `x`.
#[must_use]
pub fn chi2_tail(x: f64, dof: f64) -> f64 {
    gamma_q(0.5 * dof, 0.5 * x)
}

/// Probability that a standard normal variable is at least |z| away from 0.
#[must_use]
pub fn normal_two_sided(z: f64) -> f64 {
    gamma_q(0.5, 0.5 * z * z)
}

/// Regularised incomplete beta function I_x(a, b), a, b > 0, x in [0, 1] [Press2007, 6.4].
#[must_use]
pub fn beta_i(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    let ln_scale = ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) + a * x.ln() + b * (-x).ln_1p();
    if x < (a + 1.0) / (a + b + 2.0) {
        ln_scale.exp() * beta_fraction(a, b, x) / a
    } else {
        1.0 - ln_scale.exp() * beta_fraction(b, a, 1.0 - x) / b
    }
}

/// Lentz' method for the continued fraction of I_x(a, b).
fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let mut c = 1.0;
    let mut d = 1.0 / nonzero(1.0 - (a + b) * x / (a + 1.0));
    let mut h = d;
    for m in 1..MAX_STEPS {
        let m = m as f64;
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / nonzero(1.0 + even * d);
        c = nonzero(1.0 + even / c);
        h *= d * c;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / nonzero(1.0 + odd * d);
        c = nonzero(1.0 + odd / c);
        h *= d * c;
        if (d * c - 1.0).abs() < 4.0 * f64::EPSILON {
            break;
        }
    }
    h
}

/// Probability that Student's t with `dof` > 0 degrees of freedom is at least |t| away from 0.
#[must_use]
pub fn student_two_sided(t: f64, dof: f64) -> f64 {
    beta_i(0.5 * dof, 0.5, dof / (dof + t * t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::assert_relative;

    #[test]
    fn ln_gamma_of_integers_and_halves() {
        assert_relative(ln_gamma(10.0), 362_880_f64.ln(), 1e-13, "9!");
        assert_relative(ln_gamma(0.5), 0.5 * PI.ln(), 1e-13, "sqrt pi");
        assert_relative(ln_gamma(0.1).exp(), 9.513507698668732, 1e-12, "Gamma(0.1)");
    }

    #[test]
    fn chi_square_with_two_degrees_is_exponential() {
        for x in [0.01, 1.0, 3.0, 20.0, 600.0] {
            assert_relative(chi2_tail(x, 2.0), (-0.5 * x).exp(), 1e-12, "tail");
        }
    }

    #[test]
    fn tables_of_critical_values() {
        // 5 % and 0.1 % points as printed in [Abramowitz1964, tables 26.8 and 26.10]; 4 to 5 digits.
        assert_relative(chi2_tail(18.3070, 10.0), 0.05, 1e-4, "chi2 10");
        assert_relative(chi2_tail(149.449, 100.0), 0.001, 1e-4, "chi2 100");
        assert_relative(normal_two_sided(1.959964), 0.05, 1e-6, "normal");
        assert_relative(student_two_sided(2.228, 10.0), 0.05, 2e-3, "t 10");
        assert_relative(student_two_sided(1.0, 1.0), 0.5, 1e-12, "Cauchy");
    }

    #[test]
    fn many_degrees_of_freedom_approach_the_normal() {
        // Wilson-Hilferty: (x/k)^(1/3) is normal with mean 1 - 2/9k, variance 2/9k; good to O(1/k).
        let k: f64 = 100_000.0;
        let z = 1.5;
        let x = k * (1.0 - 2.0 / (9.0 * k) + z * (2.0 / (9.0 * k)).sqrt()).powi(3);
        assert_relative(chi2_tail(x, k), 0.5 * normal_two_sided(z), 1e-4, "tail");
    }
}
