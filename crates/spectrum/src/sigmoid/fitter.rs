//! Coefficients of sigmoids for colours, by Gauss and Newton in CIELAB with Levenberg's damping.

use super::{Sigmoid, TABLE_NM, parameter, sigmoid};
use crate::basis::table_srgb_from_xyz;
use crate::matrix::{Matrix3, inverse, transform, transpose};
use crate::{Basis, Spectrum, Viewing, lab_from_xyz};

/// Finds the sigmoid of a linear sRGB colour under D65 and the 2 degree observer.
///
/// Solved anew for each colour rather than looked up: the coefficients then are a smooth function of the colour
/// and the round trip is exact to rounding, at 33 microseconds (`docs/colour.md`).
#[derive(Clone, Debug)]
pub struct SigmoidFitter {
    /// t of each wavelength, and what reflectance there adds to XYZ.
    samples: Vec<(f64, [f64; 3])>,
    white: [f64; 3],
    srgb_from_xyz: Matrix3,
}

/// A sigmoid for a colour, and how near it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SigmoidFit {
    /// What the reflectance is multiplied by: 1, but for [`SigmoidFitter::fit_unbounded`].
    pub scale: f64,
    /// The reflectance.
    pub sigmoid: Sigmoid,
    /// The largest difference of the three channels, divided by `scale`; above 1e-6 only for colours no
    /// reflectance of this kind has.
    pub error: f64,
    /// Steps it took.
    pub steps: usize,
}

/// A colour this near, in each channel, is met.
const NEAR: f64 = 1e-9;
/// Steps after which a colour is out of reach: inside of the sRGB cube at most 32 are needed on a grid of 33^3.
const STEPS: usize = 200;
/// Levenberg's factor: at first, at least, and when no step helps any more.
const DAMPING: [f64; 3] = [1e-3, 1e-12, 1e10];

/// Where the solver stands.
struct Point {
    coefficients: [f64; 3],
    xyz: [f64; 3],
    /// Columns: derivatives of XYZ by the coefficients.
    by_coefficient: Matrix3,
    /// Differences of L*, a*, b* from the target's.
    residual: [f64; 3],
}

impl Point {
    fn cost(&self) -> f64 {
        self.residual.iter().map(|v| v * v).sum()
    }
}

impl Default for SigmoidFitter {
    fn default() -> Self {
        Self::new()
    }
}

impl SigmoidFitter {
    /// Prepares the weights: 2.5 ms.
    #[must_use]
    pub fn new() -> Self {
        let viewing = Viewing::standard();
        let bands: Vec<f64> = (TABLE_NM[0]..=TABLE_NM[1]).map(f64::from).collect();
        let weights = Basis::Bands(bands.clone()).xyz_weights(&viewing);
        Self {
            samples: bands.into_iter().map(parameter).zip(weights).collect(),
            white: viewing.white(),
            srgb_from_xyz: table_srgb_from_xyz(&viewing),
        }
    }

    /// The sigmoid of a linear sRGB colour in [0, 1]^3.
    ///
    /// Colours that no reflectance has (negative, above 1) get the nearest that was found, and an `error`;
    /// NaN gives NaN.
    #[must_use]
    pub fn fit(&self, rgb: [f64; 3]) -> SigmoidFit {
        let back = inverse(&self.srgb_from_xyz).unwrap_or([[f64::NAN; 3]; 3]);
        let target = lab_from_xyz(transform(&back, rgb), self.white);
        let grey = rgb.iter().sum::<f64>() / 3.0;
        // greys are met at once; black and white, at infinity, to NEAR
        let start = Sigmoid::grey(grey.clamp(0.5 * NEAR, 1.0 - 0.5 * NEAR)).coefficients;
        let mut here = self.point(start, target);
        let mut damping = DAMPING[0];
        let mut steps = 0;
        while steps < STEPS && damping < DAMPING[2] && self.error(&here, rgb) > NEAR {
            steps += 1;
            let Some(step) = self.step(&here, damping) else {
                damping *= 10.0;
                continue;
            };
            let next = std::array::from_fn(|k| here.coefficients[k] - step[k]);
            let next = self.point(next, target);
            if next.cost() < here.cost() {
                here = next;
                damping = (damping * 0.1).max(DAMPING[1]);
            } else {
                damping *= 10.0;
            }
        }
        SigmoidFit {
            scale: 1.0,
            sigmoid: Sigmoid {
                coefficients: here.coefficients,
            },
            error: self.error(&here, rgb),
            steps,
        }
    }

