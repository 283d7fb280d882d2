//! What the replicates say about the error of the picture.

use crate::film::Film;

/// A picture with the error it knows of itself.
///
/// All errors are those of the mean of everything the film holds: what the same render with another seed would err by,
/// in the root mean square. They are exact in expectation for independent replicates.
#[derive(Clone, Debug)]
pub struct Estimate<const N: usize> {
    /// The picture, row after row from the top.
    pub mean: Vec<[f64; N]>,
    /// Variance of each mean; infinite where fewer than two replicates have samples.
    pub variance: Vec<[f64; N]>,
    /// Replicates less one: the degrees of freedom of each variance.
    pub degrees: u32,
    /// sqrt(mean over pixels and channels of the squared error).
    pub rmse: f64,
    /// Interval that holds the expected `rmse` with the confidence asked for.
    pub rmse_ci: [f64; 2],
    /// sqrt(sum of squared errors / sum of squared values).
    pub rel_rmse: f64,
    /// Interval that holds the expected `rel_rmse` with the confidence asked for.
    pub rel_rmse_ci: [f64; 2],
    /// 2 V^2 / Var(V) of the summed variance V: the degrees of freedom of the chi-square the intervals rest on.
    pub effective_degrees: f64,
}

impl<const N: usize> Film<N> {
    /// The picture and its error; `confidence` in (0, 1) is that of the intervals.
    #[must_use]
    pub fn estimate(&self, confidence: f64) -> Estimate<N> {
        let empty = ([0.0; N], [f64::INFINITY; N], f64::INFINITY);
        let pixels = self.map(empty, |tile, sums| {
            let count = |r| tile.samples_of(r);
            let (mean, variance) = mean_and_variance(sums, count);
            (mean, variance, variance_of_variance(sums, count))
        });
        let replicates = self.replicates().min(self.spp());
        let (mut square, mut error, mut spread, mut normal) = (0.0, 0.0, 0.0, 0.0);
        let degrees = f64::from(replicates.saturating_sub(1));
        let (mut mean, mut variance) = (Vec::new(), Vec::new());
        for (m, v, s) in pixels {
            square += m.iter().map(|x| x * x).sum::<f64>();
            let sum = v.iter().sum::<f64>();
            error += sum;
            spread += s;
            // Var(V) = 2 V^2 / d of normal values, and E(V-hat^2) = V^2 (d + 2) / d; channels of a pixel err together
            normal += 2.0 * sum * sum / (degrees + 2.0);
            mean.push(m);
            variance.push(v);
        }
        // the free estimate is itself as noisy as its largest pixels, and small where V is: never below the normal one
        let effective = effective_degrees(error, spread.max(normal), replicates, mean.len() * N);
        // E(mean^2) = truth^2 + variance
        let rel = |error: f64| {
            let truth = square - error;
            if error.abs() == 0.0 {
                0.0
            } else if truth > 0.0 && error.is_finite() {
                (error / truth).sqrt()
            } else {
                f64::INFINITY
            }
        };
        let rmse = |error: f64| (error / (mean.len() * N).max(1) as f64).sqrt();
        let tail = 0.5 * (1.0 - confidence);
        let [low, high] = [1.0 - tail, tail].map(|p| error / chi_square_ratio(effective, p));
        let known = replicates >= 2;
        let interval = |of: &dyn Fn(f64) -> f64| {
            if known {
                [of(low), of(high)]
            } else {
                [0.0, f64::INFINITY]
            }
        };
        Estimate {
            rmse: rmse(error),
            rmse_ci: interval(&rmse),
            rel_rmse: rel(error),
            rel_rmse_ci: interval(&rel),
            effective_degrees: effective,
            mean,
            variance,
            degrees: replicates.saturating_sub(1),
        }
    }
}

