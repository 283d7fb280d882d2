//! A spectrum between its samples: piecewise linear, integrated exactly.

use thiserror::Error;

/// What a [`Spectrum`] is beyond its first and last wavelength.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outside {
    /// The first and the last value: for reflectances and daylight, as CIE extrapolates [Cie15].
    #[default]
    Hold,
    /// Nothing: for colour-matching functions and lines.
    Zero,
}

/// A function of the wavelength, linear between its knots. What the values are (reflectance, power per nm) is up
/// to its user.
///
/// Two knots at one wavelength are a jump; the function is continuous from the right there.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    lambda_nm: Vec<f64>,
    values: Vec<f64>,
    outside: Outside,
}

/// Why numbers are no spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpectrumError {
    /// No knots.
    #[error("a spectrum needs at least one wavelength")]
    Empty,
    /// The lists differ in length.
    #[error("{wavelengths} wavelengths and {values} values")]
    Lengths {
        /// How many wavelengths.
        wavelengths: usize,
        /// How many values.
        values: usize,
    },
    /// Not a number or infinite.
    #[error("knot {index} (from 0): {lambda_nm} nm, value {value}: must be finite")]
    NotFinite {
        /// Which knot, from 0.
        index: usize,
        /// Its wavelength.
        lambda_nm: f64,
        /// Its value.
        value: f64,
    },
    /// Wavelengths go down.
    #[error("knot {index} (from 0): {lambda_nm} nm comes after a longer wavelength")]
    Order {
        /// Which knot, from 0.
        index: usize,
        /// Its wavelength.
        lambda_nm: f64,
    },
}

impl Spectrum {
    /// The function through (`lambda_nm`, `values`).
    ///
    /// # Errors
    ///
    /// No knots, lists of different lengths, wavelengths that go down, anything not finite.
    pub fn new(
        lambda_nm: Vec<f64>,
        values: Vec<f64>,
        outside: Outside,
    ) -> Result<Self, SpectrumError> {
        if lambda_nm.len() != values.len() {
            return Err(SpectrumError::Lengths {
                wavelengths: lambda_nm.len(),
                values: values.len(),
            });
        }
        if lambda_nm.is_empty() {
            return Err(SpectrumError::Empty);
        }
        for (index, (nm, value)) in lambda_nm.iter().zip(&values).enumerate() {
            let (lambda_nm, value) = (*nm, *value);
            if !(lambda_nm.is_finite() && value.is_finite()) {
                return Err(SpectrumError::NotFinite {
                    index,
                    lambda_nm,
                    value,
                });
            }
        }
        if let Some(k) = lambda_nm.windows(2).position(|w| w[0] > w[1]) {
            return Err(SpectrumError::Order {
                index: k + 1,
                lambda_nm: lambda_nm[k + 1],
            });
        }
        Ok(Self::from_knots(lambda_nm, values, outside))
    }

    /// As [`Self::new`], for knots the crate made itself.
    pub(crate) fn from_knots(lambda_nm: Vec<f64>, values: Vec<f64>, outside: Outside) -> Self {
        debug_assert!(
            lambda_nm.len() == values.len() && lambda_nm.is_sorted(),
            "knots in order"
        );
        Self {
            lambda_nm,
            values,
            outside,
        }
    }

    /// Values at `first_nm`, `first_nm + step_nm`, ..
    pub(crate) fn regular(first_nm: f64, step_nm: f64, values: Vec<f64>, outside: Outside) -> Self {
        let lambda_nm = (0..values.len())
            .map(|k| first_nm + step_nm * k as f64)
            .collect();
        Self::from_knots(lambda_nm, values, outside)
    }

    /// The same value at every wavelength.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self::from_knots(vec![560.0], vec![value], Outside::Hold)
    }

    /// Wavelengths of the knots in nm, ascending.
    #[must_use]
    pub fn lambda_nm(&self) -> &[f64] {
        &self.lambda_nm
    }

    /// Values at the knots.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// What it is beyond the knots.
    #[must_use]
    pub fn outside(&self) -> Outside {
        self.outside
    }

    /// The value at a wavelength in nm.
    #[must_use]
    pub fn at(&self, lambda_nm: f64) -> f64 {
        let above = self.lambda_nm.partition_point(|k| *k <= lambda_nm);
        let last = self.lambda_nm.len() - 1;
        if above == last + 1 && lambda_nm <= self.lambda_nm[last] {
            return self.values[last];
        }
        self.piece(above).at(lambda_nm)
    }

    /// The same shape, `factor` times as high.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        self.map(|_, v| v * factor)
    }

    /// With each knot's value replaced by `f(wavelength, value)`.
    #[must_use]
    pub fn map(&self, mut f: impl FnMut(f64, f64) -> f64) -> Self {
        let knots = self.lambda_nm.iter().zip(&self.values);
        Self {
            lambda_nm: self.lambda_nm.clone(),
            values: knots.map(|(nm, v)| f(*nm, *v)).collect(),
            outside: self.outside,
        }
    }

    /// The integral over `[from, to]` nm, exactly.
    #[must_use]
    pub fn integral(&self, range_nm: [f64; 2]) -> f64 {
        Self::integral_of_product([self], range_nm)
    }

    /// The mean over `[from, to]` nm, exactly; the value itself for an empty range.
    #[must_use]
    pub fn mean(&self, range_nm: [f64; 2]) -> f64 {
        let width = range_nm[1] - range_nm[0];
        if width > 0.0 {
            self.integral(range_nm) / width
        } else {
            self.at(range_nm[0])
        }
    }

    /// The integral over `[from, to]` nm of the product of up to three spectra: exact to rounding, as between
    /// knots the product is a polynomial of degree three, for which Simpson's rule is exact.
    ///
    /// 0 for an empty range.
    #[must_use]
    pub fn integral_of_product<const K: usize>(factors: [&Self; K], range_nm: [f64; 2]) -> f64 {
        const { assert!(K <= 3, "Simpson's rule is exact up to degree three") };
        let [from, to] = range_nm;
        let mut knots = vec![from, to];
        for f in factors {
            let first = f.lambda_nm.partition_point(|k| *k <= from);
            let end = f.lambda_nm.partition_point(|k| *k < to);
            knots.extend_from_slice(f.lambda_nm.get(first..end).unwrap_or_default());
        }
        knots.sort_unstable_by(f64::total_cmp);
        let mut sum = 0.0;
        for w in knots.windows(2) {
            let (a, b) = (w[0], w[1]);
            let mid = 0.5 * (a + b);
            // also skips what is narrower than rounding
            if a < mid && mid < b && a >= from && b <= to {
                let pieces = factors.map(|f| f.piece(f.lambda_nm.partition_point(|k| *k <= mid)));
                let product = |nm| pieces.iter().map(|p| p.at(nm)).product::<f64>();
                sum += (b - a) / 6.0 * (product(a) + 4.0 * product(mid) + product(b));
            }
        }
        sum
    }

    /// The line that holds up to knot `above`.
    fn piece(&self, above: usize) -> Line {
        let n = self.lambda_nm.len();
        if above == 0 || above == n {
            let end = if above == 0 { 0 } else { n - 1 };
            let value = match self.outside {
                Outside::Hold => self.values[end],
                Outside::Zero => 0.0,
            };
            return Line {
                nm: self.lambda_nm[end],
                value,
                slope: 0.0,
            };
        }
        let low = above - 1;
        let gap = self.lambda_nm[above] - self.lambda_nm[low];
        Line {
            nm: self.lambda_nm[low],
            value: self.values[low],
            slope: (self.values[above] - self.values[low]) / gap,
        }
    }
}

