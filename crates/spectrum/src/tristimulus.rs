//! From spectra to XYZ: how much each band of a measurement adds.

use crate::{Illuminant, Observer};

/// XYZ that one unit of each band adds, for reflectances given at `bands_nm` (ascending), linear between
/// them and flat beyond the ends, under `light`.
///
/// Normalised so that a reflectance of 1 has Y = 1; the rows then sum to the white point. The integral is the
/// CIE's own: a sum over the 1 nm table of the observer [Cie15, 7.1], of reflectance times power times
/// colour-matching function, so no sampling of the light is involved. A band narrower than 1 nm between
/// whole wavelengths may weigh nothing.
#[must_use]
pub fn band_weights(bands_nm: &[f64], light: &Illuminant, observer: &Observer) -> Vec<[f64; 3]> {
    let mut weights = vec![[0.0; 3]; bands_nm.len()];
    if bands_nm.is_empty() {
        return weights;
    }
    let mut white_y = 0.0;
    for (nm, cmf) in observer.samples() {
        let add = cmf.map(|v| v * light.at(nm));
        white_y += add[1];
        for (band, share) in shares(bands_nm, nm) {
            for c in 0..3 {
                weights[band][c] += share * add[c];
            }
        }
    }
    for w in &mut weights {
        *w = w.map(|v| v / white_y);
    }
    weights
}

/// The two bands that a wavelength lies between and the part each has in the reflectance there.
fn shares(bands_nm: &[f64], nm: f64) -> [(usize, f64); 2] {
    let above = bands_nm.partition_point(|b| *b <= nm);
    let last = bands_nm.len() - 1;
    let (low, high) = (above.saturating_sub(1), above.min(last));
    let gap = bands_nm[high] - bands_nm[low];
    let t = if gap > 0.0 {
        (nm - bands_nm[low]) / gap
    } else {
        0.0
    };
    [(low, 1.0 - t), (high, t)]
}

/// XYZ of the perfect white under `light`, Y = 1.
#[must_use]
pub fn white_xyz(light: &Illuminant, observer: &Observer) -> [f64; 3] {
    // One band spans everything.
    band_weights(&[560.0], light, observer)[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_points_are_the_published_ones() {
        // xy of [Cie15, table T.3], five digits, for the 2 degree and of D65 for the 10 degree observer.
        let two = Observer::CIE_1931;
        for (light, observer, xy) in [
            (Illuminant::A, two, [0.44758, 0.40745]),
            (Illuminant::D50, two, [0.34567, 0.35851]),
            (Illuminant::D65, two, [0.31272, 0.32903]),
            (Illuminant::E, two, [0.33333, 0.33333]),
            (Illuminant::D65, Observer::CIE_1964, [0.31382, 0.33100]),
        ] {
            let [x, y, z] = white_xyz(&light, &observer);
            let found = [x / (x + y + z), y / (x + y + z)];
            for c in 0..2 {
                // The published ones are sums by 5 nm or ideal (E): 5e-5.
                assert!(
                    (found[c] - xy[c]).abs() < 5e-5,
                    "{}: {found:?}",
                    light.name()
                );
            }
        }
    }

    #[test]
    fn bands_share_a_white_reflectance() {
        let white = white_xyz(&Illuminant::D65, &Observer::CIE_1931);
        let cornell: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
        for bands in [
            cornell,
            vec![300.0, 555.5, 900.0],
            vec![550.0],
            vec![500.0, 500.0],
        ] {
            let weights = band_weights(&bands, &Illuminant::D65, &Observer::CIE_1931);
            for c in 0..3 {
                let sum: f64 = weights.iter().map(|w| w[c]).sum();
                assert!((sum - white[c]).abs() < 1e-12, "{bands:?}: {sum}");
            }
        }
    }

    #[test]
    fn weights_integrate_piecewise_linear_reflectances() {
        let bands = [400.0, 450.0, 530.0, 700.0];
        let reflectance = [0.1, 0.9, 0.2, 0.5];
        let at = |nm: f64| {
            let k = bands.iter().filter(|b| **b <= nm).count();
            match k {
                0 => reflectance[0],
                4 => reflectance[3],
                _ => {
                    let t = (nm - bands[k - 1]) / (bands[k] - bands[k - 1]);
                    reflectance[k - 1] * (1.0 - t) + reflectance[k] * t
                }
            }
        };
        let weights = band_weights(&bands, &Illuminant::D65, &Observer::CIE_1931);
        let y: f64 = weights.iter().zip(reflectance).map(|(w, r)| w[1] * r).sum();
        let (mut sum, mut white) = (0.0, 0.0);
        // A finer sum than the tables': the difference is the kinks and the curvature within 1 nm.
        for k in 0..4700 {
            let nm = 360.05 + 0.1 * f64::from(k);
            let power = Observer::CIE_1931.at(nm)[1] * Illuminant::D65.at(nm);
            sum += at(nm) * power;
            white += power;
        }
        assert!((y - sum / white).abs() < 3e-5, "{y}, {}", sum / white);
    }

    #[test]
    fn no_bands_no_weights() {
        assert!(band_weights(&[], &Illuminant::E, &Observer::CIE_1931).is_empty());
    }
}
