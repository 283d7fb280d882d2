//! What the channels of a render mean.

use brdf_models::Seeing;
use spectrum::matrix::transform;
use spectrum::{Basis, Bins, Observer, Outside, RgbSpace, Spectrum, Viewing, table_srgb_from_xyz};

/// The channels of a render: functions of wavelength that share the spectrum among them.
///
/// A reflectance has its value at each band, or its mean over each bin: the mean that the reference and the eye see,
/// weighted by power times colour-matching functions, with which light reflected once keeps its colour better than with
/// the plain mean. Light is told *relative to a reference*, so that
/// what the film adds up per channel needs only the integrals of reference times colour-matching function, which
/// are computed exactly. For lights of the reference's shape nothing is lost but what the reflectances vary within a
/// channel; another light is told by the factor per channel that comes nearest to its own exact integrals.
#[derive(Clone, Debug)]
pub struct Channels {
    basis: Basis,
    /// Luminance 1.
    reference: Spectrum,
    /// Power of the reference in each channel.
    power: Vec<f64>,
    /// XYZ that one unit of each channel adds.
    xyz: Vec<[f64; 3]>,
    /// Linear sRGB that one unit of each channel adds.
    srgb: Vec<[f64; 3]>,
}

impl Channels {
    /// Channels of `basis` under lights like `reference`, whose luminance is 1.
    #[must_use]
    pub fn new(basis: Basis, reference: &Spectrum) -> Self {
        let xyz = xyz_weights(&basis, reference);
        let matrix = table_srgb_from_xyz(&Viewing::standard());
        Self {
            srgb: xyz.iter().map(|w| transform(&matrix, *w)).collect(),
            power: basis.project(reference),
            reference: reference.clone(),
            xyz,
            basis,
        }
    }

    /// How many.
    #[must_use]
    pub fn len(&self) -> usize {
        self.basis.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.basis.is_empty()
    }

    /// Which functionals of the spectrum they are.
    #[must_use]
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// The light that channels are told relative to.
    #[must_use]
    pub fn reference(&self) -> &Spectrum {
        &self.reference
    }

    /// Power of the reference in each channel, such that its integral times y is 1: what one unit stands for.
    #[must_use]
    pub fn power(&self) -> &[f64] {
        &self.power
    }

    /// XYZ that one unit of each channel adds to the film.
    #[must_use]
    pub fn to_xyz(&self) -> &[[f64; 3]] {
        &self.xyz
    }

    /// Linear sRGB that one unit of each channel adds to the film.
    #[must_use]
    pub fn to_srgb(&self) -> &[[f64; 3]] {
        &self.srgb
    }

    /// XYZ of what a film holds.
    #[must_use]
    pub fn xyz_of(&self, values: &[f64]) -> [f64; 3] {
        let mut out = [0.0; 3];
        for (value, weights) in values.iter().zip(&self.xyz) {
            (0..3).for_each(|c| out[c] += value * weights[c]);
        }
        out
    }

    /// A row for each channel of `native`: what one unit of it adds to each of these. White goes to ones.
    #[must_use]
    pub fn rows(&self, native: &Basis) -> Vec<Vec<f64>> {
        match &self.basis {
            Basis::Bins(_) => (native.reconstruction().iter())
                .map(|unit| self.reflectance(unit))
                .collect(),
            Basis::Xyz => (native.rows_to(&self.basis).into_iter())
                .map(relative)
                .collect(),
            _ => native.rows_to(&self.basis),
        }
    }

    /// The channels of a reflectance; ones for the perfect white.
    #[must_use]
    pub fn reflectance(&self, spectrum: &Spectrum) -> Vec<f64> {
        match &self.basis {
            Basis::Bins(bins) => self.seen_means(bins, spectrum),
            Basis::Xyz => relative(self.basis.project(spectrum)),
            _ => self.basis.project(spectrum),
        }
    }