    /// As [`Self::fit`] for colours without an upper bound, such as values of a BRDF: with m = 2 max(rgb), m times the
    /// sigmoid of rgb/m ([Pharr2023, 4.6.6]). Black has scale 0.
    #[must_use]
    pub fn fit_unbounded(&self, rgb: [f64; 3]) -> SigmoidFit {
        let scale = 2.0 * rgb.iter().copied().fold(0.0, f64::max);
        if scale > 0.0 {
            let fit = self.fit(rgb.map(|v| v / scale));
            SigmoidFit { scale, ..fit }
        } else {
            SigmoidFit {
                scale: 0.0,
                ..self.fit([0.5; 3])
            }
        }
    }

    /// The light of a linear sRGB colour: the shape of `white` times the sigmoid of the colour, such that white light
    /// of 1 has the mean 1 over the luminous efficiency, or Y = 1. Keeps the colour if `white` is D65.
    #[must_use]
    pub fn emission(&self, rgb: [f64; 3], white: &Spectrum) -> Spectrum {
        let fit = self.fit_unbounded(rgb);
        let observer = crate::Observer::CIE_1931;
        let [_, y, _] = observer.spectra();
        let range = observer.range_nm();
        let level = Spectrum::integral_of_product([white, &y], range) / y.integral(range);
        fit.sigmoid
            .spectrum()
            .map(|nm, r| fit.scale * r * white.at(nm) / level)
    }

    /// The largest difference of linear sRGB.
    fn error(&self, point: &Point, rgb: [f64; 3]) -> f64 {
        let found = transform(&self.srgb_from_xyz, point.xyz);
        // `max` would drop NaN
        (0..3)
            .map(|c| (found[c] - rgb[c]).abs())
            .fold(0.0, |m, e| if e <= m { m } else { e })
    }

    fn point(&self, coefficients: [f64; 3], target: [f64; 3]) -> Point {
        let [c0, c1, c2] = coefficients;
        let mut xyz = [0.0; 3];
        let mut columns = [[0.0; 3]; 3];
        for (t, weights) in &self.samples {
            let p = (c0 * t + c1) * t + c2;
            let reflectance = sigmoid(p);
            // dr/dp = 1/2 (1 + p^2)^(-3/2)
            let q = 1.0 + p * p;
            let slope = 0.5 / (q * q.sqrt());
            for c in 0..3 {
                xyz[c] += weights[c] * reflectance;
                let w = weights[c] * slope;
                columns[2][c] += w;
                columns[1][c] += w * t;
                columns[0][c] += w * t * t;
            }
        }
        let lab = lab_from_xyz(xyz, self.white);
        Point {
            coefficients,
            xyz,
            by_coefficient: transpose(&columns),
            residual: std::array::from_fn(|c| lab[c] - target[c]),
        }
    }

    /// (J^T J + damping diag(J^T J))^-1 J^T r; `None` if singular.
    fn step(&self, here: &Point, damping: f64) -> Option<[f64; 3]> {
        let jacobian = self.lab_jacobian(here);
        let back = transpose(&jacobian);
        let mut normal = crate::matrix::product(&back, &jacobian);
        for (k, row) in normal.iter_mut().enumerate() {
            row[k] *= 1.0 + damping;
        }
        Some(transform(
            &inverse(&normal)?,
            transform(&back, here.residual),
        ))
    }

    /// Derivatives of L*, a*, b* by the coefficients.
    fn lab_jacobian(&self, here: &Point) -> Matrix3 {
        // f'(t) of the cube root, or of the line below (6/29)^3 [Cie15]
        let slope: [f64; 3] = std::array::from_fn(|c| {
            let t = here.xyz[c] / self.white[c];
            let joint = 6.0_f64 / 29.0;
            let f = if t > joint.powi(3) {
                t.cbrt().powi(-2) / 3.0
            } else {
                (joint * joint * 3.0).recip()
            };
            f / self.white[c]
        });
        let row = |c: usize| here.by_coefficient[c].map(|v| v * slope[c]);
        let (x, y, z) = (row(0), row(1), row(2));
        [
            y.map(|v| 116.0 * v),
            std::array::from_fn(|k| 500.0 * (x[k] - y[k])),
            std::array::from_fn(|k| 200.0 * (y[k] - z[k])),
        ]
    }
}
