//! The MERL grid: theta_h by its square root, theta_d, phi_d.

use brdf::{Brdf, HalfDiff};
use brdf_formats::{MERL_SCALE, MerlFile};
use glam::DVec3;
use rayon::prelude::*;
use sampling::Rng;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::{Instrument, MeasureError};

/// theta_h, theta_d, phi_d cells of the published files.
pub const MERL_DIMS: [u32; 3] = [90, 90, 180];

/// What the published files hold where nothing was measured, unscaled.
const MISSING: f64 = -1.0;

/// phi_d cells of the layout's variant for reflectance that is not reciprocal: phi_d in [0, 2 pi).
const FULL_CIRCLE: u32 = 360;

/// Measures linear RGB `brdf` at the centres of the cells of a MERL file, into its units.
///
/// Cell (h, d, p) of `dims` has its centre at theta_h = ((h + 1/2)/n_h)^2 pi/2, theta_d = (d + 1/2)/n_d pi/2,
/// phi_d = (p + 1/2)/n_p pi, or 2 pi with 360 cells. With fewer, the layout takes reciprocity for granted:
/// each cell is measured with phi_d of the light in [0, pi) and stands for the swapped pair as well.
/// The layout is isotropic: the half vector has azimuth 0.
///
/// A cell both of whose directions are above the horizon holds its value. Its neighbours one bin further,
/// which interpolation needs, hold the value a quarter of a bin above the horizon at the same theta_h and
/// phi_d. All others hold -1.
///
/// # Errors
/// If a dimension is zero or too large, or the instrument is impossible.
pub fn measure_merl(
    brdf: &dyn Brdf<3>,
    dims: [u32; 3],
    instrument: &Instrument,
    seed: u64,
) -> Result<MerlFile, MeasureError> {
    instrument.check()?;
    // An empty file has the header and is the cheapest check of the dims.
    let mut bytes = MerlFile::from_fn(dims, |_, _| MISSING)?.to_bytes();
    let grid = Grid::new(dims);
    let row = 8 * grid.row_len();
    let (_, planes) = bytes.split_at_mut(HEADER);
    let (red, rest) = planes.split_at_mut(row * grid.theta_h.len());
    let (green, blue) = rest.split_at_mut(row * grid.theta_h.len());
    red.par_chunks_exact_mut(row)
        .zip(green.par_chunks_exact_mut(row))
        .zip(blue.par_chunks_exact_mut(row))
        .enumerate()
        .for_each(|(h, ((r, g), b))| {
            // a stream a row: what a thread does depends on the row alone
            let mut rng = Rng::stream(seed, h as u64);
            for (k, (wi, wo)) in grid.row(h) {
                let f = brdf.eval(wi, wo);
                for (c, plane) in [&mut *r, &mut *g, &mut *b].into_iter().enumerate() {
                    let value = instrument.read(f[c], wi.z, &mut rng) / MERL_SCALE[c];
                    plane[8 * k..8 * k + 8].copy_from_slice(&value.to_le_bytes());
                }
            }
        });
    Ok(MerlFile::from_bytes(bytes)?)
}

/// Bytes before the first plane.
const HEADER: usize = 12;

/// The centres of the cells.
struct Grid {
    theta_h: Vec<f64>,
    theta_d: Vec<f64>,
    phi_d: Vec<f64>,
}

impl Grid {
    fn new(dims: [u32; 3]) -> Self {
        let centres = |n: u32, f: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (0..n)
                .map(|k| f((f64::from(k) + 0.5) / f64::from(n)))
                .collect()
        };
        let circle = if dims[2] == FULL_CIRCLE { TAU } else { PI };
        Self {
            theta_h: centres(dims[0], &|t| t * t * FRAC_PI_2),
            theta_d: centres(dims[1], &|t| t * FRAC_PI_2),
            phi_d: centres(dims[2], &|t| t * circle),
        }
    }

    /// Cells of one theta_h.
    fn row_len(&self) -> usize {
        self.theta_d.len() * self.phi_d.len()
    }

    /// Position and directions of the cells of theta_h number `h` that are measured.
    fn row(&self, h: usize) -> impl Iterator<Item = (usize, (DVec3, DVec3))> + '_ {
        let n = self.phi_d.len();
        (0..self.row_len()).filter_map(move |k| self.pair(h, k / n, k % n).map(|p| (k, p)))
    }

    /// The directions cell (h, d, p) is measured at; `None` if nothing is above the horizon near it.
    fn pair(&self, h: usize, d: usize, p: usize) -> Option<(DVec3, DVec3)> {
        let theta_h = self.theta_h[h];
        let horizon = horizon(theta_h, self.phi_d[p]);
        let bin = FRAC_PI_2 / self.theta_d.len() as f64;
        let theta_d = if self.theta_d[d] < horizon {
            self.theta_d[d]
        } else {
            if !self.touches(h, d, p) {
                return None;
            }
            (horizon - 0.25 * bin).max(0.5 * horizon)
        };
        let angles = HalfDiff {
            theta_h,
            theta_d,
            phi_d: self.phi_d[p],
        };
        Some(angles.directions())
    }

    /// Whether a neighbouring cell, diagonals included, has its centre above the horizon.
    ///
    /// The horizon falls with theta_h and with |cos phi_d|, so the neighbours that count have one theta_h
    /// and one theta_d less.
    fn touches(&self, h: usize, d: usize, p: usize) -> bool {
        let n = self.phi_d.len();
        let (theta_h, theta_d) = (
            self.theta_h[h.saturating_sub(1)],
            self.theta_d[d.saturating_sub(1)],
        );
        [p + n - 1, p, p + 1]
            .iter()
            .any(|p| theta_d < horizon(theta_h, self.phi_d[p % n]))
    }
}

/// The theta_d at which the lower of the two directions meets the horizon:
/// cos h cos d - sin h sin d |cos phi| = 0.
fn horizon(theta_h: f64, phi_d: f64) -> f64 {
    let (sin, cos) = theta_h.sin_cos();
    cos.atan2(sin * phi_d.cos().abs())
}
