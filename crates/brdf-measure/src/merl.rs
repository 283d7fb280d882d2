//! The MERL grid: theta_h by its square root, theta_d, phi_d.

use brdf::Brdf;
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
/// If the grid is empty or too large, or the instrument is impossible.
pub fn measure_merl(
    brdf: &dyn Brdf<3>,
    dims: [u32; 3],
    instrument: &Instrument,
    seed: u64,
) -> Result<MerlFile, MeasureError> {
    instrument.check()?;
    let mut bytes = empty(dims)?;
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
            for k in 0..grid.row_len() {
                let value = grid.pair(h, k).map_or([MISSING; 3], |(wi, wo)| {
                    let f = brdf.eval(wi, wo);
                    std::array::from_fn(|c| instrument.read(f[c], wi.z, &mut rng) / MERL_SCALE[c])
                });
                for (plane, value) in [&mut *r, &mut *g, &mut *b].into_iter().zip(value) {
                    plane[8 * k..8 * k + 8].copy_from_slice(&value.to_le_bytes());
                }
            }
        });
    Ok(MerlFile::from_bytes(bytes)?)
}

/// Bytes before the first plane.
const HEADER: usize = 12;

/// A file of these dims with zeros for values: its bytes.
fn empty(dims: [u32; 3]) -> Result<Vec<u8>, MeasureError> {
    let cells = dims
        .iter()
        .try_fold(1_usize, |n, &d| n.checked_mul(d as usize));
    let len = cells
        .and_then(|n| n.checked_mul(24))
        .and_then(|n| n.checked_add(HEADER));
    let len = len.filter(|&n| n > HEADER && isize::try_from(n).is_ok());
    let len = len.ok_or(MeasureError::Grid(dims))?;
    // asks politely first: the zeroed allocation below would abort
    Vec::<u8>::new()
        .try_reserve_exact(len)
        .map_err(|_| MeasureError::Grid(dims))?;
    let mut bytes = vec![0; len];
    for (field, d) in bytes.chunks_exact_mut(4).zip(dims) {
        field.copy_from_slice(&d.to_le_bytes());
    }
    Ok(bytes)
}

/// An angle with its sine and cosine.
#[derive(Clone, Copy)]
struct Angle {
    sin: f64,
    cos: f64,
}

impl Angle {
    fn new(value: f64) -> Self {
        let (sin, cos) = value.sin_cos();
        Self { sin, cos }
    }
}

/// The centres of the cells.
struct Grid {
    theta_h: Vec<Angle>,
    theta_d: Vec<Angle>,
    phi_d: Vec<Angle>,
}

impl Grid {
    fn new(dims: [u32; 3]) -> Self {
        let centres = |n: u32, f: &dyn Fn(f64) -> f64| -> Vec<Angle> {
            let centre = |k| f((f64::from(k) + 0.5) / f64::from(n));
            (0..n).map(|k| Angle::new(centre(k))).collect()
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

    /// The directions at which cell `k` of theta_h number `h` is measured; `None` if nothing near it is above
    /// the horizon.
    fn pair(&self, h: usize, k: usize) -> Option<(DVec3, DVec3)> {
        let (d, p) = (k / self.phi_d.len(), k % self.phi_d.len());
        let (theta_h, theta_d, phi_d) = (self.theta_h[h], self.theta_d[d], self.phi_d[p]);
        if above(theta_h, theta_d, phi_d) {
            return Some(directions(theta_h, theta_d, phi_d));
        }
        if !self.touches(h, d, p) {
            return None;
        }
        // the theta_d at which the lower direction meets the horizon
        let horizon = theta_h.cos.atan2(theta_h.sin * phi_d.cos.abs());
        let bin = FRAC_PI_2 / self.theta_d.len() as f64;
        let theta_d = Angle::new((horizon - 0.25 * bin).max(0.5 * horizon));
        Some(directions(theta_h, theta_d, phi_d))
    }

    /// Whether a neighbouring cell, diagonals included, has its centre above the horizon.
    ///
    /// The lower direction sinks with theta_h and theta_d, so the neighbours that count have one less of each.
    fn touches(&self, h: usize, d: usize, p: usize) -> bool {
        let n = self.phi_d.len();
        let theta_h = self.theta_h[h.saturating_sub(1)];
        let theta_d = self.theta_d[d.saturating_sub(1)];
        let mut beside = [p + n - 1, p, p + 1].into_iter();
        beside.any(|p| above(theta_h, theta_d, self.phi_d[p % n]))
    }
}

/// Whether the lower of the two directions is above the horizon.
fn above(theta_h: Angle, theta_d: Angle, phi_d: Angle) -> bool {
    theta_h.cos * theta_d.cos > theta_h.sin * theta_d.sin * phi_d.cos.abs()
}

/// [`brdf::HalfDiff::directions`] with the sines and cosines at hand.
fn directions(theta_h: Angle, theta_d: Angle, phi_d: Angle) -> (DVec3, DVec3) {
    let (dx, dy, dz) = (
        theta_d.sin * phi_d.cos,
        theta_d.sin * phi_d.sin,
        theta_d.cos,
    );
    let (along, across) = (theta_h.sin * dz, theta_h.cos * dx);
    let (up, tilt) = (theta_h.cos * dz, theta_h.sin * dx);
    (
        DVec3::new(along + across, dy, up - tilt),
        DVec3::new(along - across, -dy, up + tilt),
    )
}
