//! How different two pictures of one scene look, without what their noise adds.

use crate::error::Error;
use spectrum::{XYZ_FROM_LINEAR_SRGB, ciede2000, lab_from_xyz, matrix::transform};
use tracer::Film;

/// CIEDE2000 between two pictures over some of their pixels [Sharma2005].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourDifference {
    /// Mean, less what noise adds.
    pub mean: f64,
    /// 95th percentile, likewise.
    pub p95: f64,
    /// Standard error of the mean, from the replicates.
    pub mean_error: f64,
    /// Mean of what the two pictures show as they are, noise and all.
    pub raw_mean: f64,
    /// How many pixels entered.
    pub pixels: usize,
}

/// How linear sRGB is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// What radiance is multiplied by, so that white has a luminance of about 1.
    pub exposure: f64,
    /// XYZ of the white the eye is adapted to, Y = 1.
    pub white: [f64; 3],
}

impl Look {
    fn lab(&self, rgb: [f64; 3]) -> [f64; 3] {
        let xyz = transform(&XYZ_FROM_LINEAR_SRGB, rgb.map(|v| v * self.exposure));
        lab_from_xyz(xyz, self.white)
    }

    fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        ciede2000(self.lab(a), self.lab(b))
    }
}

/// CIEDE2000 of `film` against `reference` where `pixels` is true.
///
/// Both must hold the same samples of the same scene, so that replicate r of one goes the same ways as replicate r of
/// the other and most of the noise is common. Near the reference the square of CIEDE2000 is a quadratic form of the
/// difference d, so that E[dE^2(mean d)] = dE^2(true d) + V with V = sum over r of dE^2(d_r - mean d) / (R (R - 1)),
/// which is estimated pixel by pixel. A block of pixels then tells which part of dE^2 is noise, and every pixel of the
/// block is lowered by it: pixel by pixel, what is left of noise after its mean is taken off would be mistaken for colour.
///
/// # Errors
/// If the films differ in size, samples or replicates, or no pixel is chosen.
pub fn difference(
    film: &Film<3>,
    reference: &Film<3>,
    look: &Look,
    pixels: &[bool],
) -> Result<ColourDifference, Error> {
    let about = |f: &Film<3>| (f.width(), f.height(), f.replicates(), f.samples());
    if about(film) != about(reference) {
        return Err(Error::invalid(
            "expected pictures of the same samples, found others",
        ));
    }
    let (a, b) = (by_pixel(film), by_pixel(reference));
    if a.len() != pixels.len() {
        return Err(Error::invalid("expected a choice for every pixel"));
    }
    let replicates = film.replicates() as usize;
    let pairs = (replicates * (replicates - 1).max(1)) as f64;
    let mut seen = vec![Seen::default(); a.len()];
    // the mean of each replicate alone, whose spread is the error of the mean
    let mut alone = vec![0.0; replicates];
    for (k, (a, b)) in a.iter().zip(&b).enumerate().filter(|(k, _)| pixels[*k]) {
        let truth = mean(b);
        let d: Vec<[f64; 3]> = a.iter().zip(b).map(|(a, b)| minus(*a, *b)).collect();
        let middle = mean(&d);
        seen[k].raw = look.difference(plus(truth, middle), truth);
        for (r, d) in d.iter().enumerate() {
            let off = look.difference(plus(truth, minus(*d, middle)), truth);
            seen[k].noise += off * off / pairs;
            alone[r] += look.difference(plus(truth, *d), truth);
        }
    }
    let raw: f64 = seen.iter().map(|s| s.raw).sum();
    let mut clean = cleaned(&seen, pixels, film.width() as usize);
    let n = clean.len();
    if n == 0 {
        return Err(Error::invalid("expected pixels to compare, found none"));
    }
    clean.sort_unstable_by(f64::total_cmp);
    let alone: Vec<f64> = alone.iter().map(|s| s / n as f64).collect();
    let middle = alone.iter().sum::<f64>() / replicates as f64;
    let spread: f64 = alone.iter().map(|m| (m - middle) * (m - middle)).sum();
    Ok(ColourDifference {
        mean: clean.iter().sum::<f64>() / n as f64,
        p95: clean[((n as f64 * 0.95) as usize).min(n - 1)],
        mean_error: (spread / pairs).sqrt(),
        raw_mean: raw / n as f64,
        pixels: n,
    })
}

/// What one pixel shows.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// CIEDE2000 of the means.
    raw: f64,
    /// What noise adds to its square.
    noise: f64,
}

/// Pixels a side of a block.
const BLOCK: usize = 8;

