//! From spectra to XYZ, by exact integrals.

use crate::{Observer, Outside, Spectrum};

/// XYZ that light of unit power at each wavelength adds, once `light` is chosen: the integrand of every colour.
///
/// Holds the three products' factors and the luminance of the perfect white, to which XYZ is normalised.
#[derive(Clone, Debug)]
pub struct Viewing {
    light: Spectrum,
    matching: [Spectrum; 3],
    range_nm: [f64; 2],
    white_y: f64,
}

impl Viewing {
    /// What `observer` sees of reflectances under `light`, of which only the shape matters.
    #[must_use]
    pub fn new(light: &Spectrum, observer: &Observer) -> Self {
        let matching = observer.spectra();
        let range_nm = observer.range_nm();
        Self {
            white_y: Spectrum::integral_of_product([light, &matching[1]], range_nm),
            light: light.clone(),
            matching,
            range_nm,
        }
    }

    /// CIE 1931 under D65: what gonio means by XYZ where nothing else is said.
    #[must_use]
    pub fn standard() -> Self {
        Self::new(&crate::Illuminant::D65.spectrum(), &Observer::CIE_1931)
    }

    /// The light.
    #[must_use]
    pub fn light(&self) -> &Spectrum {
        &self.light
    }

    /// The integral of light times y: divide by it for Y = 1 of the perfect white.
    #[must_use]
    pub fn white_y(&self) -> f64 {
        self.white_y
    }

    /// XYZ of a reflectance; the perfect white has Y = 1.
    ///
    /// The integral over 360 to 830 nm of reflectance, light and colour-matching function, each linear
    /// between its own knots, exactly. CIE's sum over the 1 nm table [Cie15, 7.1] differs from it by 3e-5 at
    /// most for smooth reflectances.
    #[must_use]
    pub fn xyz(&self, reflectance: &Spectrum) -> [f64; 3] {
        self.xyz_within(reflectance, self.range_nm)
    }

    /// XYZ that a reflectance adds within `range_nm`.
    fn xyz_within(&self, reflectance: &Spectrum, range_nm: [f64; 2]) -> [f64; 3] {
        let range = [
            range_nm[0].max(self.range_nm[0]),
            range_nm[1].min(self.range_nm[1]),
        ];
        std::array::from_fn(|c| {
            let factors = [reflectance, &self.light, &self.matching[c]];
            Spectrum::integral_of_product(factors, range) / self.white_y
        })
    }

    /// XYZ of the perfect white.
    #[must_use]
    pub fn white(&self) -> [f64; 3] {
        self.xyz(&Spectrum::constant(1.0))
    }

    /// XYZ that one unit of each channel adds, for channels whose reconstructions are `channels`.
    #[must_use]
    pub fn weights(&self, channels: &[Spectrum]) -> Vec<[f64; 3]> {
        channels
            .iter()
            .map(|c| self.xyz_within(c, support(c)))
            .collect()
    }
}

/// Where a spectrum can be other than zero, nm.
fn support(s: &Spectrum) -> [f64; 2] {
    let (nm, values) = (s.lambda_nm(), s.values());
    let zero = |v: &f64| v.abs() == 0.0;
    let held = |v: &f64| s.outside() == Outside::Hold && !zero(v);
    let first = values.iter().position(|v| !zero(v)).unwrap_or(0);
    let last = values.iter().rposition(|v| !zero(v)).unwrap_or(0);
    let end = values.len() - 1;
    [
        if held(&values[0]) {
            f64::NEG_INFINITY
        } else {
            nm[first.saturating_sub(1)]
        },
        if held(&values[end]) {
            f64::INFINITY
        } else {
            nm[(last + 1).min(end)]
        },
    ]
}

