//! What to do with colours a screen can't show, by name, and how many there were.

use crate::LUMINANCE_SRGB;

/// How linear sRGB colours with negative components are shown. Measured reds are such colours: this belongs behind
/// the film, never before it. Values above 1 are a matter of exposure, not of gamut, and stay.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum GamutMapping {
    /// Left as they are.
    None,
    /// Negative components become 0: luminance and hue change.
    #[default]
    Clip,
    /// Mixed with grey of the same luminance until no component is negative: luminance stays, saturation goes.
    /// Black where the luminance is not positive.
    Desaturate,
}

impl GamutMapping {
    /// What is shown for a linear sRGB colour.
    #[must_use]
    pub fn apply(self, rgb: [f64; 3]) -> [f64; 3] {
        if self == Self::None || !is_outside(rgb) {
            return rgb;
        }
        match self {
            Self::None => rgb,
            Self::Clip => rgb.map(|v| v.max(0.0)),
            Self::Desaturate => {
                let y: f64 = rgb.iter().zip(LUMINANCE_SRGB).map(|(v, w)| v * w).sum();
                if y <= 0.0 {
                    return [0.0; 3];
                }
                let least = rgb.iter().copied().fold(f64::INFINITY, f64::min);
                // y + s (v - y) is 0 for the least v; `max` takes its rounding away
                let s = y / (y - least);
                rgb.map(|v| (y + s * (v - y)).max(0.0))
            }
        }
    }
}

/// Whether a component is negative.
fn is_outside(rgb: [f64; 3]) -> bool {
    rgb.iter().any(|v| *v < 0.0)
}

/// How many of some colours are outside of the gamut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GamutReport {
    /// Colours with a negative component.
    pub outside: u64,
    /// All colours.
    pub of: u64,
    /// The most negative component divided by the largest of its colour; 0 if none is outside.
    pub worst: f64,
}

impl GamutReport {
    /// Counts linear sRGB colours.
    #[must_use]
    pub fn of(colours: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let mut report = Self::default();
        for rgb in colours {
            report.of += 1;
            if is_outside(rgb) {
                report.outside += 1;
                let (least, size) = rgb
                    .iter()
                    .fold((0.0_f64, 0.0_f64), |(l, s), v| (l.min(*v), s.max(v.abs())));
                report.worst = report.worst.min(least / size);
            }
        }
        report
    }

    /// The part that is outside, 0 to 1; 0 of nothing.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.of == 0 {
            0.0
        } else {
            self.outside as f64 / self.of as f64
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::assert_close;

    const RED: [f64; 3] = [0.5, -0.05, 0.01];

    #[test]
    fn names_do_what_they_say() {
        assert_eq!(
            GamutMapping::None.apply(RED).map(f64::to_bits),
            RED.map(f64::to_bits)
        );
        let clipped = GamutMapping::Clip.apply(RED);
        assert_eq!(
            clipped.map(f64::to_bits),
            [0.5, 0.0, 0.01].map(f64::to_bits)
        );
        let grey = GamutMapping::Desaturate.apply(RED);
        let y = |v: [f64; 3]| {
            v.iter()
                .zip(LUMINANCE_SRGB)
                .map(|(v, w)| v * w)
                .sum::<f64>()
        };
        assert_close(y(grey), y(RED), 1e-15, "luminance");
        assert!(
            grey[1].abs() < 1e-15 && grey.iter().all(|v| *v >= 0.0),
            "{grey:?}"
        );
        let dark = GamutMapping::Desaturate.apply([0.01, -0.05, 0.0]);
        assert!(dark.iter().all(|v| v.abs() < 1e-300), "{dark:?}");
    }

    #[test]
    fn colours_inside_are_left_alone() {
        for mapping in [
            GamutMapping::None,
            GamutMapping::Clip,
            GamutMapping::Desaturate,
        ] {
            let bright = [3.0, 0.0, 0.2];
            assert_eq!(
                mapping.apply(bright).map(f64::to_bits),
                bright.map(f64::to_bits)
            );
        }
    }

    #[test]
    fn reports_count() {
        let report = GamutReport::of([RED, [0.1; 3], [0.0, 0.0, -1.0], [2.0, 0.0, 0.0]]);
        assert_eq!((report.outside, report.of), (2, 4));
        assert_close(report.share(), 0.5, 0.0, "share");
        assert_close(report.worst, -1.0, 0.0, "worst");
        assert_close(GamutReport::of([]).share(), 0.0, 0.0, "of nothing");
    }
}
