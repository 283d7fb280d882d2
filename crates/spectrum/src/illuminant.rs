//! Light spectra with names.

use crate::generated::illuminants;

/// A relative spectral power distribution; only its shape matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illuminant {
    name: &'static str,
    /// Powers at 300 nm, 305 nm, ..; empty for equal energy.
    table: &'static [f64],
}

const FIRST_NM: f64 = 300.0;
const STEP_NM: f64 = 5.0;

impl Illuminant {
    /// Incandescent light, 2856 K [Cie15].
    pub const A: Self = Self {
        name: "A",
        table: &illuminants::A,
    };
    /// Daylight at 5003 K [Cie15].
    pub const D50: Self = Self {
        name: "D50",
        table: &illuminants::D50,
    };
    /// Daylight at 6504 K [Cie15]: gonio's white.
    pub const D65: Self = Self {
        name: "D65",
        table: &illuminants::D65,
    };
    /// The same power at every wavelength [Cie15].
    pub const E: Self = Self {
        name: "E",
        table: &[],
    };

    /// The name CIE gives it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Relative power at a wavelength in nm: linear in the 5 nm table, flat outside of 300 to 780 nm (beyond
    /// 780 nm the observers see less than 1e-6 of the whole).
    #[must_use]
    pub fn at(&self, lambda_nm: f64) -> f64 {
        let Some(last) = self.table.len().checked_sub(1) else {
            return 100.0;
        };
        let x = ((lambda_nm - FIRST_NM) / STEP_NM).clamp(0.0, last as f64);
        let k = (x as usize).min(last - 1);
        let t = x - k as f64;
        self.table[k] * (1.0 - t) + self.table[k + 1] * t
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_100_at_560_nm() {
        for light in [
            Illuminant::A,
            Illuminant::D50,
            Illuminant::D65,
            Illuminant::E,
        ] {
            assert!((light.at(560.0) - 100.0).abs() < 1e-9, "{}", light.name());
        }
    }

    #[test]
    fn incandescent_light_follows_its_formula() {
        // [Cie15]: 100 (560/l)^5 (exp(1.435e7 / (2848 * 560)) - 1) / (exp(1.435e7 / (2848 l)) - 1)
        let planck = |l: f64| (1.435e7 / (2848.0 * l)).exp_m1();
        for nm in [380.0_f64, 450.0, 700.0, 780.0] {
            let formula = 100.0 * (560.0 / nm).powi(5) * planck(560.0) / planck(nm);
            assert!((Illuminant::A.at(nm) / formula - 1.0).abs() < 1e-5, "{nm}");
        }
    }
}
