//! Directional albedo by quadrature over the half vector, where lobes are wide in the variable.

use brdf::{Measured, direction};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The part of the light from everywhere that leaves toward `theta_o` (radians, below pi/2), per channel:
/// the integral of f_r cos(theta_i) over wi, `n * 4n` midpoints.
///
/// The variable is u = sqrt(theta_h / (pi/2)), in which the cells of a table are equally wide, and
/// dwi = 4 (wo.h) dwh. `n` of twice the theta_h cells resolves every table; the error of a smooth f is O(1/n^2).
/// Interpolants of scattered rows are smooth and cost microseconds a look-up: `n` = 48 is meant for them
/// (docs/interpolation.md).
///
/// Rings of theta_h are shared among threads and added in order: the result has the same bits on any number of them.
#[must_use]
pub fn directional_albedo<M: Measured + ?Sized>(measured: &M, theta_o: f64, n: usize) -> Vec<f64> {
    let wo = direction(theta_o, 0.0);
    let n = n.max(1);
    let rings: Vec<Vec<f64>> = (0..n)
        .into_par_iter()
        .map(|i| ring(measured, wo, i, n))
        .collect();
    let mut sum = vec![0.0; measured.basis().len()];
    for ring in rings {
        sum.iter_mut().zip(ring).for_each(|(s, r)| *s += r);
    }
    sum
}

/// The share of the `i`-th of `n` rings of half vectors.
fn ring<M: Measured + ?Sized>(measured: &M, wo: DVec3, i: usize, n: usize) -> Vec<f64> {
    let channels = measured.basis().len();
    let (mut sum, mut f) = (vec![0.0; channels], vec![0.0; channels]);
    let n_phi = 4 * n;
    let u = (i as f64 + 0.5) / n as f64;
    let theta_h = u * u * FRAC_PI_2;
    // dwh = sin(theta) dtheta dphi, dtheta = pi u du
    let area = theta_h.sin() * PI * u / n as f64 * TAU / n_phi as f64;
    for j in 0..n_phi {
        let h: DVec3 = direction(theta_h, TAU * (j as f64 + 0.5) / n_phi as f64);
        let cos_d = wo.dot(h);
        let wi = 2.0 * cos_d * h - wo;
        if cos_d <= 0.0 || wi.z <= 0.0 {
            continue;
        }
        measured.eval_native(wi, wo, &mut f);
        let weight = 4.0 * cos_d * wi.z * area;
        sum.iter_mut().zip(&f).for_each(|(s, v)| *s += weight * v);
    }
    sum
}
