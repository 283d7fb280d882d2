//! Rows of a gonioreflectometer: where each was measured and what it read.

use crate::scattered::error::CloudError;
use brdf::HalfDiff;
use brdf_formats::{AstmFile, Channels, PbrtTextFile};
use glam::DVec3;
use spectrum::{Basis, RgbSpace};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

/// Angles closer than this, in radians, are one angle: half a unit of the sixth decimal on either side.
pub(crate) const SAME_ANGLE: f64 = 1e-6;

/// A pair of directions over an isotropic, bilaterally symmetric surface, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// Polar angle toward the light, [0, pi/2).
    pub theta_i: f64,
    /// Polar angle toward the viewer, [0, pi/2).
    pub theta_o: f64,
    /// Azimuth between the two without its sign, [0, pi]; pi is forward scattering.
    pub phi: f64,
}

impl Geometry {
    /// Of unit vectors in the local frame.
    #[inline]
    #[must_use]
    pub fn new(wi: DVec3, wo: DVec3) -> Self {
        let cross = wi.x * wo.y - wi.y * wo.x;
        let dot = wi.x * wo.x + wi.y * wo.y;
        Self {
            theta_i: wi.x.hypot(wi.y).atan2(wi.z),
            theta_o: wo.x.hypot(wo.y).atan2(wo.z),
            phi: cross.abs().atan2(dot),
        }
    }

    /// Folds azimuths by bilateral symmetry.
    fn folded(theta_i: f64, theta_o: f64, phi: f64) -> Self {
        let turn = phi.rem_euclid(2.0 * PI);
        Self {
            theta_i,
            theta_o,
            phi: turn.min(2.0 * PI - turn),
        }
    }

    /// Unit vectors (wi, wo) with the light in the plane phi = 0.
    #[inline]
    #[must_use]
    pub fn directions(self) -> (DVec3, DVec3) {
        (
            brdf::direction(self.theta_i, 0.0),
            brdf::direction(self.theta_o, self.phi),
        )
    }

    /// Half and difference angles.
    #[inline]
    #[must_use]
    pub fn half_diff(self) -> HalfDiff {
        let (wi, wo) = self.directions();
        HalfDiff::new(wi, wo)
    }

    /// Equal up to the print precision of the files.
    pub(crate) fn is_same(self, other: Self) -> bool {
        let close = |a: f64, b: f64| (a - b).abs() <= SAME_ANGLE;
        close(self.theta_i, other.theta_i)
            && close(self.theta_o, other.theta_o)
            && (close(self.phi, other.phi) || self.theta_o.min(self.theta_i) <= SAME_ANGLE)
    }
}

/// Measured rows: directions and one value a channel, f_r times the basis' white level, in 1/sr.
///
/// Only bilateral symmetry is used: the half plane of the file stands for both. Reciprocity is not assumed.
/// Rows come sorted by theta_i, theta_o, phi; rows at the same angles are averaged, rows at or below the
/// horizon left out, and both are counted.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleCloud {
    basis: Basis,
    geometry: Vec<Geometry>,
    /// Row-major.
    values: Vec<f64>,
    /// What each channel adds to the luminance.
    luminance: Vec<f64>,
    merged: usize,
    below_horizon: usize,
}

