//! What is wrong with the instrument.

use sampling::Rng;

use crate::{Bracketing, MeasureError};

/// The flaws of an instrument; the default has none.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Instrument {
    /// Standard deviation of the logarithm of a multiplicative error, independent in every value;
    /// its mean is 1. 0 = none.
    pub noise: f64,
    /// The converter behind the detector; `None` = values as they are.
    pub bracketing: Option<Bracketing>,
    /// No values where detector and source are closer than this, degrees: the one hides the other.
    /// Only scattered grids ([`crate::measure_astm`]) can leave values out. 0 = none.
    pub blind_spot_deg: f64,
}

impl Instrument {
    /// The blind spot of Cornell's gonioreflectometer, found in its files: 17 degrees.
    pub const CORNELL_BLIND_SPOT_DEG: f64 = 17.0;

    pub(crate) fn check(&self) -> Result<(), MeasureError> {
        let checks = [
            (
                "noise",
                self.noise,
                (0.0..=10.0).contains(&self.noise),
                "0 to 10",
            ),
            (
                "blind_spot_deg",
                self.blind_spot_deg,
                (0.0..=90.0).contains(&self.blind_spot_deg),
                "0 to 90 degrees",
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
        self.bracketing.as_ref().map_or(Ok(()), Bracketing::check)
    }

    /// Whether values pass through unchanged.
    pub(crate) fn is_perfect(&self) -> bool {
        self.noise <= 0.0 && self.bracketing.is_none()
    }

    /// The value reported for a true f_r `value` at the cosine `cos_i` of the light: noise first, then the
    /// converter.
    pub(crate) fn read(&self, value: f64, cos_i: f64, rng: &mut Rng) -> f64 {
        let mut value = value;
        if self.noise > 0.0 {
            let s = self.noise;
            // the mean of exp(s g) is exp(s^2 / 2)
            value *= (s * rng.normal() - 0.5 * s * s).exp();
        }
        match &self.bracketing {
            Some(b) if cos_i > 0.0 => b.read(value * cos_i) / cos_i,
            _ => value,
        }
    }

    /// One line for a file's header.
    pub(crate) fn describe(&self) -> String {
        if self.is_perfect() && self.blind_spot_deg <= 0.0 {
            return "perfect instrument".into();
        }
        let mut parts = Vec::new();
        if self.noise > 0.0 {
            parts.push(format!("log-normal noise {}", self.noise));
        }
        if let Some(b) = &self.bracketing {
            parts.push(format!(
                "{} bits, {} exposures {} stops apart from {}/sr",
                b.bits, b.exposures, b.stops, b.full_scale
            ));
        }
        if self.blind_spot_deg > 0.0 {
            parts.push(format!("blind spot {} deg", self.blind_spot_deg));
        }
        parts.join("; ")
    }
}
