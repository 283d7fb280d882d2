//! How far two pictures are apart; the definitions of every number are law for all of gonio.

use crate::error::Error;
use crate::image::Picture;

/// Differences of picture `a` from picture `b`, the reference; means are over pixels and channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metrics {
    /// sqrt(mean (a - b)^2).
    pub rmse: f64,
    /// mean of (a - b)^2 / (b^2 + (0.01 mean(b))^2).
    pub rel_mse: f64,
    /// sqrt(sum (a - b)^2 / sum b^2).
    pub rel_rmse: f64,
    /// mean |a - b|.
    pub mae: f64,
    /// mean of a.
    pub mean_a: f64,
    /// mean of b.
    pub mean_b: f64,
    /// Values of either picture that are NaN or infinite; they enter no other number.
    pub not_finite: usize,
    /// The difference in units of its own standard error, if both pictures carry variances.
    pub z: Option<ZStatistics>,
}

/// z = (a - b) / sqrt(var a + var b), per pixel and channel where that variance is positive.
///
/// If the pictures have the same expectation and independent errors, z is about standard normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZStatistics {
    /// How many values entered.
    pub count: usize,
    /// mean z; about 0 +- 1 / sqrt(count).
    pub mean: f64,
    /// mean z^2; about 1 (a little more when the variances come from few replicates).
    pub mean_square: f64,
    /// Largest |z|.
    pub max_abs: f64,
    /// Share of |z| above 3; about 0.0027.
    pub share_above_3: f64,
    /// (mean a - mean b) over its standard error: the test of the whole picture.
    pub of_means: f64,
}

/// Compares `a` with the reference `b`.
///
/// # Errors
/// If the sizes differ or no finite value is left.
pub fn compare(a: &Picture, b: &Picture) -> Result<Metrics, Error> {
    if (a.width, a.height) != (b.width, b.height) {
        return Err(Error::invalid(format!(
            "expected pictures of one size, found {} x {} and {} x {}",
            a.width, a.height, b.width, b.height
        )));
    }
    let all = || flat(&a.pixels).zip(flat(&b.pixels));
    let total = 3 * a.pixels.len();
    let pairs = || all().filter(|(a, b)| a.is_finite() && b.is_finite());
    let count = pairs().count();
    if count == 0 {
        return Err(Error::invalid("expected finite pixels, found none"));
    }
    let n = count as f64;
    let mean_a = pairs().map(|(a, _)| a).sum::<f64>() / n;
    let mean_b = pairs().map(|(_, b)| b).sum::<f64>() / n;
    let square = |(a, b): (f64, f64)| (a - b) * (a - b);
    let squares: f64 = pairs().map(square).sum();
    let reference: f64 = pairs().map(|(_, b)| b * b).sum();
    let floor = (0.01 * mean_b).powi(2);
    let relative = |p: (f64, f64)| ratio(square(p), p.1 * p.1 + floor);
    Ok(Metrics {
        rmse: (squares / n).sqrt(),
        rel_mse: pairs().map(relative).sum::<f64>() / n,
        rel_rmse: ratio(squares, reference).sqrt(),
        mae: pairs().map(|(a, b)| (a - b).abs()).sum::<f64>() / n,
        mean_a,
        mean_b,
        not_finite: total - count,
        z: z_statistics(a, b),
    })
}

fn flat(pixels: &[[f32; 3]]) -> impl Iterator<Item = f64> {
    pixels.iter().flatten().map(|v| f64::from(*v))
}

/// a / b for a >= 0, b >= 0, where 0 / 0 is 0: equal black pictures do not differ.
fn ratio(a: f64, b: f64) -> f64 {
    if a > 0.0 { a / b } else { 0.0 }
}

fn z_statistics(a: &Picture, b: &Picture) -> Option<ZStatistics> {
    let variance = flat(a.variance.as_ref()?).zip(flat(b.variance.as_ref()?));
    let (mut count, mut sum, mut squares, mut max_abs, mut above) = (0_usize, 0.0, 0.0, 0.0, 0);
    let (mut difference, mut variances) = (0.0, 0.0);
    for ((a, b), (va, vb)) in flat(&a.pixels).zip(flat(&b.pixels)).zip(variance) {
        let (d, v) = (a - b, va + vb);
        if !(d.is_finite() && v.is_finite() && v > 0.0) {
            continue;
        }
        let z = d / v.sqrt();
        count += 1;
        sum += z;
        squares += z * z;
        max_abs = f64::max(max_abs, z.abs());
        above += usize::from(z.abs() > 3.0);
        difference += d;
        variances += v;
    }
    let n = count as f64;
    (count > 0).then(|| ZStatistics {
        count,
        mean: sum / n,
        mean_square: squares / n,
        max_abs,
        share_above_3: above as f64 / n,
        of_means: difference / variances.sqrt(),
    })
}
