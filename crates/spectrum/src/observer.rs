//! The CIE standard observers.

use crate::generated::{cie_1931_2deg, cie_1964_10deg};
use crate::{Outside, Spectrum};

/// Colour-matching functions: what each wavelength adds to X, Y and Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer {
    table: &'static [[f64; 3]],
}

/// First wavelength of the tables, nm.
const FIRST_NM: u16 = cie_1931_2deg::FIRST_NM;
const _: () = assert!(
    FIRST_NM == cie_1964_10deg::FIRST_NM,
    "both tables begin alike"
);

impl Observer {
    /// CIE 1931, 2 degree field [Cie15]: what gonio means by XYZ.
    pub const CIE_1931: Self = Self {
        table: &cie_1931_2deg::TABLE,
    };

    /// CIE 1964, 10 degree field [Cie15].
    pub const CIE_1964: Self = Self {
        table: &cie_1964_10deg::TABLE,
    };

    /// x, y, z at a wavelength in nm: the 1 nm table, linear in between, 0 outside of 360 to 830 nm.
    #[must_use]
    pub fn at(&self, lambda_nm: f64) -> [f64; 3] {
        let x = lambda_nm - f64::from(FIRST_NM);
        let last = self.table.len() - 1;
        if !(x >= 0.0 && x <= last as f64) {
            return [0.0; 3];
        }
        let k = (x as usize).min(last - 1);
        let t = x - k as f64;
        let (a, b) = (self.table[k], self.table[k + 1]);
        std::array::from_fn(|c| a[c] * (1.0 - t) + b[c] * t)
    }

    /// x, y and z as spectra, nothing outside of 360 to 830 nm.
    #[must_use]
    pub fn spectra(&self) -> [Spectrum; 3] {
        std::array::from_fn(|c| {
            let values = self.table.iter().map(|row| row[c]).collect();
            Spectrum::regular(f64::from(FIRST_NM), 1.0, values, Outside::Zero)
        })
    }

    /// What it sees, nm: no light outside of it counts.
    #[must_use]
    pub fn range_nm(&self) -> [f64; 2] {
        let first = f64::from(FIRST_NM);
        [first, first + (self.table.len() - 1) as f64]
    }

    /// The table itself: wavelength in nm, and x, y, z.
    pub fn samples(&self) -> impl Iterator<Item = (f64, [f64; 3])> {
        let nm = (FIRST_NM..).map(f64::from);
        nm.zip(self.table.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photopic_peak_is_one() {
        let [_, y, _] = Observer::CIE_1931.at(555.0);
        assert!((y - 1.0).abs() < 1e-12);
        let [_, half, _] = Observer::CIE_1931.at(555.5);
        let [_, next, _] = Observer::CIE_1931.at(556.0);
        assert!((half - 0.5 * (y + next)).abs() < 1e-12);
    }

    #[test]
    fn areas_of_the_three_functions_agree() {
        // [Cie15]: both are scaled for X = Y = Z of equal energy; the tables' rounding leaves this much.
        for observer in [Observer::CIE_1931, Observer::CIE_1964] {
            let sum = observer
                .samples()
                .fold([0.0; 3], |s, (_, v)| std::array::from_fn(|c| s[c] + v[c]));
            assert!((sum[0] / sum[1] - 1.0).abs() < 2e-4, "{sum:?}");
            assert!((sum[2] / sum[1] - 1.0).abs() < 4e-4, "{sum:?}");
        }
    }

    #[test]
    fn nothing_is_seen_outside() {
        for nm in [359.9, 830.1, f64::NAN, f64::INFINITY, -1e300] {
            assert!(
                Observer::CIE_1931.at(nm).iter().all(|v| v.abs() < 1e-300),
                "{nm}"
            );
        }
        assert!(Observer::CIE_1931.at(830.0)[1] > 0.0);
    }
}