impl SampleCloud {
    /// From angles (theta_i, phi_i, theta_o, phi_o in radians) and row-major values.
    ///
    /// # Errors
    /// If the counts do not match, a number is not finite, or no row lies above the horizon.
    pub fn new(basis: Basis, angles: &[[f64; 4]], values: &[f64]) -> Result<Self, CloudError> {
        let (rows, channels) = (angles.len(), basis.len());
        if values.len() != rows * channels || channels == 0 {
            return Err(CloudError::Shape {
                rows,
                channels,
                expected: rows * channels,
                found: values.len(),
            });
        }
        let mut merged: BTreeMap<[i64; 3], Merged> = BTreeMap::new();
        let mut below = 0;
        for (row, (a, v)) in angles.iter().zip(values.chunks_exact(channels)).enumerate() {
            if let Some(&found) = a.iter().chain(v).find(|x| !x.is_finite()) {
                return Err(CloudError::NotFinite { row, found });
            }
            let upright = 0.0..FRAC_PI_2 - SAME_ANGLE;
            if !upright.contains(&a[0]) || !upright.contains(&a[2]) {
                below += 1;
                continue;
            }
            let geometry = Geometry::folded(a[0], a[2], a[3] - a[1]);
            let entry = merged.entry(key(geometry)).or_insert_with(|| Merged {
                geometry,
                sum: vec![0.0; channels],
                count: 0,
            });
            entry.count += 1;
            entry.sum.iter_mut().zip(v).for_each(|(s, x)| *s += x);
        }
        if merged.is_empty() {
            return Err(CloudError::Empty { rows, below });
        }
        let luminance = basis.luminance_weights();
        Ok(Self {
            merged: rows - below - merged.len(),
            below_horizon: below,
            geometry: merged.values().map(|m| m.geometry).collect(),
            values: merged.into_values().flat_map(Merged::mean).collect(),
            basis,
            luminance,
        })
    }

    /// From an ASTM file. RGB columns are taken for Cornell's Trinitron set, whose white level brings them to
    /// BRDF scale; for other primaries use [`Self::from_astm_as`].
    ///
    /// # Errors
    /// As [`Self::new`], or if the kind of columns is unknown.
    pub fn from_astm(file: &AstmFile) -> Result<Self, CloudError> {
        Self::from_astm_as(file, RgbSpace::trinitron())
    }

    /// As [`Self::from_astm`], with the primaries and white level that RGB columns have.
    ///
    /// # Errors
    /// As [`Self::from_astm`].
    pub fn from_astm_as(file: &AstmFile, rgb: RgbSpace) -> Result<Self, CloudError> {
        let basis = match file.channels() {
            Channels::Rgb => Basis::Rgb(rgb),
            Channels::Xyz => Basis::Xyz,
            Channels::Wavelengths(nm) => Basis::Bands(nm.clone()),
            _ => return Err(CloudError::Channels),
        };
        let rows = 0..file.row_count();
        let angles: Vec<_> = rows.clone().map(|r| file.angles(r)).collect();
        let values: Vec<_> = rows.flat_map(|r| file.values(r)).copied().collect();
        Self::new(basis, &angles, &values)
    }