/// One linear piece.
#[derive(Clone, Copy)]
struct Line {
    nm: f64,
    value: f64,
    slope: f64,
}

impl Line {
    fn at(self, lambda_nm: f64) -> f64 {
        self.value + self.slope * (lambda_nm - self.nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::assert_close;

    fn hat() -> Spectrum {
        Spectrum::new(
            vec![400.0, 500.0, 700.0],
            vec![0.0, 1.0, 0.0],
            Outside::Zero,
        )
        .unwrap()
    }

    #[test]
    fn lines_between_knots() {
        let s = hat();
        for (nm, value) in [
            (450.0, 0.5),
            (500.0, 1.0),
            (600.0, 0.5),
            (399.0, 0.0),
            (800.0, 0.0),
        ] {
            assert_close(s.at(nm), value, 1e-15, "hat");
        }
        let held = Spectrum::new(vec![400.0, 500.0], vec![0.2, 0.4], Outside::Hold).unwrap();
        assert_close(held.at(300.0), 0.2, 0.0, "before");
        assert_close(held.at(900.0), 0.4, 0.0, "after");
    }

    #[test]
    fn a_jump_takes_the_right_value_and_the_last_knot_its_own() {
        let knots = vec![400.0, 500.0, 500.0, 600.0];
        let s = Spectrum::new(knots, vec![1.0, 1.0, 3.0, 3.0], Outside::Zero).unwrap();
        assert_close(s.at(500.0), 3.0, 0.0, "jump");
        assert_close(s.at(600.0), 3.0, 0.0, "last");
        assert_close(s.integral([300.0, 700.0]), 400.0, 1e-12, "area");
    }

    #[test]
    fn products_are_integrated_exactly() {
        // (x/100)^3 over 0..100 in shifted wavelengths: 25; knots of the factors differ
        let ramp = |knots: &[f64]| {
            let values = knots.iter().map(|nm| (nm - 400.0) / 100.0).collect();
            Spectrum::new(knots.to_vec(), values, Outside::Zero).unwrap()
        };
        let (a, b, c) = (
            ramp(&[400.0, 500.0]),
            ramp(&[400.0, 433.3, 500.0]),
            ramp(&[400.0, 450.0, 471.0, 500.0]),
        );
        let all = Spectrum::integral_of_product([&a, &b, &c], [0.0, 1000.0]);
        assert_close(all, 25.0, 1e-12, "cubic");
        let part = Spectrum::integral_of_product([&a, &b, &c], [410.0, 431.0]);
        assert_close(part, 25.0 * (0.31_f64.powi(4) - 1e-4), 1e-14, "part");
        assert_close(
            Spectrum::integral_of_product([&a, &b], [450.0, 450.0]),
            0.0,
            0.0,
            "empty",
        );
    }

    #[test]
    fn means() {
        assert_close(hat().mean([400.0, 500.0]), 0.5, 1e-15, "half");
        assert_close(hat().mean([500.0, 500.0]), 1.0, 1e-15, "point");
        assert_close(
            Spectrum::constant(0.3).mean([380.0, 391.0]),
            0.3,
            1e-15,
            "flat",
        );
    }

    #[test]
    fn refuses_what_is_no_spectrum() {
        let new = |nm: &[f64], v: &[f64]| {
            Spectrum::new(nm.to_vec(), v.to_vec(), Outside::Hold)
                .unwrap_err()
                .to_string()
        };
        assert_eq!(new(&[], &[]), "a spectrum needs at least one wavelength");
        assert_eq!(new(&[400.0], &[]), "1 wavelengths and 0 values");
        assert_eq!(
            new(&[400.0, 390.0], &[1.0, 1.0]),
            "knot 1 (from 0): 390 nm comes after a longer wavelength"
        );
        assert!(new(&[400.0, f64::NAN], &[1.0, 1.0]).contains("must be finite"));
    }
}
