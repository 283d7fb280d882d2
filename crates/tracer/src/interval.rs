//! Intervals about the error of a picture: what pairs of replicates say about the noise of the error estimate itself.

/// Sums over pixels of unbiased estimates from pairs of replicates x_i: V, the squared error; T, the squared truth; and
/// what both vary by.
///
/// In a pixel both are U-statistics of order two: V = U(D), D_ij = |x_i - x_j|^2 / (2 R), and T = U(G), G_ij = x_i . x_j. Two
/// terms that share no replicate are independent, so that the mean of A_ij B_kl over disjoint pairs estimates
/// E(U(A)) E(U(B)) without bias, and Cov(U(A), U(B)) = E(U(A) U(B)) - E(U(A)) E(U(B)) [Hoeffding1948]. Channels enter
/// together, so their correlation is in it; heavy tails are, as far as the replicates show them. Pixels are independent.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pairs {
    pub(crate) var_v: f64,
    pub(crate) cov: f64,
    pub(crate) var_t: f64,
    /// What `var_v` would be of normal replicates with the same variances: 2 V^2 / (R - 1), from V^2 (R + 1) / (R - 1) = E(V-hat^2).
    pub(crate) normal: f64,
    /// Sum of squares of what the pixels' `var_v` is above normal.
    pub(crate) excess: f64,
}

impl Pairs {
    /// Sum over `W` pixels of what the means of their replicates say (replicate, channel, pixel); `None` below four replicates.
    /// A pixel of zeros adds nothing.
    #[inline(always)]
    pub(crate) fn of<const N: usize, const W: usize>(means: &[[[f64; W]; N]]) -> Option<Self> {
        if means.len() < 4 {
            return None;
        }
        let moments = Moments::of(means);
        let r = moments.n;
        let (mut all, over) = (Self::default(), 1.0 / (r * r));
        for k in 0..W {
            // D lacks its 1 / R so far
            let [var_v, cov, var_t] = moments.covariances(k);
            let v = moments.a[k] / (r * (r - 1.0));
            let normal = 2.0 * v * v / (r + 1.0);
            let var_v = var_v * over;
            all.var_v += var_v;
            all.cov += cov / r;
            all.var_t += var_t;
            all.normal += normal;
            all.excess += (var_v - normal) * (var_v - normal);
        }
        Some(all)
    }

    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            var_v: self.var_v + other.var_v,
            cov: self.cov + other.cov,
            var_t: self.var_t + other.var_t,
            normal: self.normal + other.normal,
            excess: self.excess + other.excess,
        }
    }

    /// Var(V): the free estimate, never below the normal one. By itself it is as noisy as its largest pixels, and small where
    /// V is.
    pub(crate) fn spread(&self) -> f64 {
        self.var_v.max(self.normal)
    }

    /// How many degrees of freedom [`Self::spread`] has [Satterthwaite1946]. The normal part follows V; what is above or below
    /// it in each pixel is counted as one number of which nothing else is known.
    pub(crate) fn degrees(&self) -> u32 {
        let degrees = 2.0 * self.spread() * self.spread() / self.excess;
        // `as` takes what is not a number for none
        (degrees.min(1e6) as u32).max(1)
    }
}

/// Sums over replicates that all sums over pairs come down to, of a_i = |y_i|^2 and b_i = m . y_i, where m is the mean of the
/// replicates and the y_i = x_i - m sum to zero; for `W` pixels at a time.
struct Moments<const W: usize> {
    n: f64,
    a: [f64; W],
    aa: [f64; W],
    ab: [f64; W],
    bb: [f64; W],
    /// Sum over i and j of p_ij^2, p_ij = y_i . y_j: as much as the squares of all entries of sum_i y_i y_i^T.
    pp: [f64; W],
}

impl<const W: usize> Moments<W> {
    #[inline(always)]
    fn of<const N: usize>(x: &[[[f64; W]; N]]) -> Self {
        let zero = [0.0; W];
        let mut out = Self {
            n: x.len() as f64,
            a: zero,
            aa: zero,
            ab: zero,
            bb: zero,
            pp: zero,
        };
        let over = 1.0 / out.n;
        let (mut m, mut gram) = ([zero; N], [[zero; N]; N]);
        for x in x {
            for c in 0..N {
                for k in 0..W {
                    m[c][k] += x[c][k] * over;
                }
            }
        }
        for x in x {
            let (mut a, mut b, mut y) = (zero, zero, [zero; N]);
            for c in 0..N {
                for k in 0..W {
                    y[c][k] = x[c][k] - m[c][k];
                    a[k] += y[c][k] * y[c][k];
                    b[k] += m[c][k] * y[c][k];
                }
            }
            for k in 0..W {
                out.a[k] += a[k];
                out.aa[k] += a[k] * a[k];
                out.ab[k] += a[k] * b[k];
                out.bb[k] += b[k] * b[k];
            }
            for c in 0..N {
                for d in 0..=c {
                    for k in 0..W {
                        gram[c][d][k] += y[c][k] * y[d][k];
                    }
                }
            }
        }
        for c in 0..N {
            for d in 0..=c {
                // entries beside the diagonal count twice
                let times = if c == d { 1.0 } else { 2.0 };
                for k in 0..W {
                    out.pp[k] += times * gram[c][d][k] * gram[c][d][k];
                }
            }
        }
        out
    }

