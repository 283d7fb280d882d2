//! From scene-linear radiance to what a screen shows.

use super::picture::Picture;
use spectrum::{GamutMapping, GamutReport, LUMINANCE_SRGB, srgb_encode};

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
            .iter()
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
    let encoded = srgb_encode(f64::from(linear.clamp(0.0, 1.0)));
    // `as` saturates and turns NaN into 0
    (encoded * 255.0 + 0.5) as u8
}
