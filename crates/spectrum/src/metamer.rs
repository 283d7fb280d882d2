//! Reflectances that look alike under one light and not under another.

use crate::matrix::{Matrix3, inverse, transform};
use crate::{Basis, Outside, Spectrum, Viewing};

/// The part of `wanted` (values at `bands_nm`, as many, ascending) that has no colour in this viewing: XYZ = 0 [CohenKappauf1982].
///
/// `wanted` minus its projection onto the three weights of the bands. `None` if the bands don't tell three
/// colours apart, or the lists differ in length.
#[must_use]
pub fn metameric_black(bands_nm: &[f64], wanted: &[f64], viewing: &Viewing) -> Option<Vec<f64>> {
    if bands_nm.len() != wanted.len() {
        return None;
    }
    let weights = Basis::Bands(bands_nm.to_vec()).xyz_weights(viewing);
    // R = W (W^T W)^-1 W^T
    let gram: Matrix3 =
        std::array::from_fn(|i| std::array::from_fn(|j| weights.iter().map(|w| w[i] * w[j]).sum()));
    let seen: [f64; 3] =
        std::array::from_fn(|c| weights.iter().zip(wanted).map(|(w, v)| w[c] * v).sum());
    let parts = transform(&inverse(&gram)?, seen);
    let black = weights
        .iter()
        .zip(wanted)
        .map(|(w, v)| v - (w[0] * parts[0] + w[1] * parts[1] + w[2] * parts[2]));
    Some(black.collect())
}

/// A flat grey of 0.5, and a reflectance in [0.05, 0.95] of the same XYZ in this viewing that waves with the
/// wavelength, 140 nm a period. `None` only for viewings without three colours.
///
/// Under D65 both are grey; under A they differ by a CIEDE2000 of 16, under F11 of 20 (`docs/colour.md`).
#[must_use]
pub fn metamers(viewing: &Viewing) -> Option<[Spectrum; 2]> {
    let nm: Vec<f64> = (0..=80).map(|k| 380.0 + 5.0 * f64::from(k)).collect();
    let wave: Vec<f64> = nm
        .iter()
        .map(|l| (std::f64::consts::TAU * (l - 560.0) / 140.0).cos())
        .collect();
    let black = metameric_black(&nm, &wave, viewing)?;
    let peak = black.iter().fold(0.0, |m, v| f64::max(m, v.abs()));
    let values = black.iter().map(|v| 0.5 + 0.45 * v / peak).collect();
    let wavy = Spectrum::new(nm, values, Outside::Hold).ok()?;
    Some([Spectrum::constant(0.5), wavy])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Illuminant, Observer, ciede2000, lab_from_xyz};
    use testkit::assert_close;

    #[test]
    fn metamers_match_under_one_light_only() {
        let [grey, wavy] = metamers(&Viewing::standard()).unwrap();
        assert!(
            wavy.values().iter().all(|v| (0.05..=0.95).contains(v)),
            "a reflectance"
        );
        let difference = |viewing: &Viewing| {
            let lab = |s| lab_from_xyz(viewing.xyz(s), viewing.white());
            ciede2000(lab(&grey), lab(&wavy))
        };
        let d65 = Viewing::standard();
        for (a, b) in d65.xyz(&grey).iter().zip(d65.xyz(&wavy)) {
            assert_close(*a, b, 1e-14, "equal under D65");
        }
        for light in [Illuminant::A, Illuminant::F11] {
            let other = Viewing::new(&light.spectrum(), &Observer::CIE_1931);
            println!("{light}: CIEDE2000 {:.3}", difference(&other));
            assert!(difference(&other) > 10.0, "{light}: {}", difference(&other));
        }
        let ten = Viewing::new(&Illuminant::D65.spectrum(), &Observer::CIE_1964);
        println!("10 degrees: CIEDE2000 {:.3}", difference(&ten));
    }

    #[test]
    fn blacks_have_no_colour_and_nothing_is_taken_from_them() {
        let nm: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
        let viewing = Viewing::standard();
        let ramp: Vec<f64> = (0..31).map(f64::from).collect();
        let black = metameric_black(&nm, &ramp, &viewing).unwrap();
        let spectrum = Spectrum::new(nm.clone(), black.clone(), Outside::Hold).unwrap();
        assert!(
            viewing.xyz(&spectrum).iter().all(|v| v.abs() < 1e-13),
            "no colour"
        );
        let again = metameric_black(&nm, &black, &viewing).unwrap();
        for (a, b) in again.iter().zip(&black) {
            assert_close(*a, *b, 1e-11, "a projection");
        }
        assert!(
            metameric_black(&nm[..2], &ramp[..2], &viewing).is_none(),
            "two bands"
        );
        assert!(
            metameric_black(&nm, &ramp[..2], &viewing).is_none(),
            "lengths"
        );
    }
}
