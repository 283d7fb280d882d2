//! What the replicates say about the error of the picture.

use crate::film::Film;

/// A picture with the error it knows of itself.
///
/// All errors are those of the mean of everything the film holds. They are exact in expectation for independent
/// replicates; intervals rest on replicate means being nearly normal [`LEcuyer2023`].
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
    /// sqrt(sum of squared errors / sum of squared values).
    pub rel_rmse: f64,
    /// Interval that holds the true `rel_rmse` with the confidence asked for.
    pub rel_rmse_ci: [f64; 2],
}

impl<const N: usize> Film<N> {
    /// The picture and its error; `confidence` in (0, 1) is that of the interval.
    #[must_use]
    pub fn estimate(&self, confidence: f64) -> Estimate<N> {
        let pixels = self.map(([0.0; N], [f64::INFINITY; N]), |tile, sums| {
            mean_and_variance(sums, |r| tile.samples_of(r))
        });
        let replicates = self.replicates().min(self.spp());
        let (mean, variance): (Vec<_>, Vec<_>) = pixels.into_iter().unzip();
        let (mut square, mut error, mut spread) = (0.0, 0.0, 0.0);
        for (m, v) in mean.iter().zip(&variance) {
            let pixel: f64 = v.iter().sum();
            square += m.iter().map(|x| x * x).sum::<f64>();
            error += pixel;
            spread += pixel * pixel;
        }
        // Var(V) = 2 V^2 / d of a variance with d degrees of freedom, and E(V-hat^2) = V^2 (d + 2) / d;
        // channels of a pixel err together
        let degrees = f64::from(replicates.saturating_sub(1));
        let effective = if spread > 0.0 {
            error * error * (degrees + 2.0) / spread
        } else {
            f64::INFINITY
        };
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
        let tail = 0.5 * (1.0 - confidence);
        let ratio = |p: f64| chi_square_ratio(effective, p);
        Estimate {
            rmse: (error / (mean.len() * N).max(1) as f64).sqrt(),
            rel_rmse: rel(error),
            rel_rmse_ci: if replicates < 2 {
                [0.0, f64::INFINITY]
            } else {
                [rel(error / ratio(1.0 - tail)), rel(error / ratio(tail))]
            },
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
