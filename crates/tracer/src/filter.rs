//! Reconstruction filters, importance-sampled [Ernst2006]: every sample of a pixel counts alike.

use crate::math::F;

/// How the samples of a pixel are spread around its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PixelFilter {
    /// Even over the pixel.
    Box,
    /// A Gaussian, cut off at `radius`.
    Gaussian {
        /// Standard deviation in pixels, positive.
        sigma: f32,
        /// Where it ends, in pixels, positive; about 3 sigma.
        radius: f32,
    },
}

/// Entries of the table of quantiles.
const TABLE: usize = 1024;

/// The filter, ready to be sampled.
#[derive(Clone, Debug)]
pub(crate) enum Sampler {
    Box,
    /// Quantiles of the offset from the middle of the pixel at even steps, piecewise linear between.
    Quantiles(Vec<f32>),
}

impl PixelFilter {
    /// Builds the sampling table.
    pub(crate) fn sampler(self) -> Sampler {
        match self {
            Self::Gaussian { sigma, radius } if sigma > 0.0 && radius > 0.0 => {
                Sampler::Quantiles(quantiles(f64::from(sigma), f64::from(radius)))
            }
            _ => Sampler::Box,
        }
    }
}

/// Inverts the cumulative sum of the Gaussian on a fine grid.
fn quantiles(sigma: f64, radius: f64) -> Vec<f32> {
    let steps = 16 * TABLE;
    let at = |i: usize| (2.0 * i as f64 / steps as f64 - 1.0) * radius;
    let mut sums = vec![0.0];
    for i in 0..steps {
        let x = 0.5 * (at(i) + at(i + 1)) / sigma;
        sums.push(sums[i] + (-0.5 * x * x).exp());
    }
    let total = sums[steps];
    let mut i = 0;
    (0..=TABLE)
        .map(|j| {
            let aim = total * j as f64 / TABLE as f64;
            while i + 1 < steps && sums[i + 1] < aim {
                i += 1;
            }
            let rest = (aim - sums[i]) / (sums[i + 1] - sums[i]).max(f64::MIN_POSITIVE);
            (at(i) + rest.clamp(0.0, 1.0) * (at(i + 1) - at(i))) as f32
        })
        .collect()
}

impl Sampler {
    /// Positions in the picture of samples of pixels whose upper left corners are (x, y).
    #[inline(always)]
    pub(crate) fn place(&self, x: &F, y: &F, u: &[F; 2]) -> (F, F) {
        match self {
            Self::Box => (
                std::array::from_fn(|k| x[k] + u[0][k]),
                std::array::from_fn(|k| y[k] + u[1][k]),
            ),
            Self::Quantiles(table) => (
                std::array::from_fn(|k| x[k] + 0.5 + look_up(table, u[0][k])),
                std::array::from_fn(|k| y[k] + 0.5 + look_up(table, u[1][k])),
            ),
        }
    }
}

#[inline]
fn look_up(table: &[f32], u: f32) -> f32 {
    let at = u * TABLE as f32;
    let i = (at as usize).min(TABLE - 1);
    table[i] + (at - i as f32) * (table[i + 1] - table[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use brdf::LANES;

    #[test]
    fn gaussian_has_its_deviation_and_ends() {
        let filter = PixelFilter::Gaussian {
            sigma: 0.5,
            radius: 2.0,
        };
        let sampler = filter.sampler();
        let n = 10_000;
        let (mut mean, mut square, mut most) = (0.0, 0.0, 0.0_f64);
        for i in 0..n {
            let u = [[(i as f32 + 0.5) / n as f32; LANES], [0.5; LANES]];
            let (x, _) = sampler.place(&[0.0; LANES], &[0.0; LANES], &u);
            let x = f64::from(x[0]) - 0.5;
            mean += x / f64::from(n);
            square += x * x / f64::from(n);
            most = most.max(x.abs());
        }
        assert!(mean.abs() < 1e-5, "centred: {mean}");
        // cut at 4 sigma the variance is 0.9989 sigma^2; the linear pieces add 1e-3 in the outermost ones
        assert!((square / 0.25 - 0.9989).abs() < 5e-3, "variance {square}");
        assert!(most <= 2.0, "ends at the radius: {most}");
    }
}