/// XYZ of the perfect white under `light`, Y = 1.
#[must_use]
pub fn white_xyz(light: &Spectrum, observer: &Observer) -> [f64; 3] {
    Viewing::new(light, observer).white()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Illuminant;
    use testkit::assert_close;

    /// xy of published white points: five digits of [Cie15, tables T.3 and T.8], four for the lamps.
    const WHITES: [(Illuminant, Observer, [f64; 2]); 9] = [
        (Illuminant::A, Observer::CIE_1931, [0.44758, 0.40745]),
        (Illuminant::C, Observer::CIE_1931, [0.31006, 0.31616]),
        (Illuminant::D50, Observer::CIE_1931, [0.34567, 0.35851]),
        (Illuminant::D65, Observer::CIE_1931, [0.31272, 0.32903]),
        (Illuminant::E, Observer::CIE_1931, [0.33333, 0.33333]),
        (Illuminant::F2, Observer::CIE_1931, [0.3721, 0.3751]),
        (Illuminant::F11, Observer::CIE_1931, [0.3805, 0.3769]),
        (Illuminant::A, Observer::CIE_1964, [0.45117, 0.40594]),
        (Illuminant::D65, Observer::CIE_1964, [0.31382, 0.33100]),
    ];

    fn xy([x, y, z]: [f64; 3]) -> [f64; 2] {
        [x / (x + y + z), y / (x + y + z)]
    }

    #[test]
    fn white_points_are_the_published_ones() {
        for (light, observer, expected) in WHITES {
            let spectrum = light.spectrum();
            let exact = xy(white_xyz(&spectrum, &observer));
            // what was published: sums by 5 nm
            let sum = observer
                .samples()
                .filter(|(nm, _)| nm % 5.0 < 0.5)
                .fold([0.0; 3], |s, (nm, cmf)| {
                    std::array::from_fn(|c| s[c] + cmf[c] * spectrum.at(nm))
                });
            for c in 0..2 {
                // half a unit of the fourth digit, as two of the five-digit ones are sums by 1 nm
                assert_close(xy(sum)[c], expected[c], 5e-5, &format!("{light} by 5 nm"));
                // lines spread linearly over 10 nm move F2 and F11 by 2.4e-4; C moves by 7e-5, others less
                assert_close(exact[c], expected[c], 3e-4, &format!("{light}"));
            }
        }
    }

    #[test]
    fn exact_integrals_are_near_the_cie_sum() {
        let reflectance = Spectrum::new(
            vec![400.0, 517.0, 700.0],
            vec![0.1, 0.9, 0.2],
            Outside::Hold,
        )
        .unwrap();
        for light in [Illuminant::A, Illuminant::D65, Illuminant::F11] {
            let light = light.spectrum();
            let (mut sum, mut white) = ([0.0; 3], 0.0);
            for (nm, cmf) in Observer::CIE_1931.samples() {
                let power = light.at(nm);
                white += power * cmf[1];
                for c in 0..3 {
                    sum[c] += power * cmf[c] * reflectance.at(nm);
                }
            }
            let exact = Viewing::new(&light, &Observer::CIE_1931).xyz(&reflectance);
            for c in 0..3 {
                // the trapezoid rule's h^2/12 on curvatures, and on the kinks of F11's lines
                assert_close(exact[c], sum[c] / white, 3e-5, "sum by 1 nm");
            }
        }
    }

    #[test]
    fn weights_are_the_colours_of_the_channels() {
        let nm = vec![300.0, 480.0, 500.0, 640.0, 900.0];
        let viewing = Viewing::standard();
        let shapes = [
            (vec![0.0, 0.0, 1.0, 0.0, 0.0], Outside::Hold),
            (vec![0.0, 0.0, 1.0, 0.0, 0.0], Outside::Zero),
            (vec![1.0, 0.0, 0.0, 0.0, 0.0], Outside::Hold),
            (vec![0.0, 0.0, 0.0, 1.0, 1.0], Outside::Hold),
            (vec![0.0; 5], Outside::Hold),
        ];
        for (values, outside) in shapes {
            let s = Spectrum::new(nm.clone(), values, outside).unwrap();
            let (short, full) = (
                viewing.weights(std::slice::from_ref(&s))[0],
                viewing.xyz(&s),
            );
            for c in 0..3 {
                assert_close(short[c], full[c], 1e-15, "limited to its support");
            }
        }
    }
}
