//! The series of the directional-diffuse part of [He1991], at the same cost for every roughness.

use super::lambert_w;
use std::f64::consts::TAU;

/// From this saddle point on the sum is taken as an integral. Its lower end then lies where the summand is
/// e^-16 of its peak, which bounds the error by about 1e-5.
const FROM_INTEGRAL: f64 = 16.0;
/// Step of the integral in standard deviations of the summand: the trapezoidal rule on a Gaussian errs by
/// 2 exp(-2 pi^2) = 5e-9 [Trefethen2014]; the summand is skewed, and errs more.
const STEP: f64 = 1.0;
/// Share of the largest term after which none are summed up.
const NEGLIGIBLE: f64 = 1e-7;
/// Most terms of the direct sum: the saddle point, 6.5 deviations of at most 4, a few for small sums.
const TERMS: usize = 48;
/// Exponentials computed together.
const WIDTH: usize = 8;

/// sum over m >= 1 of e^-g g^m / (m! m) e^(-w/m), for g >= 0 and w >= 0, to 1e-5 relative.
///
/// Where the sum itself is below 1e-290, 0 is returned.
#[inline]
pub(super) fn series(g: f64, w: f64) -> f64 {
    if g <= 0.0 {
        return 0.0;
    }
    // the largest term is near m0, where ln(g/m) + w/m^2 = 0: m0 = g exp(W(2w/g^2)/2)
    let tilt = 2.0 * (w / g) / g;
    if tilt > f64::MAX {
        // g so small that every term but the first underflows
        return direct(g, w, 1);
    }
    let m0 = g * (0.5 * lambert_w::rough(tilt)).exp();
    // the summand is nearly a Gaussian of this deviation
    let deviation = (m0 / (1.0 + 2.0 * (w / m0) / m0)).sqrt();
    if m0 < FROM_INTEGRAL {
        // to the right the summand falls like Poisson's, whatever w
        direct(g, w, (m0 + 6.5 * m0.sqrt() + 4.0) as usize)
    } else {
        integral(g, w, m0, deviation)
    }
}

/// The first `terms` terms. Factors come by recurrence, exponentials eight at a time.
#[inline]
fn direct(g: f64, w: f64, terms: usize) -> f64 {
    let terms = terms.min(TERMS);
    // g^m e^-g / (m! m), m = 1
    let mut factor = g * (-g).exp();
    let mut sum = 0.0;
    for chunk in 0..terms.div_ceil(WIDTH) {
        let first = chunk * WIDTH;
        let mut x = [0.0; WIDTH];
        for k in 0..WIDTH {
            x[k] = -w * RECIPROCAL[first + k];
        }
        let e = exp(&x);
        for k in 0..WIDTH {
            sum += factor * e[k];
            // t_{m+1}/t_m = g m/(m+1)^2 but for the exponential
            factor *= g * RATIO[first + k];
        }
    }
    sum
}

/// 1/m at m - 1.
const RECIPROCAL: [f64; TERMS] = {
    let mut table = [0.0; TERMS];
    let mut m = 1;
    while m <= TERMS {
        table[m - 1] = 1.0 / m as f64;
        m += 1;
    }
    table
};

/// m/(m+1)^2 at m - 1.
const RATIO: [f64; TERMS] = {
    let mut table = [0.0; TERMS];
    let mut m = 1;
    while m <= TERMS {
        table[m - 1] = m as f64 / ((m + 1) * (m + 1)) as f64;
        m += 1;
    }
    table
};

/// e^x for x <= 0 to 1e-11, without branches, so that the loop becomes vector code; 0 below -700.
#[inline]
fn exp(x: &[f64; WIDTH]) -> [f64; WIDTH] {
    /// Adding it rounds to a whole number: 1.5 * 2^52.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    // ln 2 in two parts, the first short enough that n times it is exact [Cody1980]
    const LN2_HIGH: f64 = 0.693_145_751_953_125;
    const LN2_LOW: f64 = 1.428_606_820_309_417_2e-6;
    let mut out = [0.0; WIDTH];
    for k in 0..WIDTH {
        let x_k = x[k].max(-708.0);
        let shifted = x_k * std::f64::consts::LOG2_E + ROUND;
        let n = shifted - ROUND;
        let r = x_k - n * LN2_HIGH - n * LN2_LOW;
        // Taylor: |r| <= ln 2 / 2, r^10/10! < 7e-12
        let mut p = 1.0 / 362_880.0;
        for c in [
            1.0 / 40_320.0,
            1.0 / 5_040.0,
            1.0 / 720.0,
            1.0 / 120.0,
            1.0 / 24.0,
            1.0 / 6.0,
            0.5,
            1.0,
            1.0,
        ] {
            p = p * r + c;
        }
        // the whole number stands in the low bits of `shifted`
        let exponent = shifted.to_bits().wrapping_add(1023) << 52;
        let e = p * f64::from_bits(exponent);
        out[k] = if x[k] < -700.0 { 0.0 } else { e };
    }
    out
}

/// The sum as an integral over m, by the trapezoidal rule about the saddle point; in steps of 1, that is as the
/// sum itself, where the summand is too narrow for more.
#[inline]
fn integral(g: f64, w: f64, m0: f64, deviation: f64) -> f64 {
    let (centre, step) = if deviation > 1.25 {
        (m0, STEP * deviation)
    } else {
        (m0.round(), 1.0)
    };
    let peak = term(g, w, centre).exp();
    let mut sum = peak;
    for direction in [step, -step] {
        let mut m = centre + direction;
        while m > 0.5 {
            let t = term(g, w, m).exp();
            sum += t;
            // the rest falls faster than a Gaussian there
            if t <= NEGLIGIBLE * peak {
                break;
            }
            m += direction;
        }
    }
    sum * step
}