    /// From pbrt-v2's text form of the same data.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn from_pbrt_text(file: &PbrtTextFile) -> Result<Self, CloudError> {
        let basis = Basis::Bands(file.wavelengths_nm().to_vec());
        let rows = 0..file.row_count();
        let angles: Vec<_> = rows.clone().map(|r| file.angles(r)).collect();
        let values: Vec<_> = rows.flat_map(|r| file.values(r)).copied().collect();
        Self::new(basis, &angles, &values)
    }

    /// What the channels mean.
    #[must_use]
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// How many rows there are; at least one.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a cloud has at least one row")]
    pub fn len(&self) -> usize {
        self.geometry.len()
    }

    /// Where each row was measured.
    #[must_use]
    pub fn geometry(&self) -> &[Geometry] {
        &self.geometry
    }

    /// The values of a row, one a channel.
    ///
    /// # Panics
    /// If `row` is not below [`Self::len`].
    #[must_use]
    pub fn values(&self, row: usize) -> &[f64] {
        let n = self.basis.len();
        &self.values[row * n..(row + 1) * n]
    }

    /// Luminance of f_r in 1/sr at a row.
    ///
    /// # Panics
    /// If `row` is not below [`Self::len`].
    #[must_use]
    pub fn luminance(&self, row: usize) -> f64 {
        dot(self.values(row), &self.luminance)
    }

    /// Rows that were averaged into another at the same angles.
    #[must_use]
    pub fn merged(&self) -> usize {
        self.merged
    }

    /// Rows left out because a direction lies at or below the horizon.
    #[must_use]
    pub fn below_horizon(&self) -> usize {
        self.below_horizon
    }

    /// How many rows have a negative value in each channel.
    #[must_use]
    pub fn negatives(&self) -> Vec<usize> {
        let n = self.basis.len();
        let count = |c| {
            self.values
                .iter()
                .skip(c)
                .step_by(n)
                .filter(|&&v| v < 0.0)
                .count()
        };
        (0..n).map(count).collect()
    }

    /// The rows for which `keep` holds; `None` if there are none.
    #[must_use]
    pub fn filtered(&self, keep: impl Fn(usize, Geometry) -> bool) -> Option<Self> {
        let rows: Vec<usize> = (0..self.len())
            .filter(|&r| keep(r, self.geometry[r]))
            .collect();
        (!rows.is_empty()).then(|| Self {
            basis: self.basis.clone(),
            geometry: rows.iter().map(|&r| self.geometry[r]).collect(),
            values: rows.iter().flat_map(|&r| self.values(r)).copied().collect(),
            luminance: self.luminance.clone(),
            merged: self.merged,
            below_horizon: self.below_horizon,
        })
    }

    /// The row at these angles, to the print precision of the files.
    pub(crate) fn row_at(&self, at: Geometry) -> Option<usize> {
        let start = self
            .geometry
            .partition_point(|g| g.theta_i < at.theta_i - 2.0 * SAME_ANGLE);
        self.geometry[start..]
            .iter()
            .take_while(|g| g.theta_i <= at.theta_i + 2.0 * SAME_ANGLE)
            .position(|g| g.is_same(at))
            .map(|k| start + k)
    }

    /// The rows in other channels; `matrix` has one row a channel.
    /// The same rows with other channels: `factors` times the values, taken for channels of `basis`.
    ///
    /// # Errors
    /// If there are not as many factors and channels as the rows have.
    pub fn with_basis(&self, basis: Basis, factors: &[f64]) -> Result<Self, CloudError> {
        let channels = self.basis.len();
        if basis.len() != channels || factors.len() != channels {
            return Err(CloudError::Matrix {
                expected: channels,
                found: factors.len().min(basis.len()),
            });
        }
        let scaled =
            |row: &[f64]| -> Vec<f64> { row.iter().zip(factors).map(|(v, f)| v * f).collect() };
        Ok(Self {
            values: self
                .values
                .chunks_exact(channels)
                .flat_map(scaled)
                .collect(),
            luminance: basis.luminance_weights(),
            basis,
            ..self.clone()
        })
    }

    pub(crate) fn to_basis<const N: usize>(&self, basis: Basis, matrix: &[[f64; N]]) -> Self {
        let map = |row: usize| {
            let mut out = [0.0; N];
            for (v, m) in self.values(row).iter().zip(matrix) {
                (0..N).for_each(|c| out[c] += v * m[c]);
            }
            out
        };
        Self {
            values: (0..self.len()).flat_map(map).collect(),
            luminance: basis.luminance_weights(),
            basis,
            ..self.clone()
        }
    }

    pub(crate) fn luminance_weights(&self) -> &[f64] {
        &self.luminance
    }
}

/// Rows at the same angles.
struct Merged {
    geometry: Geometry,
    sum: Vec<f64>,
    count: u32,
}

impl Merged {
    fn mean(self) -> Vec<f64> {
        let n = f64::from(self.count);
        self.sum.into_iter().map(|s| s / n).collect()
    }
}

/// Angles in units of the print precision; azimuth means nothing at the pole.
fn key(g: Geometry) -> [i64; 3] {
    let unit = |x: f64| (x / SAME_ANGLE).round() as i64;
    let phi = if g.theta_i.min(g.theta_o) <= SAME_ANGLE {
        0.0
    } else {
        g.phi
    };
    [unit(g.theta_i), unit(g.theta_o), unit(phi)]
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