impl<const N: usize> Estimate<N> {
    /// Half the width of the interval about a channel of a pixel that holds the truth with `confidence`: Student's t.
    #[must_use]
    pub fn half_width(&self, pixel: usize, channel: usize, confidence: f64) -> f64 {
        let variance = self.variance.get(pixel).and_then(|v| v.get(channel));
        sampling::student_quantile(confidence, self.degrees)
            * variance.map_or(f64::INFINITY, |v| v.sqrt())
    }
}

/// Mean of all samples and its variance, from sums by replicate. Replicates count by their samples, so that it holds
/// for any number of samples.
fn mean_and_variance<const N: usize>(
    sums: &[[f64; N]],
    count: impl Fn(u32) -> u32,
) -> ([f64; N], [f64; N]) {
    let (mut total, mut samples, mut used) = ([0.0; N], 0.0, 0.0);
    for (r, sum) in (0..).zip(sums) {
        samples += f64::from(count(r));
        used += if count(r) > 0 { 1.0 } else { 0.0 };
        for c in 0..N {
            total[c] += sum[c];
        }
    }
    if samples < 1.0 {
        return ([0.0; N], [f64::INFINITY; N]);
    }
    let mean = total.map(|t| t / samples);
    if used < 2.0 {
        return (mean, [f64::INFINITY; N]);
    }
    let mut variance = [0.0; N];
    for (r, sum) in (0..).zip(sums) {
        let n = f64::from(count(r));
        for c in 0..N {
            let off = if n > 0.0 { sum[c] / n - mean[c] } else { 0.0 };
            variance[c] += n * off * off / ((used - 1.0) * samples);
        }
    }
    (mean, variance)
}

/// Variance of the summed variance of one pixel's channels, estimated without bias whatever the distribution.
///
/// The summed variance is a U-statistic of order two, U = mean over pairs of D_ij with D_ij = |x_i - x_j|^2 / 2, over R
/// replicates. Two of its terms that share no replicate are independent, so that the mean of D_ij D_kl over disjoint
/// pairs estimates E(U)^2 without bias, and Var(U) = E(U^2) - E(U)^2 [Hoeffding1948]. Channels enter together, so their
/// correlation is in D; heavy tails are, as far as the replicates show them. Infinite below four replicates.
fn variance_of_variance<const N: usize>(sums: &[[f64; N]], count: impl Fn(u32) -> u32) -> f64 {
    let mut means = Vec::with_capacity(sums.len());
    for (r, sum) in (0..).zip(sums) {
        if count(r) > 0 {
            means.push(sum.map(|s| s / f64::from(count(r))));
        }
    }
    let n = means.len() as f64;
    if means.len() < 4 {
        return f64::INFINITY;
    }
    // S = sum D, T_i = sum_j D_ij, Q = sum D^2
    let (mut s, mut q, mut t) = (0.0, 0.0, vec![0.0; means.len()]);
    for (i, x) in means.iter().enumerate() {
        for (j, y) in means.iter().enumerate().skip(i + 1) {
            let d = x.iter().zip(y).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / 2.0;
            s += d;
            q += d * d;
            t[i] += d;
            t[j] += d;
        }
    }
    let shared: f64 = t.iter().map(|t| t * t).sum();
    let pairs = n * (n - 1.0) / 2.0;
    let disjoint = (s * s - shared + q) / (pairs * (n - 2.0) * (n - 3.0) / 2.0);
    let u = s / pairs;
    // V = U / R
    (u * u - disjoint) / (n * n)
}

/// Degrees of freedom of the chi-square with the mean `error` and the variance `spread` [Satterthwaite1946], kept
/// between those of one normal value and of as many as there are: what an unlucky estimate of `spread` could leave.
fn effective_degrees(error: f64, spread: f64, replicates: u32, values: usize) -> f64 {
    let one = f64::from(replicates.saturating_sub(1)).max(1.0);
    let most = one * values as f64;
    let degrees = 2.0 * error * error / spread;
    if spread > 0.0 && degrees.is_finite() {
        degrees.clamp(1.0, most.max(1.0))
    } else if spread > 0.0 {
        // fewer than four replicates: normal values, channels that err together
        one
    } else {
        most
    }
}

