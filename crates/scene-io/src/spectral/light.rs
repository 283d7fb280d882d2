//! The spectra that scene files speak of: of lights, in units of luminance, and of flat colours.

use crate::error::Error;
use crate::scene::{Colour, LightSpectrum, Radiometric, Wavelength};
use spectrum::{Illuminant, LinearUplift, Observer, Outside, SigmoidFitter, Spectrum, Viewing};

/// The power of a light: its luminance is the integral of power times y.
///
/// A colour alone is that of daylight: D65 times the uplifted colour, so that it looks the same as in RGB; by the linear
/// basis, since lights add up. With a spectrum it is how bright that spectrum shines.
///
/// # Errors
/// If the spectrum is dark or not one.
pub(crate) fn power(colour: Colour, spectrum: Option<&LightSpectrum>) -> Result<Spectrum, Error> {
    let [r, g, b] = colour.0;
    let grey = r.to_bits() == g.to_bits() && g.to_bits() == b.to_bits();
    match spectrum {
        Some(spectrum) => Ok(shape(spectrum)?.scaled(r)),
        None if grey => Ok(daylight().scaled(r)),
        None => Ok(lit_by_daylight(&LinearUplift::spectrum(colour.0))),
    }
}

/// A reflectance under D65 of luminance 1, as power.
pub(crate) fn lit_by_daylight(reflectance: &Spectrum) -> Spectrum {
    // D65 is tabulated by 1 nm, the uplift by more: between two knots the product's curvature is below 1e-4 of it
    daylight().map(|nm, power| power * reflectance.at(nm))
}

/// A colour of a scene in [0, 1] as reflectance: the smooth one, in [0, 1] at every wavelength [JakobHanika2019].
/// Nothing linear acts on it before it is reflected; where something does, as in mixtures, the colour itself is taken.
pub(crate) fn colour([r, g, b]: [f64; 3]) -> Spectrum {
    if r.to_bits() == g.to_bits() && g.to_bits() == b.to_bits() {
        Spectrum::constant(r)
    } else {
        SigmoidFitter::new().fit([r, g, b]).sigmoid.spectrum()
    }
}

/// A reflectance by wavelength, held beyond its ends.
///
/// # Errors
/// If the wavelengths do not ascend or there are none.
pub(crate) fn reflectance(rows: &[(Wavelength, Radiometric)]) -> Result<Spectrum, Error> {
    let (nm, values) = rows.iter().map(|(nm, v)| (nm.0, v.0)).unzip();
    Spectrum::new(nm, values, Outside::Hold).map_err(|e| Error::invalid(e.to_string()))
}

/// D65 of luminance 1.
pub(crate) fn daylight() -> Spectrum {
    let d65 = Illuminant::D65.spectrum();
    let level = luminance(&d65).recip();
    d65.scaled(level)
}

/// Whether a scene's spectrum is one that can shine.
pub(crate) fn check(spectrum: &LightSpectrum) -> Result<(), Error> {
    shape(spectrum).map(|_| ())
}

/// A spectrum of luminance 1.
fn shape(spectrum: &LightSpectrum) -> Result<Spectrum, Error> {
    let shape = match spectrum {
        LightSpectrum::Illuminant(name) => (name.parse::<Illuminant>())
            .map_err(|e| Error::invalid(e.to_string()))?
            .spectrum(),
        LightSpectrum::Blackbody(kelvin) => Illuminant::Blackbody(kelvin.0).spectrum(),
        LightSpectrum::Table(rows) => {
            let (nm, values) = rows.iter().map(|(nm, v)| (nm.0, v.0)).unzip();
            Spectrum::new(nm, values, Outside::Zero).map_err(|e| Error::invalid(e.to_string()))?
        }
    };
    let level = luminance(&shape);
    if !(level > 0.0 && level.is_finite()) {
        return Err(Error::invalid(
            "expected power between 360 and 830 nm, found a spectrum of no luminance",
        ));
    }
    Ok(shape.scaled(level.recip()))
}