    /// What models that know more than three wavelengths are told about these channels.
    pub(super) fn seeing<T>(&self, ask: impl FnOnce(&Seeing<'_>) -> T) -> T {
        let nm = Observer::CIE_1931.range_nm();
        // the mean of the wavelength itself
        let ramp = Spectrum::new(nm.to_vec(), nm.to_vec(), Outside::Hold);
        let lambda_nm = self.reflectance(&ramp.unwrap_or_else(|_| Spectrum::constant(nm[0])));
        let rows = self.rows(&Basis::Rgb(RgbSpace::srgb()));
        ask(&Seeing {
            lambda_nm: &lambda_nm,
            project: &|s| self.reflectance(s),
            uplift: std::array::from_fn(|c| rows.get(c).map_or(&[][..], |row| row)),
        })
    }

    /// Means over bins as the reference and the eye see them: x for which x times the bin's own (X, Y, Z) is the nearest
    /// to those of the reflectance in it. A mean with positive weights; the plain one where nothing is seen.
    fn seen_means(&self, bins: &Bins, spectrum: &Spectrum) -> Vec<f64> {
        let observer = Observer::CIE_1931;
        let (matching, seen) = (observer.spectra(), observer.range_nm());
        let last = bins.len() - 1;
        let mean = |k: usize, [from, to]: [f64; 2]| {
            // the outermost bins go on to the ends of what is seen
            let from = if k == 0 { seen[0].min(from) } else { from };
            let to = if k == last { seen[1].max(to) } else { to };
            let reflected: [f64; 3] = std::array::from_fn(|c| {
                let factors = [spectrum, &self.reference, &matching[c]];
                Spectrum::integral_of_product(factors, [from, to])
            });
            let square = dot(self.xyz[k], self.xyz[k]);
            if square > 0.0 {
                dot(reflected, self.xyz[k]) / square
            } else {
                spectrum.mean([from, to])
            }
        };
        bins.ranges().enumerate().map(|(k, r)| mean(k, r)).collect()
    }

    /// The channels of a light, whose luminance is the integral of its power times y.
    ///
    /// The factor x for each channel that makes x times the reference's (X, Y, Z) there the nearest to the light's own;
    /// 0 where the reference is dark.
    #[must_use]
    pub fn emission(&self, power: &Spectrum) -> Vec<f64> {
        xyz_weights(&self.basis, power)
            .into_iter()
            .zip(&self.xyz)
            .map(|(light, reference)| {
                let square = dot(*reference, *reference);
                if square > 0.0 {
                    dot(light, *reference) / square
                } else {
                    0.0
                }
            })
            .collect()
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// XYZ over that of white.
fn relative(mut xyz: Vec<f64>) -> Vec<f64> {
    let white = Viewing::standard().white();
    xyz.iter_mut().zip(white).for_each(|(v, w)| *v /= w);
    xyz
}

/// XYZ that one unit of each channel adds under light of power `light`: exact integrals.
fn xyz_weights(basis: &Basis, light: &Spectrum) -> Vec<[f64; 3]> {
    let viewing = Viewing::new(light, &Observer::CIE_1931);
    let level = viewing.white_y();
    if *basis == Basis::Xyz {
        let white = viewing.white();
        return (0..3)
            .map(|c| std::array::from_fn(|k| if k == c { white[c] * level } else { 0.0 }))
            .collect();
    }
    let weights = basis.xyz_weights(&viewing).into_iter();
    weights.map(|w| w.map(|v| v * level)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectrum::Illuminant;

    fn unit(light: Illuminant) -> Spectrum {
        let spectrum = light.spectrum();
        let level = Viewing::new(&spectrum, &Observer::CIE_1931).white_y();
        spectrum.scaled(level.recip())
    }

    fn bases() -> Vec<Basis> {
        let bands = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
        vec![
            Basis::Xyz,
            Basis::Bins(Bins::visible(8)),
            Basis::Bins(Bins::visible(45)),
            Basis::Bands(bands),
        ]
    }

    #[test]
    fn white_under_any_light_has_the_colour_of_the_light() {
        for basis in bases() {
            let channels = Channels::new(basis.clone(), &unit(Illuminant::D65));
            for light in [Illuminant::D65, Illuminant::A] {
                let power = unit(light).scaled(3.0);
                let seen = channels.xyz_of(&channels.emission(&power));
                let exact = Viewing::new(&power, &Observer::CIE_1931)
                    .white()
                    .map(|v| 3.0 * v);
                // the reference's own shape is exact; another's goes by one factor per channel, and 8 bins are 42 nm wide
                let bound = if light == Illuminant::D65 {
                    1e-12
                } else {
                    0.02
                };
                for c in 0..3 {
                    let error = (seen[c] / exact[c] - 1.0).abs();
                    assert!(error < bound, "{light} in {}: {error}", basis.len());
                }
            }
        }
    }

    #[test]
    fn piecewise_linear_reflectances_are_exact_in_their_own_bands() {
        let bands: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
        let values = (0..31)
            .map(|k| 0.5 + 0.4 * f64::from(k * k % 7 - 3) / 3.0)
            .collect();
        let spectrum = Spectrum::new(bands.clone(), values, Outside::Hold).unwrap();
        let light = unit(Illuminant::F11);
        let channels = Channels::new(Basis::Bands(bands), &light);
        let seen = channels.xyz_of(&channels.reflectance(&spectrum));
        let exact = Viewing::new(&light, &Observer::CIE_1931).xyz(&spectrum);
        for c in 0..3 {
            assert!((seen[c] - exact[c]).abs() < 1e-12, "{seen:?}, {exact:?}");
        }
    }

    #[test]
    fn rows_are_the_channels_of_each_unit() {
        let native = Basis::Bands(vec![400.0, 500.0, 600.0, 700.0]);
        for basis in bases() {
            let channels = Channels::new(basis, &unit(Illuminant::E));
            let rows = channels.rows(&native);
            for c in 0..channels.len() {
                let sum: f64 = rows.iter().map(|r| r[c]).sum();
                assert!((sum - 1.0).abs() < 1e-9, "white goes to one: {sum}");
            }
            let unit = native.reconstruction();
            for (row, unit) in rows.iter().zip(&unit) {
                for (a, b) in row.iter().zip(channels.reflectance(unit)) {
                    assert!((a - b).abs() < 1e-9, "{a} and {b}");
                }
            }
        }
    }
}