    /// U(A) U(B) less the mean of A_ij B_kl over disjoint pairs, for AB = DD, DG and GG.
    ///
    /// R D_ij = (a_i + a_j) / 2 - p_ij and G_ij = |m|^2 + b_i + b_j + p_ij, whose constant changes no covariance and is left
    /// out. Since sum_j p_ij = sum_j b_j = 0, every sum below is one over replicates.
    #[inline(always)]
    fn covariances(&self, k: usize) -> [f64; 3] {
        let (n, a, aa) = (self.n, self.a[k], self.aa[k]);
        let (ab, bb, pp) = (self.ab[k], self.bb[k], self.pp[k]);
        // over all pairs
        let (d, g) = (0.5 * n * a, -0.5 * a);
        let products = [d * d, d * g, g * g];
        // over pairs of pairs that share a replicate: sum_i of what D and G add up to with it
        let with = [
            0.25 * n * (n * aa + 3.0 * a * a),
            0.5 * (n * (n - 2.0) * ab - n * aa - a * a),
            (n - 2.0) * (n - 2.0) * bb - 2.0 * (n - 2.0) * ab + aa,
        ];
        // over pairs taken twice
        let same = [
            0.25 * (n * aa + a * a) + 0.5 * pp,
            0.5 * (n * ab - pp),
            (n - 2.0) * bb - 2.0 * ab + 0.5 * (pp - aa),
        ];
        let pairs = n * (n - 1.0) / 2.0;
        let apart = pairs * (n - 2.0) * (n - 3.0) / 2.0;
        let mut out = [0.0; 3];
        for f in 0..3 {
            out[f] = products[f] / (pairs * pairs) - (products[f] - with[f] + same[f]) / apart;
        }
        out
    }
}