/// The integral of power times y.
pub(crate) fn luminance(power: &Spectrum) -> f64 {
    Viewing::new(power, &Observer::CIE_1931).white_y()
}

/// XYZ of light of this power.
pub(crate) fn xyz(power: &Spectrum) -> [f64; 3] {
    let viewing = Viewing::new(power, &Observer::CIE_1931);
    viewing.white().map(|v| v * viewing.white_y())
}

/// The sum of the lights of a scene: the reference their channels are told by.
#[derive(Clone, Debug, Default)]
pub(crate) struct LightSum {
    powers: Vec<Spectrum>,
}

impl LightSum {
    /// Adds a light.
    pub(crate) fn add(&mut self, power: Spectrum) {
        self.powers.push(power);
    }

    /// The sum, scaled to luminance 1; daylight if nothing shines.
    pub(crate) fn reference(&self) -> Spectrum {
        unit(sum(self.powers.iter().filter(|p| luminance(p) > 0.0)))
    }

    /// The sum of all as if equally bright: a lamp that lights a corner counts like the sun.
    pub(crate) fn shape(&self) -> Spectrum {
        let shining = self.powers.iter().filter(|p| luminance(p) > 0.0);
        let even: Vec<Spectrum> = shining.map(|p| unit(p.clone())).collect();
        unit(sum(even.iter()))
    }
}

/// Scaled to luminance 1.
fn unit(power: Spectrum) -> Spectrum {
    let level = luminance(&power).recip();
    power.scaled(level)
}

/// The sum on the knots of all of them; daylight if there are none.
fn sum<'a>(powers: impl Iterator<Item = &'a Spectrum>) -> Spectrum {
    let powers: Vec<&Spectrum> = powers.collect();
    match powers[..] {
        [] => return daylight(),
        [one] => return one.clone(),
        _ => {}
    }
    let mut knots: Vec<f64> = powers.iter().flat_map(|p| p.lambda_nm()).copied().collect();
    knots.sort_unstable_by(f64::total_cmp);
    knots.dedup();
    let values = (knots.iter())
        .map(|nm| powers.iter().map(|p| p.at(*nm)).sum())
        .collect();
    // sorted, finite, of one length: nothing to refuse
    Spectrum::new(knots, values, Outside::Hold).unwrap_or_else(|_| daylight())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_shine_as_in_rgb() {
        let matrix = spectrum::table_srgb_from_xyz(&Viewing::standard());
        for rgb in [[1.0, 1.0, 1.0], [0.2, 0.7, 0.1], [9.0, 0.0, 3.0]] {
            let power = power(Colour(rgb), None).unwrap();
            let seen = spectrum::matrix::transform(&matrix, xyz(&power));
            for c in 0..3 {
                // the knots of the product: see `lit_by_daylight`
                assert!((seen[c] - rgb[c]).abs() < 2e-4 * 9.0, "{rgb:?}: {seen:?}");
            }
        }
    }

    #[test]
    fn named_lights_have_the_luminance_they_are_given() {
        let spectrum = LightSpectrum::Illuminant("F11".into());
        let power = power(Colour([2.5; 3]), Some(&spectrum)).unwrap();
        assert!(
            (luminance(&power) - 2.5).abs() < 1e-9,
            "{}",
            luminance(&power)
        );
    }

    #[test]
    fn the_reference_of_lights_of_one_shape_is_that_shape() {
        let mut lights = LightSum::default();
        for scale in [1.0, 3.0] {
            lights.add(daylight().scaled(scale));
        }
        let reference = lights.reference();
        for nm in [400.0, 555.5, 700.0] {
            let error = reference.at(nm) / daylight().at(nm) - 1.0;
            assert!(error.abs() < 1e-12, "{nm} nm: {error}");
        }
    }
}
