//! From scene-linear radiance to what a screen shows.

use super::picture::Picture;
use rayon::prelude::*;
use spectrum::{GamutMapping, GamutReport, LUMINANCE_SRGB, srgb_encode};
use std::sync::LazyLock;

/// One factor, then what becomes of colours out of gamut, then clamping to [0, 1], then the sRGB curve [Iec61966].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap {
    /// What radiance is multiplied by.
    pub scale: f32,
    /// How colours with negative components are shown.
    pub gamut: GamutMapping,
}

/// The percentile that [`ToneMap::auto`] looks at ...
const PERCENTILE: f64 = 0.9;
/// ... and the linear value it becomes.
const TARGET: f64 = 0.8;

impl ToneMap {
    /// The 90th percentile of the luminance of the lit pixels (above 0) becomes 0.8.
    ///
    /// Up to a tenth of the lit pixels, highlights and visible lights, may burn out; the background does
    /// not count.
    #[must_use]
    pub fn auto(picture: &Picture) -> Self {
        let mut lit: Vec<f64> = picture
            .pixels
            .par_iter()
            .map(|p| luminance(*p))
            .filter(|y| *y > 0.0 && y.is_finite())
            .collect();
        let rank = (PERCENTILE * lit.len() as f64) as usize;
        let scale = match lit.len().checked_sub(1) {
            Some(last) => TARGET / *lit.select_nth_unstable_by(rank.min(last), f64::total_cmp).1,
            None => 1.0,
        };
        Self {
            scale: scale.min(f64::from(f32::MAX)) as f32,
            gamut: GamutMapping::default(),
        }
    }

    /// A pixel as 8-bit sRGB.
    #[must_use]
    pub fn show(&self, pixel: [f32; 3]) -> [u8; 3] {
        let scaled = pixel.map(|v| f64::from(v * self.scale));
        self.gamut.apply(scaled).map(|v| to_srgb8(v as f32))
    }

    /// What of a picture is out of gamut, and therefore shown in another colour than it has.
    #[must_use]
    pub fn report(&self, picture: &Picture) -> GamutReport {
        GamutReport::of(picture.pixels.iter().map(|p| p.map(f64::from)))
    }
}

fn luminance(p: [f32; 3]) -> f64 {
    p.iter()
        .zip(LUMINANCE_SRGB)
        .map(|(v, w)| f64::from(*v) * w)
        .sum()
}

/// One linear value in [0, 1] as an 8-bit sRGB code value; others are clamped, NaN is 0.
#[must_use]
pub fn to_srgb8(linear: f32) -> u8 {
    static CODES: LazyLock<Codes> = LazyLock::new(Codes::new);
    CODES.of(linear)
}

/// Where each code value begins: the same as the curve, without its power for every value.
struct Codes {
    /// The least bits of a value that is shown as `k` or more; the last is above all.
    first: [u32; 257],
    /// What the value with these leading bits and zeros behind them is shown as.
    start: Vec<u8>,
}

/// Bits behind the leading ones: at most one code value begins among values that share the others.
const BEHIND: u32 = 16;

impl Codes {
    fn new() -> Self {
        let one = 1.0_f32.to_bits();
        let mut first = [u32::MAX; 257];
        first[0] = 0;
        for k in 1..=255_u8 {
            // bits of positive floats are in their order
            let (mut low, mut high) = (first[usize::from(k) - 1], one);
            while low < high {
                let middle = low.midpoint(high);
                if by_curve(f32::from_bits(middle)) >= k {
                    high = middle;
                } else {
                    low = middle + 1;
                }
            }
            first[usize::from(k)] = low;
        }
        let code = |bits: u32| (first.partition_point(|f| *f <= bits) - 1) as u8;
        let start = (0..=one >> BEHIND)
            .map(|lead| code(lead << BEHIND))
            .collect();
        Self { first, start }
    }

    fn of(&self, linear: f32) -> u8 {
        // NaN and -0 become 0
        let bits = if linear > 0.0 {
            linear.min(1.0).to_bits()
        } else {
            0
        };
        let start = self.start[(bits >> BEHIND) as usize];
        start + u8::from(self.first[usize::from(start) + 1] <= bits)
    }
}

/// A value in [0, 1] by the curve itself.
fn by_curve(linear: f32) -> u8 {
    (srgb_encode(f64::from(linear)) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_those_of_the_curve() {
        for bits in (0..=1.0_f32.to_bits()).step_by(997) {
            let v = f32::from_bits(bits);
            assert_eq!(to_srgb8(v), by_curve(v), "{v}");
        }
        for first in &Codes::new().first[1..256] {
            for bits in first - 1..=first + 1 {
                let v = f32::from_bits(bits).min(1.0);
                assert_eq!(to_srgb8(v), by_curve(v), "{v}");
            }
        }
        let clamped = [f32::NAN, -0.0, -1.0, f32::INFINITY, 2.0];
        assert_eq!(clamped.map(to_srgb8), [0, 0, 0, 255, 255]);
    }
}