/// Quantile `p` of chi-square over its degrees of freedom [WilsonHilferty1931].
fn chi_square_ratio(degrees: f64, p: f64) -> f64 {
    let a = 2.0 / (9.0 * degrees);
    (1.0 - a + normal_quantile(p) * a.sqrt()).max(1e-3).powi(3)
}

/// Quantile of the normal distribution, absolute error below 5e-4 [Abramowitz1964, 26.2.23].
fn normal_quantile(p: f64) -> f64 {
    let q = p.min(1.0 - p).max(1e-300);
    let t = (-2.0 * q.ln()).sqrt();
    let x = t
        - ((0.010328 * t + 0.802853) * t + 2.515517)
            / (((0.001308 * t + 0.189269) * t + 1.432788) * t + 1.0);
    if p < 0.5 { -x } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_variance_of_even_replicates_are_the_textbook_ones() {
        let (mean, variance) = mean_and_variance(&[[2.0], [4.0], [6.0], [8.0]], |_| 2);
        assert!((mean[0] - 2.5).abs() < 1e-12, "mean of 1, 2, 3, 4");
        assert!((variance[0] - 5.0 / 3.0 / 4.0).abs() < 1e-12, "s^2 / R");
    }

    #[test]
    fn uneven_replicates_keep_the_mean() {
        let (mean, variance) = mean_and_variance(&[[3.0], [1.0], [0.0]], |r| [3, 1, 0][r as usize]);
        assert!((mean[0] - 1.0).abs() < 1e-12, "mean of four ones");
        assert!(variance[0].abs() < 1e-12, "which do not differ");
    }

    #[test]
    fn one_replicate_claims_nothing() {
        let (_, variance) = mean_and_variance(&[[3.0], [0.0]], |r| 1 - r);
        assert!(variance[0].is_infinite(), "infinite variance");
    }

    #[test]
    fn variance_of_variance_is_unbiased_for_skewed_values_that_err_together() {
        // exponential values, two channels of which the second is half the first: V = U / R with
        // U = (1 + 1/4) s^2 and Var(s^2) = (m4 - m2^2 (R - 3) / (R - 1)) / R, m2 = 1, m4 = 9 [Hoeffding1948]
        const R: usize = 8;
        let mut rng = sampling::Rng::new(5);
        let runs = 200_000;
        let (mut sum, mut square) = (0.0, 0.0);
        for _ in 0..runs {
            let sums: [[f64; 2]; R] = std::array::from_fn(|_| {
                let x = -(1.0 - rng.uniform()).ln();
                [x, 0.5 * x]
            });
            let v = variance_of_variance(&sums, |_| 1);
            sum += v;
            square += v * v;
        }
        let n = f64::from(runs);
        let mean = sum / n;
        let error = ((square / n - mean * mean) / n).sqrt();
        let r = R as f64;
        let exact = 1.25 * 1.25 * (9.0 - (r - 3.0) / (r - 1.0)) / r / (r * r);
        // 4 standard errors of a skewed mean, and an error bar that can tell 1 from 1.1
        assert!(
            (mean - exact).abs() < 4.0 * error,
            "{mean} +- {error}, exact {exact}"
        );
        assert!(error < 0.02 * exact, "{error} of {exact}");
    }

    #[test]
    fn printed_quantiles() {
        assert!(
            (normal_quantile(0.975) - 1.959964).abs() < 5e-4,
            "upper 2.5 %"
        );
        // chi-square with 10 degrees: 3.247 and 20.483 [Abramowitz1964, table 26.8]; the approximation errs by 1 %
        assert!(
            (10.0 * chi_square_ratio(10.0, 0.025) - 3.247).abs() < 0.03,
            "lower"
        );
        assert!(
            (10.0 * chi_square_ratio(10.0, 0.975) - 20.483).abs() < 0.02,
            "upper"
        );
    }
}