/// ln of the term, continued to any m > 0 by Stirling's series, which at the smallest m that carries weight
/// errs by 1/(1260 m^5) [Abramowitz1964, 6.1.41]; written so that large g and m do not cancel.
#[inline]
fn term(g: f64, w: f64, m: f64) -> f64 {
    let inv = 1.0 / m;
    let stirling = inv * (1.0 / 12.0 - inv * inv / 360.0);
    // ln(1 + x) where m is close to g, for the digits; x is exact there
    let ratio = if (m - g).abs() < 0.1 * g {
        -((m - g) / g).ln_1p()
    } else {
        (g / m).ln()
    };
    m * ratio + (m - g) - 0.5 * (TAU * m).ln() - stirling - m.ln() - w * inv
}

#[cfg(test)]
mod tests {
    use super::series;

    /// ln of the sum, term by term over all that matter, for a reference with an error of 1e-9.
    ///
    /// All terms are positive, so that nothing cancels. Ratios of neighbours are rational up to one exponential,
    /// t_{m+1}/t_m = g m/(m+1)^2 exp(w/(m (m+1))), and are accumulated in logarithms from the largest term on
    /// both sides; its own logarithm comes from ln m!, summed up for small m and by five terms of Stirling's series
    /// beyond. Rounding: 1e-16 of the largest logarithm, 1e7, times the root of the number of terms.
    fn ln_series(g: f64, w: f64) -> f64 {
        let ln_factorial = |m: f64| {
            if m < 100.0 {
                (2..=m as u32).map(|k| f64::from(k).ln()).sum()
            } else {
                let (i, i2) = (1.0 / m, 1.0 / (m * m));
                (m + 0.5) * m.ln() - m
                    + 0.5 * std::f64::consts::TAU.ln()
                    + i * (1.0 / 12.0 - i2 * (1.0 / 360.0 - i2 * (1.0 / 1260.0 - i2 / 1680.0)))
            }
        };
        let ln_term = |m: f64| m * g.ln() - g - ln_factorial(m) - m.ln() - w / m;
        let rise = |m: f64| (g * m / ((m + 1.0) * (m + 1.0))).ln() + w / (m * (m + 1.0));
        // the terms rise up to the mode and fall beyond: bisect
        let (mut low, mut high) = (1.0_f64, 10.0 * (g + w.sqrt() + 10.0));
        while high - low > 0.5 {
            let middle = (0.5 * (low + high)).floor();
            if rise(middle) > 0.0 {
                low = middle + 1.0;
            } else {
                high = middle;
            }
        }
        let mode = low.max(1.0).floor();
        let (mut sum, mut ln) = (1.0, 0.0);
        let mut m = mode;
        while ln > -40.0 {
            ln += rise(m);
            m += 1.0;
            sum += f64::exp(ln);
        }
        let (mut m, mut ln) = (mode, 0.0);
        while ln > -40.0 && m > 1.0 {
            m -= 1.0;
            ln -= rise(m);
            sum += f64::exp(ln);
        }
        ln_term(mode) + sum.ln()
    }

    /// Largest relative error over `per_decade` points a decade of g in 1e-6 ... 1e6 and w in 1e-6 ... 1e12 and 0,
    /// where the sum is above 1e-280, and where it is.
    fn worst(per_decade: i32) -> (f64, f64, f64) {
        let mut worst = (0.0, 0.0, 0.0);
        let at = |k: i32| 10_f64.powf(f64::from(k) / f64::from(per_decade));
        for i in -6 * per_decade..=6 * per_decade {
            for j in -6 * per_decade - 1..=12 * per_decade {
                let g = at(i);
                let w = if j < -6 * per_decade { 0.0 } else { at(j) };
                let ln = ln_series(g, w);
                if ln > -640.0 {
                    let error = (series(g, w).ln() - ln).exp_m1().abs();
                    if error.is_nan() || error > worst.0 {
                        worst = (error, g, w);
                    }
                }
            }
        }
        worst
    }

    #[test]
    fn matches_the_sum_over_the_stress_grid() {
        let (error, g, w) = worst(4);
        println!("series: largest relative error {error:.2e} at g = {g:e}, w = {w:e}");
        assert!(error < 2e-5, "{error:e} at g = {g:e}, w = {w:e}");
    }

    #[test]
    fn slow_matches_the_sum_on_a_fine_grid() {
        let (error, g, w) = worst(24);
        println!("series: largest relative error {error:.2e} at g = {g:e}, w = {w:e}");
        assert!(error < 2e-5, "{error:e} at g = {g:e}, w = {w:e}");
    }

    #[test]
    fn both_sides_of_the_switch_agree() {
        for w in [0.0, 1.0, 30.0, 1e3, 1e5] {
            // g at which the saddle point is 16
            let g = 16.0 * f64::exp(-w / 256.0);
            let (below, above) = (series(g * (1.0 - 1e-9), w), series(g * (1.0 + 1e-9), w));
            // the accuracy of either
            let error = (below / above - 1.0).abs();
            assert!(error < 2e-5 || below < 1e-280, "{w}: {below} {above}");
        }
    }

    #[test]
    fn no_roughness_no_scattering() {
        assert!(series(0.0, 1.0).abs() < f64::MIN_POSITIVE, "g = 0");
        for (g, w) in [(1e-300, 1e9), (1e-200, 0.0), (1e300, 0.0), (1e12, 1e30)] {
            let s = series(g, w);
            assert!((0.0..=1.0).contains(&s), "{g} {w}: {s}");
        }
    }
}
