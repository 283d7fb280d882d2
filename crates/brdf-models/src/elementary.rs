//! Exponential, logarithm and erfc in f64 without branches or calls, so that loops over them become vector code.

/// 1/k! [Abramowitz1964, 4.2.1].
const RECIPROCAL_FACTORIAL: [f64; 14] = {
    let (mut table, mut k, mut factorial) = ([1.0; 14], 1, 1.0);
    while k < 14 {
        factorial *= k as f64;
        table[k] = 1.0 / factorial;
        k += 1;
    }
    table
};

/// ln 2 in two parts: multiples of the first are exact up to a thousand.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// Adding it rounds to a whole number, which then stands in the low bits: 1.5 * 2^52.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// sum of `c`_k x^k, at least four terms: Horner's scheme in x^4, four chains side by side so that none waits for long.
#[inline(always)]
pub(crate) fn polynomial(c: &[f64], x: f64) -> f64 {
    let x2 = x * x;
    let x4 = x2 * x2;
    let rest = c.len() - 4;
    let mut p = [c[rest], c[rest + 1], c[rest + 2], c[rest + 3]];
    // the chain that was advanced last begins with the lowest power
    let mut first = 0;
    for k in (0..rest).rev() {
        first = (first + 3) % 4;
        p[first] = p[first] * x4 + c[k];
    }
    let at = |j: usize| p[(first + j) % 4];
    (at(0) + at(1) * x) + (at(2) + at(3) * x) * x2
}

/// e^x for x < 709 by Taylor's polynomial of this degree on |r| <= ln 2 / 2, at most r^(d+1)/(d+1)!/sqrt(1/2): 4e-7 for degree 6,
/// rounding for 13; 0 below -700.
#[inline(always)]
pub(crate) fn exp<const DEGREE: usize>(x: f64) -> f64 {
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let whole = shifted - ROUND;
    let mut r = x - whole * LN_2[0];
    if DEGREE > 6 {
        r -= whole * LN_2[1];
    }
    let p = polynomial(&RECIPROCAL_FACTORIAL[..=DEGREE], r);
    let power = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    // below, the power is not one
    if x < -700.0 { 0.0 } else { p * power }
}

/// ln x for normal x > 0, to two units in the last place.
#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    ln_ratio(x, 1.0)
}

/// ln(a/b) for normal a, b and a/b > 0, to two units in the last place: where a is close to b their difference is exact, and
/// so are the digits of its logarithm. With a/b = 2^k f, f from sqrt(1/2) to sqrt 2, by Sun's polynomial in
/// s = (f - 1)/(f + 1) [Fdlibm1993].
#[inline(always)]
pub(crate) fn ln_ratio(a: f64, b: f64) -> f64 {
    /// Bits of sqrt(1/2), rounded down to 32 of them.
    const ROOT: u64 = 0x3fe6_a09e << 32;
    const R: [f64; 7] = [
        6.666_666_666_666_735e-1,
        3.999_999_999_940_942e-1,
        2.857_142_874_366_239e-1,
        2.222_219_843_214_978_4e-1,
        1.818_357_216_161_805e-1,
        1.531_383_769_920_937_3e-1,
        1.479_819_860_511_658_6e-1,
    ];
    let offset = (a / b).to_bits().wrapping_sub(ROOT);
    // k in two's complement
    #[expect(
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss,
        reason = "shifts the sign in, and back"
    )]
    let exponent = ((offset as i64) >> 52) as u64;
    let k = f64::from_bits(exponent.wrapping_add(ROUND.to_bits())) - ROUND;
    let b = b * f64::from_bits(exponent.wrapping_add(1023) << 52);
    let s = (a - b) / (a + b);
    let z = s * s;
    let r = polynomial(&R, z);
    k * LN_2[0] + (2.0 * s + (s * z * r + k * LN_2[1]))
}

/// e^(-q^2) and erfc(q) for q >= 0 to 1e-13 relative; from 6 on those of 6, which are 2e-16 and 2e-17.
#[inline(always)]
pub(crate) fn gauss_and_erfc(q: f64) -> [f64; 2] {
    /// erfc(q) e^(q^2) on [0, 6] as a ratio of polynomials through 18 Chebyshev points; errs by 9e-14.
    const NUMERATOR: [f64; 9] = [
        1.0000000000000896,
        1.976486119435887,
        1.9357363123938992,
        1.1918148184017359,
        0.49898832326397789,
        0.14494930350678244,
        0.028582002515762054,
        0.0035241186706345932,
        0.00021152989024710857,
    ];
    const DENOMINATOR: [f64; 10] = [
        1.0,
        3.1048652865413599,
        4.4392016181601592,
        3.8483049362364897,
        2.2377773514997887,
        0.90957596227235509,
        0.26003915149827144,
        0.050847742469309407,
        0.0062463377506736612,
        0.00037492696797073936,
    ];
    let q = q.min(6.0);
    let gauss = exp::<13>(-q * q);
    let scaled = polynomial(&NUMERATOR, q) / polynomial(&DENOMINATOR, q);
    [gauss, gauss * scaled]
}

#[cfg(test)]
mod tests {
    use super::{exp, gauss_and_erfc, ln};
    use testkit::assert_relative;

    #[test]
    fn exponentials_to_the_accuracy_of_their_degree() {
        for k in -70_000..=700 {
            let x = f64::from(k) * 0.01;
            let expected = if x < -700.0 { 0.0 } else { x.exp() };
            assert_relative(
                exp::<13>(x),
                expected,
                4e-16,
                "rounding of the last three steps",
            );
            assert_relative(
                exp::<6>(x),
                expected,
                4e-7,
                "r^7/7! and the second part of ln 2",
            );
        }
        assert!(
            exp::<6>(f64::NEG_INFINITY) + exp::<13>(-701.0) <= 0.0,
            "nothing is left"
        );
    }

    #[test]
    fn logarithms_to_rounding() {
        for k in -3000..=3000 {
            let x = 10_f64.powf(f64::from(k) * 0.1) * 1.234_567;
            assert_relative(ln(x), x.ln(), 4.5e-16, "ln");
            let near = 1.0 + f64::from(k) * 1e-7;
            assert_relative(ln(near), near.ln(), 4.5e-16, "ln next to 1");
        }
    }

    #[test]
    fn erfc_from_its_middle_to_its_tail() {
        for k in 0..=6000 {
            let q = f64::from(k) * 1e-3;
            let [gauss, erfc] = gauss_and_erfc(q);
            // rounding of q^2 in the exponent: 36 ulp
            assert_relative(gauss, (-q * q).exp(), 1e-14, "e^(-q^2)");
            assert_relative(erfc, libm::erfc(q), 1.2e-13, "erfc");
        }
        assert!(gauss_and_erfc(f64::INFINITY)[1] < 3e-17, "at the zenith");
    }
}
