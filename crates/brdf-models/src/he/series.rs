//! The series of the directional-diffuse part of [He1991], at the same cost for every roughness.
//!
//! Everything is written for several channels side by side, without branches where it costs, so that it becomes vector
//! code.

use super::lambert_w;
use crate::elementary::{exp, ln, ln_ratio};

/// From this largest term on the sum is taken as an integral, by its saddle point. There the expansion errs by 2e-5, and
/// the lower end, where the summand is e^-22 of its peak, by less.
const FROM_SADDLE: f64 = 22.0;
/// Least deviation of a summand that is nearly a Gaussian: its sum and its integral differ by 2 exp(-2 pi^2 0.9^2) = 2e-7
/// [Trefethen2014].
const WIDE: f64 = 0.9;
/// Terms summed together; with fewer the compiler unrolls their loop in place of making it vector code.
const WIDTH: usize = 16;
/// Chunks of [`WIDTH`] terms, at most: all of a sum whose largest term is [`FROM_SADDLE`].
const CHUNKS: usize = 3;
/// Where the largest term may be at most for 16 and 32 terms to leave out less than 2e-6 of the sum; for w > 0 it is
/// less still.
const REACH: [Place; CHUNKS - 1] = [
    Place::new(4.7, 1.547_562_508_716_013),
    Place::new(13.5, 2.602_689_685_444_384),
];
/// Where sums turn into integrals.
const SWITCH: Place = Place::new(FROM_SADDLE, 3.091_042_453_358_316);
/// Below, every term but the first of a sum above 1e-290 is nothing.
const LEAST_G: f64 = 1e-140;
/// Channels computed together; with fewer the compiler unrolls in place of making vector code.
pub(super) const SIDE: usize = 8;

/// A place among the terms.
struct Place {
    square: f64,
    ln: f64,
}

impl Place {
    const fn new(m: f64, ln: f64) -> Self {
        Self { square: m * m, ln }
    }

    /// Whether the largest term is beyond: it is where ln(g/m) + w/m^2 = 0, which falls with m.
    #[inline(always)]
    fn is_passed(&self, ln_g: f64, w: f64) -> bool {
        w > self.square * (self.ln - ln_g)
    }
}

/// sum over m >= 1 of e^-g g^m / (m! m) e^(-w/m) of every channel, for g >= 0 and w >= 0, to 2e-5 relative.
///
/// Where the sum itself is below 1e-290, 0 is returned.
#[inline(always)]
pub(super) fn series(g: &[f64; SIDE], w: &[f64; SIDE]) -> [f64; SIDE] {
    let mut ln_g = [0.0; SIDE];
    let (mut near, mut more) = ([false; SIDE], [false; CHUNKS - 1]);
    for k in 0..SIDE {
        ln_g[k] = ln(g[k].max(f64::MIN_POSITIVE));
        near[k] = !SWITCH.is_passed(ln_g[k], w[k]) | (g[k] <= LEAST_G);
    }
    let mut out = [0.0; SIDE];
    if near.contains(&false) {
        let wide;
        (out, wide) = saddles(g, w);
        for k in 0..SIDE {
            near[k] |= !wide[k];
        }
    }
    // channels are much alike: all take as many terms as one of them needs
    for (more, place) in more.iter_mut().zip(&REACH) {
        for k in 0..SIDE {
            *more |= near[k] & (g[k] > 0.0) & place.is_passed(ln_g[k], w[k]);
        }
    }
    let chunks = 1 + more.iter().filter(|more| **more).count();
    for k in 0..SIDE {
        if near[k] {
            out[k] = if g[k] > 0.0 {
                direct([g[k], ln_g[k], w[k]], chunks)
            } else {
                0.0
            };
        }
    }
    out
}

/// The terms that matter, each an exponential of its logarithm.
#[inline(always)]
fn direct([g, ln_g, w]: [f64; 3], chunks: usize) -> f64 {
    let mut sums = [0.0; WIDTH];
    for ([m, reciprocal], ln_factorial) in M.iter().zip(&LN_FACTORIAL_M).take(chunks) {
        for k in 0..WIDTH {
            sums[k] += exp::<6>(m[k] * ln_g - g - ln_factorial[k] - w * reciprocal[k]);
        }
    }
    // in halves, so that few additions wait for each other
    for half in [8, 4, 2, 1] {
        for k in 0..half {
            sums[k] += sums[k + half];
        }
    }
    sums[0]
}

/// The sums as integrals, and whether they may be taken so: whether the summand is wider than [`WIDE`].
///
/// One that is narrower and has its peak beyond [`FROM_SADDLE`] is e^-500 of what it would be for w = 0 there, and above
/// 1e-290 only if the peak is below 27.
#[inline(always)]
fn saddles(g: &[f64; SIDE], w: &[f64; SIDE]) -> ([f64; SIDE], [bool; SIDE]) {
    let (mut out, mut wide) = ([0.0; SIDE], [false; SIDE]);
    for k in 0..SIDE {
        // m0 = g exp(W(y)/2) = g sqrt(y/W(y)), y = 2w/g^2; the least y moves it by 5e-7
        let y = (2.0 * (w[k] / g[k]) / g[k]).clamp(1e-6, 1e300);
        let m0 = g[k] * (y / lambert_w::rough(ln(1.0 + y))).sqrt();
        let variance = m0 / (1.0 + 2.0 * (w[k] / m0) / m0);
        wide[k] = variance > WIDE * WIDE;
        out[k] = saddle(g[k], w[k], m0);
    }
    (out, wide)
}

