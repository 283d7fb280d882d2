//! Light spectra with names.

use crate::generated::illuminants;
use crate::{Outside, Spectrum};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// A relative spectral power distribution with a name; only its shape matters. All have 100 at 560 nm but C, F2
/// and F11, which keep CIE's own scale.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Illuminant {
    /// Incandescent light, 2856 K [Cie15].
    A,
    /// Average daylight of 1931, 6774 K [Cie15]: deprecated by CIE, found in old measurements.
    C,
    /// Daylight at 5003 K [Cie15].
    D50,
    /// Daylight at 6504 K [Cie15]: gonio's white.
    D65,
    /// The same power at every wavelength [Cie15].
    E,
    /// Cool white fluorescent lamp, 4230 K (FL2) [Cie15].
    F2,
    /// Three-band fluorescent lamp, 4000 K (FL11) [Cie15]: nearly all of it in lines.
    F11,
    /// A blackbody at this temperature in K.
    Blackbody(f64),
}

/// Not the name of an illuminant.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "unknown illuminant {0:?}: expected A, C, D50, D65, E, F2, F11 or blackbody:KELVIN (500 to 100000)"
)]
pub struct IlluminantError(String);

/// Wavelengths that blackbodies are tabulated for, by 1 nm: those of the observers and of illuminant A.
const BLACKBODY_NM: [u16; 2] = [300, 830];

/// Temperatures that make a usable table, K.
const KELVIN: [f64; 2] = [500.0, 100_000.0];

impl Illuminant {
    /// Those with a name of their own.
    pub const NAMED: [Self; 7] = [
        Self::A,
        Self::C,
        Self::D50,
        Self::D65,
        Self::E,
        Self::F2,
        Self::F11,
    ];

    /// Its relative power per nm, linear between the entries of a 1 nm table and flat beyond it: 300 to 780 nm, 380 to
    /// 780 nm for F2 and F11, 300 to 830 nm for A and blackbodies (of what an observer sees, less than 2e-6 is
    /// beyond 780 nm).
    #[must_use]
    pub fn spectrum(self) -> Spectrum {
        let table = |first_nm: u16, table: &[f64]| {
            Spectrum::regular(f64::from(first_nm), 1.0, table.to_vec(), Outside::Hold)
        };
        match self {
            Self::A => table(illuminants::A_FIRST_NM, &illuminants::A),
            Self::C => table(illuminants::C_FIRST_NM, &illuminants::C),
            Self::D50 => table(illuminants::D50_FIRST_NM, &illuminants::D50),
            Self::D65 => table(illuminants::D65_FIRST_NM, &illuminants::D65),
            Self::E => Spectrum::constant(100.0),
            Self::F2 => table(illuminants::F2_FIRST_NM, &illuminants::F2),
            Self::F11 => table(illuminants::F11_FIRST_NM, &illuminants::F11),
            Self::Blackbody(kelvin) => {
                let scale = 100.0 / planck(560.0, kelvin);
                let [from, to] = BLACKBODY_NM;
                let values: Vec<f64> = (from..=to)
                    .map(|nm| scale * planck(f64::from(nm), kelvin))
                    .collect();
                table(from, &values)
            }
        }
    }
}

impl fmt::Display for Illuminant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Blackbody(kelvin) => write!(f, "blackbody:{kelvin}"),
            named => write!(f, "{named:?}"),
        }
    }
}

impl FromStr for Illuminant {
    type Err = IlluminantError;

    /// `D65`, `blackbody:3000`; the inverse of its `Display`.
    fn from_str(text: &str) -> Result<Self, IlluminantError> {
        let unknown = || IlluminantError(text.into());
        if let Some(kelvin) = text.strip_prefix("blackbody:") {
            let kelvin: f64 = kelvin.parse().map_err(|_| unknown())?;
            let usable = (KELVIN[0]..=KELVIN[1]).contains(&kelvin);
            return usable
                .then_some(Self::Blackbody(kelvin))
                .ok_or_else(unknown);
        }
        Self::NAMED
            .into_iter()
            .find(|i| i.to_string() == text)
            .ok_or_else(unknown)
    }
}

/// Spectral radiance of a blackbody in W/(m^2 sr nm): Planck's law, 2 h c^2/l^5 / (exp(h c/(l k T)) - 1).
///
/// The constants are exact by definition of the SI [Bipm2019].
#[must_use]
pub fn planck(lambda_nm: f64, kelvin: f64) -> f64 {
    let (h, c, k) = (6.62607015e-34, 299_792_458.0, 1.380649e-23);
    let metres = lambda_nm * 1e-9;
    let per_metre = 2.0 * h * c * c / metres.powi(5) / (h * c / (metres * k * kelvin)).exp_m1();
    per_metre * 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::{assert_close, assert_relative};

    #[test]
    fn powers_are_100_at_560_nm() {
        for light in [
            Illuminant::A,
            Illuminant::D50,
            Illuminant::D65,
            Illuminant::E,
        ] {
            assert_close(light.spectrum().at(560.0), 100.0, 1e-9, &light.to_string());
        }
        let black = Illuminant::Blackbody(4000.0).spectrum();
        assert_close(black.at(560.0), 100.0, 1e-9, "blackbody");
    }

    #[test]
    fn incandescent_light_follows_its_formula() {
        // [Cie15]: 100 (560/l)^5 (exp(1.435e7 / (2848 * 560)) - 1) / (exp(1.435e7 / (2848 l)) - 1)
        let planck = |l: f64| (1.435e7 / (2848.0 * l)).exp_m1();
        let a = Illuminant::A.spectrum();
        for nm in [380.0_f64, 453.0, 700.0, 780.0, 821.0] {
            let formula = 100.0 * (560.0 / nm).powi(5) * planck(560.0) / planck(nm);
            // six digits of the published table
            assert_relative(a.at(nm), formula, 1e-6, "A");
        }
    }

    #[test]
    fn blackbodies() {
        // h c/(k) = 1.4387769e-2 m K, so that A's 2848 K by 1.435e-2 is 2855.5 K today [Cie15]
        let a = Illuminant::A.spectrum();
        let black = Illuminant::Blackbody(2848.0 * 1.4387769 / 1.435).spectrum();
        for nm in [380.0, 500.5, 780.0] {
            assert_relative(black.at(nm), a.at(nm), 1e-5, "A as a blackbody");
        }
        // Stefan and Boltzmann: pi times the integral is 5.670374419e-8 W/(m^2 K^4) T^4 [Bipm2019]
        let t = 5000.0_f64;
        let sum: f64 = (50..200_000).map(|k| planck(f64::from(k), t)).sum();
        let tail = 1e-4;
        assert_relative(
            std::f64::consts::PI * sum,
            5.670374419e-8 * t.powi(4),
            tail,
            "total",
        );
    }

    #[test]
    fn names_there_and_back() {
        for light in Illuminant::NAMED
            .into_iter()
            .chain([Illuminant::Blackbody(2700.5)])
        {
            assert_eq!(light.to_string().parse(), Ok(light));
        }
        for bad in [
            "d65",
            "F3",
            "",
            "blackbody:",
            "blackbody:-3",
            "blackbody:NaN",
        ] {
            assert!(bad.parse::<Illuminant>().is_err(), "{bad}");
        }
    }
}
