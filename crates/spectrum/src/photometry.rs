//! Lumen, candela and nit to watts and back.

use crate::{Observer, Spectrum};

/// Lumens per watt at the peak of V(l) [Bipm2019]. The definition is at 540 THz, 555.017 nm, where the tables have
/// V = 1 - 2e-6.
pub const LUMENS_PER_WATT: f64 = 683.0;

/// The luminous quantity of a spectral radiant one: 683 lm/W times the integral with V(l), the y of CIE 1931.
///
/// W/nm becomes lm, W/(sr nm) cd, W/(m^2 nm) lx, W/(m^2 sr nm) cd/m^2 (nit).
#[must_use]
pub fn luminous(radiant_per_nm: &Spectrum) -> f64 {
    let observer = Observer::CIE_1931;
    let [_, v, _] = observer.spectra();
    LUMENS_PER_WATT * Spectrum::integral_of_product([radiant_per_nm, &v], observer.range_nm())
}

/// The spectral radiant quantity, per nm, of this shape that has this luminous quantity: lm to W/nm, cd to W/(sr nm),
/// lx to W/(m^2 nm), cd/m^2 to W/(m^2 sr nm). `None` for a shape without light.
#[must_use]
pub fn radiant(luminous_quantity: f64, shape: &Spectrum) -> Option<Spectrum> {
    let factor = luminous_quantity / luminous(shape);
    factor.is_finite().then(|| shape.scaled(factor))
}

/// Lumens per watt of the light within `range_nm`; NaN for a shape without light.
#[must_use]
pub fn efficacy(shape: &Spectrum, range_nm: [f64; 2]) -> f64 {
    luminous(shape) / shape.integral(range_nm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Illuminant, Outside, planck};
    use testkit::{assert_close, assert_relative};

    #[test]
    fn green_light_has_683_lumens_per_watt() {
        // half a nm of light around 555 nm
        let line = Spectrum::new(vec![554.75, 555.25], vec![2.0, 2.0], Outside::Zero).unwrap();
        assert_relative(luminous(&line), 683.0, 1e-4, "V is flat there");
        assert_relative(efficacy(&line, [380.0, 780.0]), 683.0, 1e-4, "efficacy");
    }

    #[test]
    fn freezing_platinum_has_sixty_candela_per_square_centimetre() {
        // what the candela was from 1948 to 1979 [Bipm2019]; platinum freezes at 1768.2 degrees Celsius [Bedford1996]
        let nm = (300..=900_u16).map(f64::from);
        let radiance: Vec<f64> = nm.clone().map(|l| planck(l, 2041.35)).collect();
        let spectrum = Spectrum::new(nm.collect(), radiance, Outside::Zero).unwrap();
        // a kelvin is 0.6 %: the candela of 1948 was as good as its scale of temperatures
        assert_relative(luminous(&spectrum), 60e4, 0.01, "candela per square metre");
    }

    #[test]
    fn radiant_undoes_luminous() {
        for light in Illuminant::NAMED {
            let radiant = radiant(800.0, &light.spectrum()).unwrap();
            assert_close(luminous(&radiant), 800.0, 1e-9, "lumens");
        }
        assert!(radiant(1.0, &Spectrum::constant(0.0)).is_none(), "darkness");
    }
}
