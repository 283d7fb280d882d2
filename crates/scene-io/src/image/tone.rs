//! From scene-linear radiance to what a screen shows.

use super::picture::Picture;
use rayon::slice::ParallelSliceMut;
use spectrum::LUMINANCE_SRGB;

/// One factor, then clamping to [0, 1], then the sRGB curve [Iec61966]: nothing that bends colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap {
    /// What radiance is multiplied by.
    pub scale: f32,
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
        lit.par_sort_unstable_by(f64::total_cmp);
        let rank = (PERCENTILE * lit.len() as f64) as usize;
        let scale = match lit.get(rank.min(lit.len().saturating_sub(1))) {
            Some(y) => TARGET / y,
            None => 1.0,
        };
        Self {
            scale: scale.min(f64::from(f32::MAX)) as f32,
        }
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
    let v = linear.clamp(0.0, 1.0);
    let encoded = if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    };
    // `as` saturates and turns NaN into 0
    (encoded * 255.0 + 0.5) as u8
}
