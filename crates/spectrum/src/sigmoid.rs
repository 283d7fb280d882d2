//! RGB to reflectance by a sigmoid of a parabola [JakobHanika2019].

mod fitter;

pub use fitter::{SigmoidFit, SigmoidFitter};

use crate::{Outside, Spectrum};

/// A smooth reflectance strictly between 0 and 1: r(l) = 1/2 + p/(2 sqrt(1 + p^2)), p = c0 t^2 + c1 t + c2 with
/// t = (l - 550 nm)/150 nm.
///
/// Conserves energy whatever the coefficients. Not linear in RGB: for data that are interpolated or mixed
/// use [`crate::LinearUplift`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sigmoid {
    /// c0, c1, c2.
    pub coefficients: [f64; 3],
}

/// Where t is 0, and how far from there it is 1, nm: the polynomial is then as well conditioned as may be.
const CENTRE_NM: f64 = 550.0;
const HALF_NM: f64 = 150.0;

/// Wavelengths that [`Sigmoid::spectrum`] tabulates, by 1 nm: those of the observers.
const TABLE_NM: [u16; 2] = [360, 830];

impl Sigmoid {
    /// The same reflectance, in (0, 1), at every wavelength.
    #[must_use]
    pub fn grey(reflectance: f64) -> Self {
        let s = 2.0 * reflectance - 1.0;
        Self {
            coefficients: [0.0, 0.0, s / (1.0 - s * s).sqrt()],
        }
    }

    /// The reflectance at a wavelength in nm.
    #[inline]
    #[must_use]
    pub fn at(&self, lambda_nm: f64) -> f64 {
        sigmoid(self.polynomial(parameter(lambda_nm)))
    }

    #[inline]
    fn polynomial(&self, t: f64) -> f64 {
        let [c0, c1, c2] = self.coefficients;
        (c0 * t + c1) * t + c2
    }

    /// The reflectance by 1 nm from 360 to 830 nm, held beyond.
    #[must_use]
    pub fn spectrum(&self) -> Spectrum {
        let values = (TABLE_NM[0]..=TABLE_NM[1])
            .map(|nm| self.at(f64::from(nm)))
            .collect();
        Spectrum::regular(f64::from(TABLE_NM[0]), 1.0, values, Outside::Hold)
    }
}

#[inline]
fn parameter(lambda_nm: f64) -> f64 {
    (lambda_nm - CENTRE_NM) / HALF_NM
}

/// 1/2 + p/(2 sqrt(1 + p^2)), without cancellation for very negative p.
#[inline]
fn sigmoid(p: f64) -> f64 {
    let root = (1.0 + p * p).sqrt();
    let far = 0.5 / (root * (root + p.abs()));
    if p < 0.0 { far } else { 1.0 - far }
}

#[cfg(test)]
mod tests {
    use super::*;
    use testkit::{assert_close, assert_relative};

    #[test]
    fn is_the_papers_function() {
        for p in [-3.0, -0.2, 0.0, 0.7, 20.0] {
            let papers = 0.5 + p / (2.0 * f64::sqrt(1.0 + p * p));
            assert_close(sigmoid(p), papers, 1e-15, "sigmoid");
        }
        // 1/(4 p^2) far below, where the paper's form has no digits left
        assert_relative(sigmoid(-1e8), 0.25e-16, 1e-12, "tail");
        assert!(
            (0.0..=1.0).contains(&sigmoid(1e300)) && sigmoid(-1e300) >= 0.0,
            "energy"
        );
    }

    #[test]
    fn greys_are_flat() {
        for grey in [0.001, 0.18, 0.5, 0.99] {
            let s = Sigmoid::grey(grey).spectrum();
            assert!(
                s.values().iter().all(|v| (v - grey).abs() < 1e-13),
                "{grey}"
            );
        }
    }
}
