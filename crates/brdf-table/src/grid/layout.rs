//! Where cells and nodes lie: indices, centres, and positions of angles between them.
//!
//! A table of `[n_h, n_d, n_p]` cells is stored as `(n_h + 1) x (n_d + 1) x (n_p + 2)` *nodes*, so that
//! interpolation never branches at an edge: node 0 of theta_h and of theta_d lies exactly on the pole and
//! holds the mean over phi_d; node `k + 1` is the centre of cell `k`; the first and the last node
//! of phi_d repeat the neighbour across the wrap (or the mirror).

use brdf::HalfDiff;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};

/// Which azimuths of the difference vector a table stores, and how the others follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhiDomain {
    /// [0, pi), period pi: phi_d and phi_d + pi are the two orders of one pair, so the table is reciprocal.
    Reciprocal,
    /// [0, pi] with f(-phi_d) = f(phi_d): bilateral symmetry, not reciprocity.
    Mirror,
    /// [0, 2 pi), no symmetry assumed.
    Full,
}

impl PhiDomain {
    /// The stored range of phi_d in radians.
    #[must_use]
    pub const fn span(self) -> f64 {
        match self {
            Self::Reciprocal | Self::Mirror => PI,
            Self::Full => TAU,
        }
    }
}

/// Index arithmetic of one table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Cells along theta_h, theta_d, phi_d.
    pub(crate) dims: [usize; 3],
    /// Meaning of the last axis.
    pub(crate) phi: PhiDomain,
}

/// The lowest node of a cube of eight, and where in the cube a point lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stencil {
    /// Index of the corner with the smallest theta_h, theta_d and phi_d.
    pub(crate) base: usize,
    /// Position along each axis, [0, 1].
    pub(crate) t: [f64; 3],
}

impl Layout {
    /// Nodes along phi_d.
    pub(crate) const fn row(&self) -> usize {
        self.dims[2] + 2
    }

    /// Nodes of one theta_h.
    pub(crate) const fn slab(&self) -> usize {
        (self.dims[1] + 1) * self.row()
    }

    /// All nodes.
    pub(crate) const fn nodes(&self) -> usize {
        (self.dims[0] + 1) * self.slab()
    }

    /// All cells.
    pub(crate) const fn cells(&self) -> usize {
        self.dims[0] * self.dims[1] * self.dims[2]
    }

    /// Nodes and cells counted without overflow: `None` if `channels` floats a node can't be addressed.
    pub(crate) fn checked(dims: [usize; 3], phi: PhiDomain, channels: usize) -> Option<Self> {
        if dims.contains(&0) || channels == 0 {
            return None;
        }
        let nodes = dims[0]
            .checked_add(1)?
            .checked_mul(dims[1].checked_add(1)?)?
            .checked_mul(dims[2].checked_add(2)?)?;
        let bytes = nodes.checked_mul(channels)?.checked_mul(size_of::<f64>())?;
        isize::try_from(bytes).ok()?;
        u32::try_from(nodes).ok()?; // lanes address nodes with 32 bits
        Some(Self { dims, phi })
    }

    /// Index of the cell in file order: phi_d fastest, theta_h slowest.
    pub(crate) const fn cell(&self, [h, d, p]: [usize; 3]) -> usize {
        p + self.dims[2] * (d + self.dims[1] * h)
    }

    /// The cell with a given index.
    pub(crate) const fn unravel(&self, cell: usize) -> [usize; 3] {
        let [_, n_d, n_p] = self.dims;
        [cell / (n_d * n_p), cell / n_p % n_d, cell % n_p]
    }

    /// Index of the node at the centre of a cell.
    pub(crate) const fn node(&self, [h, d, p]: [usize; 3]) -> usize {
        (h + 1) * self.slab() + (d + 1) * self.row() + p + 1
    }

    /// Angles at the centre of a cell.
    pub(crate) fn centre(&self, [h, d, p]: [usize; 3]) -> HalfDiff {
        let at = |k: usize, n: usize| (k as f64 + 0.5) / n as f64;
        let u = at(h, self.dims[0]);
        HalfDiff {
            theta_h: u * u * FRAC_PI_2,
            theta_d: at(d, self.dims[1]) * FRAC_PI_2,
            phi_d: at(p, self.dims[2]) * self.phi.span(),
        }
    }

    /// The eight nodes around `angles`; `phi_d` in [0, span].
    ///
    /// Linear in sqrt(theta_h) between centres. Between the pole and the first centre it is linear in
    /// theta_h itself: sqrt has infinite slope at 0 and would blow up rounding there.
    pub(crate) fn stencil(&self, angles: HalfDiff) -> Stencil {
        let [n_h, n_d, n_p] = self.dims.map(|n| n as f64);
        let u2 = n_h * n_h * FRAC_2_PI * angles.theta_h;
        let h = if u2 < 0.25 { 4.0 * u2 } else { u2.sqrt() + 0.5 };
        let v = n_d * FRAC_2_PI * angles.theta_d;
        let d = if v < 0.5 { 2.0 * v } else { v + 0.5 };
        let p = n_p / self.phi.span() * angles.phi_d + 0.5;
        let (h, t_h) = split(h, self.dims[0]);
        let (d, t_d) = split(d, self.dims[1]);
        let (p, t_p) = split(p, self.dims[2] + 1);
        Stencil {
            base: h * self.slab() + d * self.row() + p,
            t: [t_h, t_d, t_p],
        }
    }

    /// The node of the cell that contains `angles`; `phi_d` in [0, span].
    pub(crate) fn nearest(&self, angles: HalfDiff) -> usize {
        let [n_h, n_d, n_p] = self.dims.map(|n| n as f64);
        let h = n_h * (FRAC_2_PI * angles.theta_h).sqrt();
        let d = n_d * FRAC_2_PI * angles.theta_d;
        let p = n_p / self.phi.span() * angles.phi_d;
        self.node([
            (h as usize).min(self.dims[0] - 1),
            (d as usize).min(self.dims[1] - 1),
            (p as usize).min(self.dims[2]), // one past the end repeats the first, or the last if mirrored
        ])
    }

    /// `90 x 90 x 180 (Reciprocal)`.
    pub(crate) fn describe(&self) -> String {
        let [h, d, p] = self.dims;
        format!("{h} x {d} x {p} ({:?})", self.phi)
    }
}

/// Whole and fractional part of a node position, so that whole + 1 <= last and the fraction is in [0, 1].
fn split(position: f64, last: usize) -> (usize, f64) {
    let whole = (position.max(0.0) as usize).min(last - 1);
    (whole, (position - whole as f64).clamp(0.0, 1.0))
}