/// The differences of the chosen pixels, lowered by the noise of their block.
fn cleaned(seen: &[Seen], pixels: &[bool], width: usize) -> Vec<f64> {
    let height = seen.len() / width.max(1);
    let mut out = Vec::new();
    for (y, x) in (0..height.div_ceil(BLOCK))
        .flat_map(|y| (0..width.div_ceil(BLOCK)).map(move |x| (y * BLOCK, x * BLOCK)))
    {
        let rows = y..(y + BLOCK).min(height);
        let columns = x..(x + BLOCK).min(width);
        let block: Vec<Seen> = rows
            .flat_map(|y| columns.clone().map(move |x| y * width + x))
            .filter(|k| pixels[*k])
            .map(|k| seen[k])
            .collect();
        let square: f64 = block.iter().map(|s| s.raw * s.raw).sum();
        let noise: f64 = block.iter().map(|s| s.noise).sum();
        let part = if square > 0.0 {
            (1.0 - noise / square).max(0.0).sqrt()
        } else {
            0.0
        };
        out.extend(block.iter().map(|s| s.raw * part));
    }
    out
}

/// Means of the replicates of each pixel, row after row.
fn by_pixel(film: &Film<3>) -> Vec<Vec<[f64; 3]>> {
    let replicates = film.replicates() as usize;
    let mut out = vec![Vec::new(); film.width() as usize * film.height() as usize];
    for tile in film.tiles() {
        let counts: Vec<f64> = (0..film.replicates())
            .map(|r| f64::from(tile.samples_of(r).max(1)))
            .collect();
        for ((x, y), sums) in tile.pixels().zip(tile.sums().chunks_exact(replicates)) {
            let means = sums.iter().zip(&counts).map(|(s, n)| s.map(|v| v / n));
            out[y as usize * film.width() as usize + x as usize] = means.collect();
        }
    }
    out
}

fn mean(values: &[[f64; 3]]) -> [f64; 3] {
    let n = values.len().max(1) as f64;
    std::array::from_fn(|c| values.iter().map(|v| v[c]).sum::<f64>() / n)
}

fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| a[c] + b[c])
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| a[c] - b[c])
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOOK: Look = Look {
        exposure: 1.0,
        // D65 by [Lindbloom]; any white would do
        white: [0.95047, 1.0, 1.08883],
    };

    /// A film of 12 x 10 pixels whose replicates are `colour(r)` plus noise.
    fn film(seed: u64, noise: f64, colour: [f64; 3]) -> Film<3> {
        let mut film = Film::new(12, 10, 8);
        let mut state = seed;
        let mut random = || {
            // a linear congruential generator: what the noise is does not matter
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let counts: Vec<usize> = film.tiles().map(|t| t.sums().len()).collect();
        for (index, count) in counts.into_iter().enumerate() {
            let sums: Vec<[f64; 3]> = (0..count)
                .map(|_| colour.map(|v| v + noise * random()))
                .collect();
            film.restore(index, 8, &sums).unwrap();
        }
        film
    }

    #[test]
    fn noise_is_taken_off_what_is_seen() {
        let grey = [0.4, 0.38, 0.42];
        let other = [0.43, 0.38, 0.40];
        let pixels = vec![true; 120];
        let exact = LOOK.difference(other, grey);
        let noisy =
            difference(&film(1, 0.08, other), &film(2, 0.08, grey), &LOOK, &pixels).unwrap();
        // a pixel's noise is 0.08 sqrt(2 / 12 / 8) = 0.0115: a third of the difference in green and blue
        assert!(
            (noisy.mean / exact - 1.0).abs() < 0.06,
            "{noisy:?} of {exact}"
        );
        assert!(noisy.raw_mean > 1.05 * exact, "{noisy:?} of {exact}");
        let equal = difference(&film(3, 0.02, grey), &film(4, 0.02, grey), &LOOK, &pixels).unwrap();
        // two blocks of 96 and 24 pixels: what is left is the fourth root of their chance
        assert!(equal.mean < 0.6 * equal.raw_mean, "{equal:?}");
        assert!(equal.raw_mean > 0.0 && equal.pixels == 120, "{equal:?}");
    }

    #[test]
    fn the_same_film_does_not_differ_and_others_are_refused() {
        let a = film(5, 0.1, [0.5; 3]);
        let same = difference(&a, &a, &LOOK, &[true; 120]).unwrap();
        assert!(
            same.mean.abs() < 1e-12 && same.p95.abs() < 1e-12,
            "{same:?}"
        );
        assert!(difference(&a, &Film::new(12, 10, 8), &LOOK, &[true; 120]).is_err());
        assert!(difference(&a, &a, &LOOK, &[false; 120]).is_err());
    }
}