/// Factors about an estimate of V / T that hold its expectation, for V and T that vary as chi-squares over their degrees of
/// freedom, given as `[2 / nu_V, 2 / nu_T]`, and `t` standard deviations to either side.
///
/// Cube roots of such ratios are normal with mean 1 - a and variance a, a = 2 / (9 nu) [WilsonHilferty1931], and the interval
/// of their quotient is that of Fieller, as for the F distribution [Paulson1942]. No lower end where T is hardly known.
pub(crate) fn ratio_interval([v, t]: [f64; 2], quantile: f64) -> [f64; 2] {
    let (a, b, q2) = (v / 9.0, t / 9.0, quantile * quantile);
    // F^(1/3) = y where (1 - b) y - (1 - a) is q sqrt(b y^2 + a) to either side
    let (top, middle, end) = (
        (1.0 - b) * (1.0 - b) - q2 * b,
        (1.0 - a) * (1.0 - b),
        (1.0 - a) * (1.0 - a) - q2 * a,
    );
    let root = (middle * middle - top * end).max(0.0).sqrt();
    let low = if top > 0.0 {
        (top / (middle + root)).powi(3)
    } else {
        0.0
    };
    let high = if end > 0.0 {
        ((middle + root) / end).powi(3)
    } else {
        f64::INFINITY
    };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::{Pairs, ratio_interval};

    const R: usize = 8;

    /// Mean of what pairs say about `runs` pixels, its standard error, and the variance of V and T over the pixels.
    fn simulate(runs: u32, mut draw: impl FnMut() -> [f64; 2]) -> [[f64; 3]; 3] {
        let r = R as f64;
        let (mut said, mut squares) = ([0.0; 3], [0.0; 3]);
        let (mut sums, mut products) = ([0.0; 2], [0.0; 3]);
        for _ in 0..runs {
            let x: [[f64; 2]; R] = std::array::from_fn(|_| draw());
            let pairs = Pairs::of(&x.map(|x| x.map(|v| [v]))).unwrap();
            for (k, value) in [pairs.var_v, pairs.cov, pairs.var_t]
                .into_iter()
                .enumerate()
            {
                said[k] += value;
                squares[k] += value * value;
            }
            let (mut v, mut t) = (0.0, 0.0);
            for c in 0..2 {
                let (s, q) = x
                    .iter()
                    .fold((0.0, 0.0), |(s, q), x| (s + x[c], q + x[c] * x[c]));
                v += (q - s * s / r) / (r - 1.0) / r;
                t += (s * s - q) / (r * (r - 1.0));
            }
            sums = [sums[0] + v, sums[1] + t];
            products = [
                products[0] + v * v,
                products[1] + v * t,
                products[2] + t * t,
            ];
        }
        let n = f64::from(runs);
        let [v, t] = sums.map(|s| s / n);
        let actual = [
            products[0] / n - v * v,
            products[1] / n - v * t,
            products[2] / n - t * t,
        ];
        std::array::from_fn(|k| {
            let mean = said[k] / n;
            [mean, ((squares[k] / n - mean * mean) / n).sqrt(), actual[k]]
        })
    }

    #[test]
    fn pairs_know_what_error_and_truth_vary_by() {
        // exponential values, two channels of which the second is half the first: V = U / R with
        // U = (1 + 1/4) s^2 and Var(s^2) = (m4 - m2^2 (R - 3) / (R - 1)) / R, m2 = 1, m4 = 9 [Hoeffding1948]
        let mut rng = sampling::Rng::new(5);
        let found = simulate(200_000, || {
            let x = -(1.0 - rng.uniform()).ln();
            [x, 0.5 * x]
        });
        let r = R as f64;
        let exact = 1.25 * 1.25 * (9.0 - (r - 3.0) / (r - 1.0)) / r / (r * r);
        let [mean, error, _] = found[0];
        // 4 standard errors of a skewed mean, and an error bar that can tell 1 from 1.1
        assert!(
            (mean - exact).abs() < 4.0 * error,
            "{mean} +- {error}, exact {exact}"
        );
        assert!(error < 0.02 * exact, "{error} of {exact}");
        for [mean, error, actual] in found {
            // the actual one is known as well as the mean of what is said, or somewhat worse
            assert!(
                (mean - actual).abs() < 6.0 * error,
                "{mean} +- {error}, {actual}"
            );
            assert!(error < 0.02 * actual.abs(), "{error} of {actual}");
        }
    }

    /// Var(V), Cov(V, T), Var(T) by the definition: sums over pairs of pairs.
    fn by_pairs(x: &[[f64; 3]]) -> [f64; 3] {
        let r = x.len();
        let pairs: Vec<(usize, usize)> = (0..r)
            .flat_map(|i| (i + 1..r).map(move |j| (i, j)))
            .collect();
        let terms = |i: usize, j: usize| {
            let (mut d, mut g) = (0.0, 0.0);
            for (a, b) in x[i].iter().zip(&x[j]) {
                d += (a - b) * (a - b) / (2.0 * r as f64);
                g += a * b;
            }
            [d, g]
        };
        [[0, 0], [0, 1], [1, 1]].map(|[a, b]| {
            let mean = |f: usize| pairs.iter().map(|&(i, j)| terms(i, j)[f]).sum::<f64>();
            let (mut apart, mut number) = (0.0, 0.0);
            for &(i, j) in &pairs {
                for &(k, l) in &pairs {
                    if ![k, l].contains(&i) && ![k, l].contains(&j) {
                        apart += terms(i, j)[a] * terms(k, l)[b];
                        number += 1.0;
                    }
                }
            }
            let all = pairs.len() as f64;
            mean(a) * mean(b) / (all * all) - apart / number
        })
    }

    #[test]
    fn sums_over_replicates_are_those_over_pairs() {
        let mut rng = sampling::Rng::new(9);
        for r in [4, 5, 8] {
            let x: Vec<[f64; 3]> = (0..r)
                .map(|_| std::array::from_fn(|c| c as f64 + rng.uniform()))
                .collect();
            // a pixel of zeros beside it
            let lanes: Vec<_> = x.iter().map(|x| x.map(|v| [0.0, v])).collect();
            let found = Pairs::of(&lanes).unwrap();
            let found = [found.var_v, found.cov, found.var_t];
            for (found, expected) in found.into_iter().zip(by_pairs(&x)) {
                // of terms of size 1 to 100
                assert!(
                    (found - expected).abs() < 1e-11,
                    "{found} of {r}, by pairs {expected}"
                );
            }
        }
    }

    #[test]
    fn three_replicates_say_nothing() {
        assert!(Pairs::of(&[[[1.0]], [[2.0]], [[4.0]]]).is_none());
    }

    #[test]
    fn factors_of_printed_quantiles() {
        let [low, high] = ratio_interval([2.0 / 10.0, 0.0], 1.959_964);
        // chi-square with 10 degrees: 3.247 and 20.483 [Abramowitz1964, table 26.8]; the approximation errs by 1 %
        assert!((10.0 / high - 3.247).abs() < 0.03, "lower {high}");
        assert!((10.0 / low - 20.483).abs() < 0.02, "upper {low}");
        // F with 10 and 20 degrees: 2.774 at 97.5 %, and 1 / 3.419 at 2.5 % [Abramowitz1964, table 26.9]
        let [low, high] = ratio_interval([2.0 / 10.0, 2.0 / 20.0], 1.959_964);
        assert!((1.0 / low - 2.774).abs() < 0.03, "upper {low}");
        assert!((high - 3.419).abs() < 0.05, "lower {high}");
        let [low, high] = ratio_interval([0.2, 5.0], 1.96);
        assert!(low.abs() < 1e-12 && high > 5.0, "T unknown: {low} {high}");
        assert!(
            ratio_interval([2.0, 0.0], 1.96)[1].is_infinite(),
            "one degree"
        );
    }
}
