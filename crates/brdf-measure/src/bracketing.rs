//! A camera with few bits and many exposures.

use crate::MeasureError;

/// How a scene is read by an analogue-digital converter at a ladder of exposures.
///
/// The signal is the radiance of the sample under unit irradiance, f_r cos(theta_i). Exposure k has its full
/// scale at `full_scale * 2^(k stops)`, k = 0 ... exposures - 1, and reads the integer code
/// `round(signal / full scale * (2^bits - 1))`. The longest exposure (smallest full scale) that is not
/// saturated counts; a signal above every full scale clips at the largest, one below zero reads 0. So the
/// error is at most half a code: relatively `0.5 / (2^(bits - stops) - 1)` or less above the smallest full
/// scale, absolutely half of `full_scale / (2^bits - 1)` below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracketing {
    /// Bits of the converter, 1 to 24.
    pub bits: u32,
    /// Number of exposures, at least 1.
    pub exposures: u32,
    /// Exposure ratio of neighbours as log2, positive.
    pub stops: f64,
    /// Signal that saturates the longest exposure, 1/sr.
    pub full_scale: f64,
}

impl Bracketing {
    /// As for the MERL database: 10 bits, 18 exposures from 40 microseconds to 20 seconds [Matusik2003],
    /// the longest saturating at 0.01/sr, which puts the shortest at 5000/sr.
    pub const MERL: Self = Self {
        bits: 10,
        exposures: 18,
        // log2(20 / 40e-6) / 17
        stops: 1.113_622,
        full_scale: 0.01,
    };

    pub(crate) fn check(&self) -> Result<(), MeasureError> {
        let checks = [
            (
                "bits",
                f64::from(self.bits),
                (1..=24).contains(&self.bits),
                "1 to 24",
            ),
            (
                "exposures",
                f64::from(self.exposures),
                (1..=1000).contains(&self.exposures),
                "1 to 1000",
            ),
            (
                "stops",
                self.stops,
                self.stops > 0.0 && self.stops <= 24.0,
                "above 0, at most 24",
            ),
            (
                "full_scale",
                self.full_scale,
                self.full_scale > 0.0 && self.full_scale.is_finite(),
                "a positive signal",
            ),
        ];
        for (name, value, ok, expected) in checks {
            if !ok {
                return Err(MeasureError::Instrument {
                    name,
                    value,
                    expected,
                });
            }
        }
        Ok(())
    }

    /// What the instrument reports for a true `signal`.
    pub(crate) fn read(&self, signal: f64) -> f64 {
        let signal = signal.max(0.0);
        let top = f64::from((1_u32 << self.bits) - 1);
        let last = f64::from(self.exposures - 1);
        // a code of at most `top` is not saturated
        let steps = ((signal / self.full_scale).log2() / self.stops).ceil();
        let full_scale = self.full_scale * (self.stops * steps.clamp(0.0, last)).exp2();
        let code = (signal / full_scale * top).round().clamp(0.0, top);
        code / top * full_scale
    }
}

#[cfg(test)]
mod tests {
    use super::Bracketing;

    #[test]
    fn error_stays_within_half_a_code() {
        let b = Bracketing::MERL;
        let relative = 0.5 / (1023.0 / b.stops.exp2());
        for k in 0..4000 {
            let signal = 1e-5 * 10_f64.powf(8.6 * f64::from(k) / 4000.0);
            let error = (b.read(signal) - signal).abs();
            // rounding of the arithmetic itself on top
            let bound = (relative * signal).max(0.5 * b.full_scale / 1023.0) * (1.0 + 1e-9);
            assert!(error <= bound, "{signal}: {error} {bound}");
        }
    }

    #[test]
    fn the_ends_clip() {
        let b = Bracketing::MERL;
        let top = b.full_scale * (17.0 * b.stops).exp2();
        assert!((b.read(1e9) / top - 1.0).abs() < 1e-12, "{}", b.read(1e9));
        assert!((top - 5000.0).abs() < 0.1, "20 s over 40 us is 5e5: {top}");
        for dark in [0.0, -1.0, 1e-7, f64::NEG_INFINITY] {
            assert!(b.read(dark).abs() < 1e-300, "{dark}: {}", b.read(dark));
        }
    }

    #[test]
    fn values_on_the_scale_are_exact() {
        let b = Bracketing {
            bits: 8,
            exposures: 3,
            stops: 2.0,
            full_scale: 1.0,
        };
        for value in [0.0, 17.0 / 255.0, 1.0, 4.0 * 200.0 / 255.0, 16.0] {
            assert!(
                (b.read(value) - value).abs() < 1e-14,
                "{value} {}",
                b.read(value)
            );
        }
    }
}
