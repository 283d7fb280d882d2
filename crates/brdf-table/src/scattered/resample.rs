//! From an interpolant to the grid that rendering reads.

use crate::grid::{HalfDiffTable, Interpolation, PhiDomain};
use crate::scattered::cloud::{Geometry, dot};
use crate::scattered::domain::Domain;
use brdf::Measured;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Cells along theta_h, theta_d and phi_d that keep the error of both Cornell paints below 1 % (docs/interpolation.md).
pub const DEFAULT_DIMS: [usize; 3] = [90, 120, 48];

/// A grid made from an interpolant, and how far it is from it.
#[derive(Clone, Debug)]
pub struct Resampled {
    /// Not reciprocal, mirror-symmetric.
    pub table: HalfDiffTable,
    /// Root mean square difference of luminance between grid (trilinear) and interpolant over the measured region,
    /// both directions cosine-weighted.
    pub rms_error: f64,
    /// Mean luminance of the interpolant, weighted alike.
    pub mean: f64,
}

impl Resampled {
    /// RMS error as a part of the mean.
    #[must_use]
    pub fn relative_error(&self) -> f64 {
        if self.mean > 0.0 {
            self.rms_error / self.mean
        } else {
            self.rms_error
        }
    }
}

/// Evaluates `measured` on a grid of `dims` cells and compares the two at pairs within `domain`.
#[must_use]
pub fn resample(measured: &dyn Measured, domain: &Domain, dims: [usize; 3]) -> Resampled {
    let basis = measured.basis().clone();
    let weights = basis.luminance_weights();
    let table = HalfDiffTable::from_fn(dims, PhiDomain::Mirror, basis, |wi, wo, out| {
        measured.eval_native(wi, wo, out)
    });
    let probe = |k: u32| {
        let geometry = pair(k, domain)?;
        let (wi, wo) = geometry.directions();
        let (mut want, mut have) = (vec![0.0; weights.len()], vec![0.0; weights.len()]);
        measured.eval_native(wi, wo, &mut want);
        table.eval(wi, wo, Interpolation::Linear, &mut have);
        let (want, have) = (dot(&want, &weights), dot(&have, &weights));
        Some([1.0, want, (have - want) * (have - want)])
    };
    let add = |a: [f64; 3], b: [f64; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    // in blocks of fixed size, so that the sums do not depend on the number of threads
    let blocks: Vec<[f64; 3]> = (0..PROBES / BLOCK)
        .into_par_iter()
        .map(|b| {
            (b * BLOCK..(b + 1) * BLOCK)
                .filter_map(probe)
                .fold([0.0; 3], add)
        })
        .collect();
    let [n, sum, squares] = blocks.into_iter().fold([0.0; 3], add);
    let n = n.max(1.0);
    Resampled {
        table,
        rms_error: (squares / n).sqrt(),
        mean: sum / n,
    }
}

const PROBES: u32 = 1 << 13;
const BLOCK: u32 = 1 << 9;

/// The k-th of evenly spread pairs (the Kronecker sequence of [Roberts2018]), cosine-weighted.
fn pair(k: u32, domain: &Domain) -> Option<Geometry> {
    const STEP: [f64; 3] = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_3,
    ];
    let u = STEP.map(|s| (0.5 + s * f64::from(k)).fract());
    let theta = |u: f64, [low, high]: [f64; 2]| {
        let (a, b) = (low.sin().powi(2), high.sin().powi(2));
        (a + (b - a) * u).sqrt().min(1.0).asin()
    };
    let geometry = Geometry {
        theta_i: theta(u[0], domain.theta_i),
        theta_o: theta(u[1], domain.theta_o),
        phi: PI * u[2],
    };
    domain.contains(geometry).then_some(geometry)
}
