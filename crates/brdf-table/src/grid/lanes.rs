//! The look-up renderers use: [`LANES`] pairs at once in single precision.
//!
//! The angles of all lanes are computed in straight loops without calls or branches, which the compiler
//! turns into SIMD; then each lane reads its nodes, `N` neighbouring floats each.
//!
//! Accuracy: roundings and polynomials displace the half vector wi + wo by at most 4e-7, hence theta_h by
//! 4e-7 / cos theta_d, theta_d by 4e-7 and phi_d by 4e-7 / (cos theta_d min(sin theta_h, sin theta_d)); the weighted sum
//! adds 1e-5 relative at most. What a displacement does to the value depends on the slope of the table, as it
//! does for any direction rounded to single precision: below 1e-4 relative between cells of white noise.

use crate::grid::fast_math::{atan2_upper, split};
use crate::grid::layout::{Layout, PhiDomain};
use crate::grid::lookup::Interpolation;
use crate::grid::node_rows::{FloatRows, NodeRows};
use brdf::{LANES, Lanes3};

type F32s = [f32; LANES];

/// Up to this many channels a table is read for all lanes together, beyond it lane by lane.
const GATHERED: usize = 4;

/// What does not change from one packet to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneLayout {
    layout: Layout,
    /// Cells per unit of theta_h (after squaring), theta_d and phi_d.
    scale: [f32; 3],
}

/// Squared node position along theta_h, and node-less positions along theta_d and phi_d, lane by lane.
struct Positions {
    u2: F32s,
    v: F32s,
    p: F32s,
}

/// Corner of each lane's cube and the place in it.
struct LaneStencils {
    base: [u32; LANES],
    t: [F32s; 3],
}

impl LaneLayout {
    pub(crate) fn new(layout: Layout) -> Self {
        let [n_h, n_d, n_p] = layout.dims.map(|n| n as f64);
        let quarter = std::f64::consts::FRAC_2_PI;
        Self {
            layout,
            scale: [
                (n_h * n_h * quarter) as f32,
                (n_d * quarter) as f32,
                (n_p / layout.phi.span()) as f32,
            ],
        }
    }

    /// Interpolates `nodes`, `N` floats each, for every lane; zero where a direction is not above the horizon.
    #[inline(always)]
    pub(crate) fn eval<const N: usize>(
        &self,
        nodes: &[f32],
        how: Interpolation,
        wi: &Lanes3,
        wo: &Lanes3,
    ) -> [F32s; N] {
        let mut out = if N > GATHERED {
            // lane by lane: the corners of all lanes together would not fit the registers, nor the first-level cache
            let (nodes, _) = nodes.as_chunks::<N>();
            let rows = self.rows(&FloatRows(nodes), how, wi, wo);
            std::array::from_fn(|c| std::array::from_fn(|k| rows[k][c]))
        } else {
            self.gathered(nodes, how, wi, wo)
        };
        for channel in &mut out {
            for k in 0..LANES {
                let above = wi.z[k] > 0.0 && wo.z[k] > 0.0;
                channel[k] = if above { channel[k] } else { 0.0 };
            }
        }
        out
    }

    /// The interpolated row of each lane; anything finite where a direction is not above the horizon.
    #[inline(always)]
    pub(crate) fn rows<R: NodeRows>(
        &self,
        nodes: &R,
        how: Interpolation,
        wi: &Lanes3,
        wo: &Lanes3,
    ) -> [R::Row; LANES] {
        match (how, self.layout.phi) {
            (Interpolation::Nearest, phi) => {
                let index = self.nearest(&self.positions(wi, wo, phi));
                index.map(|node| nodes.row(node as usize))
            }
            (Interpolation::Linear, PhiDomain::Mirror) => {
                let at = self.positions(wi, wo, PhiDomain::Mirror);
                blend_rows(nodes, &self.layout, &self.stencils(&at))
            }
            (Interpolation::Linear, phi) => {
                let at = self.positions(wi, wo, phi);
                blend_rows(nodes, &self.layout, &self.stencils(&at))
            }
        }
    }

    /// Few channels: all lanes at once.
    #[inline(always)]
    fn gathered<const N: usize>(
        &self,
        nodes: &[f32],
        how: Interpolation,
        wi: &Lanes3,
        wo: &Lanes3,
    ) -> [F32s; N] {
        let (nodes, _) = nodes.as_chunks::<N>();
        match (how, self.layout.phi) {
            (Interpolation::Nearest, phi) => {
                gather_nearest(nodes, &self.nearest(&self.positions(wi, wo, phi)))
            }
            // the domain as a constant: three small specialised bodies instead of selects per lane
            (Interpolation::Linear, PhiDomain::Reciprocal) => {
                self.linear(nodes, &self.positions(wi, wo, PhiDomain::Reciprocal))
            }
            (Interpolation::Linear, phi) => self.linear(nodes, &self.positions(wi, wo, phi)),
        }
    }

