//! The reference look-up in double precision: nearest cell, or trilinear between centres.

use crate::grid::layout::{Layout, PhiDomain, Stencil};
use crate::grid::table::HalfDiffTable;
use brdf::{HalfDiff, Status};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// How a table is read between its cell centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// The value of the cell that contains the angles, as in the thesis and in MERL's own sample code.
    Nearest,
    /// Trilinear in (sqrt theta_h, theta_d, phi_d) between cell centres; continuous everywhere.
    #[default]
    Linear,
}

/// Weights this close to a node count as lying on it.
const ON_NODE: f64 = 1e-9;

impl HalfDiffTable {
    /// f_r(wi, wo) in 1/sr into `out`, and where it came from: [`Status::Measured`] on a valid cell (centre),
    /// [`Status::Filled`] if any cell that contributes was not measured, else [`Status::Interpolated`].
    ///
    /// Zero and [`Status::Filled`] where either direction is at or below the horizon. Only the common
    /// entries are written if `out` and the channels differ in number.
    pub fn eval(&self, wi: DVec3, wo: DVec3, how: Interpolation, out: &mut [f64]) -> Status {
        if wi.z > 0.0 && wo.z > 0.0 {
            self.eval_angles(angles(wi, wo, self.phi_domain()), how, out)
        } else {
            out.fill(0.0);
            Status::Filled
        }
    }

    /// [`Self::eval`] at given angles, whether or not they belong to directions above the horizon.
    /// Any real `phi_d` is brought into the range of the table; theta_h and theta_d are clamped to it.
    pub fn eval_angles(&self, angles: HalfDiff, how: Interpolation, out: &mut [f64]) -> Status {
        let angles = HalfDiff {
            phi_d: fold(angles.phi_d, self.phi_domain()),
            ..angles
        };
        let layout = self.layout();
        out.fill(0.0);
        match how {
            Interpolation::Nearest => {
                let node = layout.nearest(angles);
                self.add(node, 1.0, out);
                if self.mask().get(node) {
                    Status::Measured
                } else {
                    Status::Filled
                }
            }
            Interpolation::Linear => self.blend(layout, layout.stencil(angles), out),
        }
    }

    fn blend(&self, layout: Layout, stencil: Stencil, out: &mut [f64]) -> Status {
        let mut valid = true;
        for corner in 0..8 {
            let pick = [corner >> 2, corner >> 1 & 1, corner & 1];
            let mut weight = 1.0;
            for (t, side) in stencil.t.into_iter().zip(pick) {
                weight *= if side == 1 { t } else { 1.0 - t };
            }
            if weight > 0.0 {
                let node =
                    stencil.base + pick[0] * layout.slab() + pick[1] * layout.row() + pick[2];
                self.add(node, weight, out);
                valid &= weight < ON_NODE || self.mask().get(node);
            }
        }
        let on_node = stencil.t.iter().all(|t| t.min(1.0 - t) < ON_NODE);
        match (valid, on_node) {
            (false, _) => Status::Filled,
            (true, true) => Status::Measured,
            (true, false) => Status::Interpolated,
        }
    }

    fn add(&self, node: usize, weight: f64, out: &mut [f64]) {
        for (o, v) in out.iter_mut().zip(self.node_values(node)) {
            *o += weight * f64::from(*v);
        }
    }
}

/// The angles of a pair, phi_d in [0, span] of the domain.
///
/// With h' = wi + wo and d' = wi - wo, the azimuth of d' about h' is that of
/// (h'_z (d'_xy . h'_xy) - |h'_xy|^2 d'_z, (d'_y h'_x - d'_x h'_y) |h'|). (For exact unit vectors the first is -d'_z |h'|^2; that
/// shorter form loses digits where theta_h and theta_d are both small.) Swapping wi and wo flips both
/// exactly, so folding before the arc tangent makes the reciprocal case reciprocal to the last bit.
pub(crate) fn angles(wi: DVec3, wo: DVec3, phi: PhiDomain) -> HalfDiff {
    let (h, d) = (wi + wo, wi - wo);
    let h_xy = h.x.hypot(h.y);
    let h_len = h_xy.hypot(h.z);
    let y = (d.y * h.x - d.x * h.y) * h_len;
    let x = h.z * (d.x * h.x + d.y * h.y) - h_xy * h_xy * d.z;
    let phi_d = match phi {
        PhiDomain::Reciprocal if y < 0.0 => (-y).atan2(-x),
        PhiDomain::Reciprocal if y == 0.0 => 0.0, // 0 and pi are one
        PhiDomain::Mirror => y.abs().atan2(x),
        PhiDomain::Full if y < 0.0 => TAU - (-y).atan2(x),
        _ => y.atan2(x),
    };
    HalfDiff {
        theta_h: h_xy.atan2(h.z),
        theta_d: d.length().atan2(h_len),
        phi_d,
    }
}

/// Any azimuth brought into [0, span] of the domain.
fn fold(phi_d: f64, phi: PhiDomain) -> f64 {
    match phi {
        PhiDomain::Reciprocal => phi_d.rem_euclid(PI),
        PhiDomain::Full => phi_d.rem_euclid(TAU),
        PhiDomain::Mirror => {
            let turn = phi_d.rem_euclid(TAU);
            if turn > PI { TAU - turn } else { turn }
        }
    }
}
