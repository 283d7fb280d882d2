//! Sizes of a half-vector table, by name.

use super::optimise::Effort;
use super::shape::Shape;
use crate::target::Turning;

/// Named sizes; bytes are those of the finished table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Preset {
    /// 6 x 12 x 8 nodes, 1 KB.
    Tiny,
    /// 12 x 40 x 16 nodes, 9.9 KB.
    #[default]
    Default,
    /// 24 x 72 x 24 nodes, 49 KB.
    Fine,
    /// 32 x 96 x 32 nodes, 111 KB.
    Reference,
}

/// How a [`super::Hvt`] is built. For anisotropic targets `n_b` is doubled (to at most [`MAX_B`]) and `n_a` cut to 5/8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HvtOptions {
    /// Slices of the viewer's elevation, at least 2.
    pub n_theta: usize,
    /// Slices of its azimuth in half a turn, at least 2; used for anisotropic targets.
    pub n_phi: usize,
    /// Nodes along the radial half-vector coordinate, at least 3.
    pub n_a: usize,
    /// Nodes along its azimuth: 8, 16, 24 or [`MAX_B`]; others are rounded up.
    pub n_b: usize,
    /// Radial scale of the chart in radians of theta_h; `None` tries several and keeps the best.
    pub r0: Option<f64>,
    /// Newton steps of the optimisation.
    pub newton: usize,
}

/// Most nodes across.
pub const MAX_B: usize = 32;

impl Preset {
    /// All presets, smallest first.
    pub const ALL: [Self; 4] = [Self::Tiny, Self::Default, Self::Fine, Self::Reference];

    /// The sizes.
    #[must_use]
    pub fn options(self) -> HvtOptions {
        let (n_theta, n_phi, n_a, n_b) = match self {
            Self::Tiny => (6, 6, 12, 8),
            Self::Default => (12, 12, 40, 16),
            Self::Fine => (24, 16, 72, 24),
            Self::Reference => (32, 24, 96, 32),
        };
        HvtOptions {
            n_theta,
            n_phi,
            n_a,
            n_b,
            r0: None,
            newton: 3,
        }
    }
}

impl HvtOptions {
    pub(crate) fn shape(&self, turning: Turning) -> Shape {
        let n_phi = self.n_phi.clamp(2, 1 << 8);
        // lobes longer than wide turn on the chart: azimuths are worth more nodes, by measurement
        let (n_a, n_b) = match turning {
            Turning::Isotropic => (self.n_a, self.n_b),
            _ => (5 * self.n_a / 8, 2 * self.n_b),
        };
        Shape {
            n_theta: self.n_theta.clamp(2, 1 << 10),
            n_phi: match turning {
                Turning::Isotropic => 1,
                Turning::HalfTurn => n_phi,
                Turning::FullTurn => 2 * n_phi,
            },
            half_turn: turning == Turning::HalfTurn,
            n_a: n_a.clamp(3, 1 << 12),
            n_b: n_b.clamp(1, MAX_B).next_multiple_of(8),
        }
    }

    pub(crate) fn effort(&self) -> Effort {
        Effort {
            multiplicative: 4,
            newton: self.newton,
            gradients: 8,
        }
    }
}