    /// Same formulas as [`crate::grid::lookup::angles`].
    #[inline(always)]
    fn positions(&self, wi: &Lanes3, wo: &Lanes3, phi: PhiDomain) -> Positions {
        let mut at = Positions {
            u2: [0.0; LANES],
            v: [0.0; LANES],
            p: [0.0; LANES],
        };
        let full = 2.0 * std::f32::consts::PI;
        for k in 0..LANES {
            let (hx, hy, hz) = (wi.x[k] + wo.x[k], wi.y[k] + wo.y[k], wi.z[k] + wo.z[k]);
            let (dx, dy, dz) = (wi.x[k] - wo.x[k], wi.y[k] - wo.y[k], wi.z[k] - wo.z[k]);
            let h_xy2 = hx * hx + hy * hy;
            let h_len = (h_xy2 + hz * hz).sqrt();
            let theta_h = atan2_upper(h_xy2.sqrt(), hz);
            let theta_d = atan2_upper((dx * dx + dy * dy + dz * dz).sqrt(), h_len);
            let y = (dy * hx - dx * hy) * h_len;
            let x = hz * (dx * hx + dy * hy) - h_xy2 * dz;
            let x = if phi == PhiDomain::Reciprocal && y < 0.0 {
                -x
            } else {
                x
            };
            let half_turn = atan2_upper(y.abs(), x);
            let phi_d = if phi == PhiDomain::Full && y < 0.0 {
                full - half_turn
            } else {
                half_turn
            };
            at.u2[k] = self.scale[0] * theta_h;
            at.v[k] = self.scale[1] * theta_d;
            at.p[k] = self.scale[2] * phi_d;
        }
        at
    }

    #[inline(always)]
    fn linear<const N: usize>(&self, nodes: &[[f32; N]], at: &Positions) -> [F32s; N] {
        gather_linear(nodes, &self.layout, &self.stencils(at))
    }

    #[inline(always)]
    fn stencils(&self, at: &Positions) -> LaneStencils {
        let mut out = LaneStencils {
            base: [0; LANES],
            t: [[0.0; LANES]; 3],
        };
        let [n_h, n_d, n_p] = self.layout.dims.map(|n| n as u32);
        let (slab, row) = (self.layout.slab() as u32, self.layout.row() as u32);
        for k in 0..LANES {
            let (u2, v) = (at.u2[k], at.v[k]);
            let h = if u2 < 0.25 { 4.0 * u2 } else { u2.sqrt() + 0.5 };
            let d = if v < 0.5 { 2.0 * v } else { v + 0.5 };
            let (h, t_h) = split(h, n_h);
            let (d, t_d) = split(d, n_d);
            let (p, t_p) = split(at.p[k] + 0.5, n_p + 1);
            out.base[k] = h * slab + d * row + p;
            out.t[0][k] = t_h.min(1.0);
            out.t[1][k] = t_d.min(1.0);
            out.t[2][k] = t_p.min(1.0);
        }
        out
    }

    #[inline(always)]
    fn nearest(&self, at: &Positions) -> [u32; LANES] {
        let [n_h, n_d, n_p] = self.layout.dims.map(|n| n as u32);
        let (slab, row) = (self.layout.slab() as u32, self.layout.row() as u32);
        std::array::from_fn(|k| {
            let h = split(at.u2[k].sqrt(), n_h).0;
            let d = split(at.v[k], n_d).0;
            let p = split(at.p[k], n_p + 1).0;
            (h + 1) * slab + (d + 1) * row + p + 1
        })
    }
}

/// Each lane's cube, row by row.
#[inline(always)]
fn blend_rows<R: NodeRows>(nodes: &R, layout: &Layout, at: &LaneStencils) -> [R::Row; LANES] {
    let (slab, row) = (layout.slab(), layout.row());
    let mut out = [R::ZERO; LANES];
    for k in 0..LANES {
        let [t_h, t_d, t_p] = [at.t[0][k], at.t[1][k], at.t[2][k]];
        let base = at.base[k] as usize;
        let pairs = [
            (base, (1.0 - t_h) * (1.0 - t_d)),
            (base + row, (1.0 - t_h) * t_d),
            (base + slab, t_h * (1.0 - t_d)),
            (base + slab + row, t_h * t_d),
        ];
        for (start, weight) in pairs {
            let weights = [weight * (1.0 - t_p), weight * t_p];
            nodes.add_pair(start, weights, &mut out[k]);
        }
    }
    out
}

#[inline(always)]
fn gather_nearest<const N: usize>(nodes: &[[f32; N]], index: &[u32; LANES]) -> [F32s; N] {
    let mut out = [[0.0; LANES]; N];
    for k in 0..LANES {
        let node = &nodes[index[k] as usize];
        for c in 0..N {
            out[c][k] = node[c];
        }
    }
    out
}

#[inline(always)]
fn gather_linear<const N: usize>(
    nodes: &[[f32; N]],
    layout: &Layout,
    at: &LaneStencils,
) -> [F32s; N] {
    // First all reads, so that the cache misses of all lanes overlap; then all arithmetic.
    let (slab, row) = (layout.slab(), layout.row());
    let mut corners = [[[[0.0; N]; 2]; 4]; LANES];
    for k in 0..LANES {
        let base = at.base[k] as usize;
        for (pair, start) in
            corners[k]
                .iter_mut()
                .zip([base, base + row, base + slab, base + slab + row])
        {
            pair.copy_from_slice(&nodes[start..start + 2]);
        }
    }
    let mut out = [[0.0; LANES]; N];
    for k in 0..LANES {
        let [t_h, t_d, t_p] = [at.t[0][k], at.t[1][k], at.t[2][k]];
        let weights = [
            (1.0 - t_h) * (1.0 - t_d),
            (1.0 - t_h) * t_d,
            t_h * (1.0 - t_d),
            t_h * t_d,
        ];
        for c in 0..N {
            let along = corners[k].map(|[low, high]| low[c] + t_p * (high[c] - low[c]));
            out[c][k] = along.iter().zip(weights).map(|(v, w)| w * v).sum();
        }
    }
    out
}