/// The sum as an integral over m of e^h(m), h the logarithm of the term by Stirling's formula, by Laplace's method about
/// the saddle point to second order in 1/m [Bender1999, 6.4]; `m` is near it.
#[inline(always)]
fn saddle(g: f64, w: f64, m: f64) -> f64 {
    // Stirling's 1/(12 m) adds to w/m
    let v = w + 1.0 / 12.0;
    let i = 1.0 / m;
    // h', m h'' and m^2 h'''
    let (h1, h2, h3) = (
        ln_ratio(g, m) + i * (-1.5 + i * v),
        -1.0 + i * (1.5 - 2.0 * i * v),
        1.0 + i * (-3.0 + 6.0 * i * v),
    );
    // Halley's step for h' = 0
    let m = m * (1.0 - 2.0 * h1 * h2 / (2.0 * h2 * h2 - h1 * h3));
    let i = 1.0 / m;
    let iv = i * v;
    let ratio = ln_ratio(g, m);
    let h1 = ratio + i * (-1.5 + iv);
    let s2 = m / (1.0 + i * (-1.5 + 2.0 * iv));
    // derivatives of h times powers of the deviation: i h2 s^2 = -1
    let t = s2 * i;
    let (r, t2) = (t * s2.sqrt(), t * t);
    let a3 = i * r * (1.0 + i * (-3.0 + 6.0 * iv));
    let a4 = i * t2 * (-2.0 + i * (9.0 - 24.0 * iv));
    let a5 = i * i * t * r * (6.0 + i * (-36.0 + 120.0 * iv));
    let a6 = i * i * t2 * t * (-24.0 + i * (180.0 - 720.0 * iv));
    let a33 = a3 * a3;
    let first = a4 / 8.0 + 5.0 / 24.0 * a33;
    let second = a6 / 48.0
        + 7.0 / 48.0 * a3 * a5
        + 35.0 / 384.0 * a4 * a4
        + a33 * (35.0 / 64.0 * a4 + 385.0 / 1152.0 * a33);
    // what the last step left of h'
    let left = h1 * s2.sqrt();
    let exponent = m * ratio + (m - g) - w * i - i / 12.0 + 0.5 * left * left;
    exp::<13>(exponent) * i * t.sqrt() * (1.0 + first + second + 0.5 * left * a3)
}

/// m and 1/m at m - 1.
const M: [[[f64; WIDTH]; 2]; CHUNKS] = {
    let mut table = [[[0.0; WIDTH]; 2]; CHUNKS];
    let mut k = 0;
    while k < WIDTH * CHUNKS {
        let m = (k + 1) as f64;
        table[k / WIDTH][0][k % WIDTH] = m;
        table[k / WIDTH][1][k % WIDTH] = 1.0 / m;
        k += 1;
    }
    table
};

/// ln(m! m) at m - 1.
const LN_FACTORIAL_M: [[f64; WIDTH]; CHUNKS] = [
    [
        0.0,
        1.3862943611198906,
        2.8903717578961645,
        4.564348191467836,
        6.396929655216146,
        8.371010681238156,
        10.471071510120728,
        12.684044444425085,
        14.999052057417689,
        17.40699766606956,
        19.900203118672255,
        22.472121145449886,
        25.11711321058496,
        27.83027851235394,
        30.6073215849431,
        33.44444882832045,
    ],
    [
        36.3382867941931,
        39.28581696592922,
        42.28432316636594,
        45.331348734307475,
        48.42466133620033,
        51.56222380519354,
        54.74216978369353,
        57.96278322846027,
        61.222481047848724,
        64.51979829902348,
        67.85337549301066,
        71.22194764735674,
        74.62433479715449,
        78.05943373049232,
        81.52621075780046,
        85.02369535891476,
    ],
    [
        88.550974579048,
        92.10718806681383,
        95.6915236651765,
        99.30321348059931,
        102.94153036743165,
        106.60578477424019,
        110.29532190677311,
        114.00951916887134,
        117.74778384816601,
        121.50955101802845,
        125.2942816311322,
        129.10146078327514,
        132.93059612889755,
        136.7812164321054,
        140.65287023903642,
        144.54512465914215,
    ],
];

#[cfg(test)]
mod tests {
    use super::{FROM_SADDLE, SIDE};

    fn series(g: f64, w: f64) -> f64 {
        super::series(&[g; SIDE], &[w; SIDE])[0]
    }

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
            // g at which the largest term is FROM_SADDLE
            let g = FROM_SADDLE * f64::exp(-w / (FROM_SADDLE * FROM_SADDLE));
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
