//! The spaces densities live on, each with a rectangular chart.

use std::f64::consts::{FRAC_PI_2, PI};

/// Where a density is defined, and per which measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Domain {
    /// Unit vectors with z >= 0, per solid angle; chart (theta, phi).
    #[default]
    Hemisphere,
    /// Unit vectors, per solid angle; chart (theta, phi).
    Sphere,
    /// Points of the unit disk in the plane z = 0, per area; chart (r, phi).
    Disk,
    /// Points of the unit square in the plane z = 0, per area; the chart is the square itself.
    Square,
}

/// An axis-parallel rectangle of a chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Smallest coordinates.
    pub min: [f64; 2],
    /// Largest coordinates.
    pub max: [f64; 2],
}

impl Rect {
    /// Edge lengths.
    #[must_use]
    pub fn size(&self) -> [f64; 2] {
        [self.max[0] - self.min[0], self.max[1] - self.min[1]]
    }

    /// The lower and the upper half along `axis` (0 or 1).
    #[must_use]
    pub fn halves(&self, axis: usize) -> [Self; 2] {
        let middle = 0.5 * (self.min[axis] + self.max[axis]);
        let (mut low, mut high) = (*self, *self);
        low.max[axis] = middle;
        high.min[axis] = middle;
        [low, high]
    }
}

impl Domain {
    /// The whole chart.
    #[must_use]
    pub fn chart(self) -> Rect {
        let (min, max) = match self {
            Self::Hemisphere => ([0.0, -PI], [FRAC_PI_2, PI]),
            Self::Sphere => ([0.0, -PI], [PI, PI]),
            Self::Disk => ([0.0, -PI], [1.0, PI]),
            Self::Square => ([0.0, 0.0], [1.0, 1.0]),
        };
        Rect { min, max }
    }

    /// Chart coordinates of a point.
    #[must_use]
    pub fn to_chart(self, p: [f64; 3]) -> [f64; 2] {
        let [x, y, z] = p;
        match self {
            Self::Hemisphere | Self::Sphere => [x.hypot(y).atan2(z), y.atan2(x)],
            Self::Disk => [x.hypot(y), y.atan2(x)],
            Self::Square => [x, y],
        }
    }

    /// The point at chart coordinates, and what a unit area of the chart there measures in the domain.
    #[must_use]
    pub fn at(self, c: [f64; 2]) -> ([f64; 3], f64) {
        let (s, cos) = c[1].sin_cos();
        match self {
            Self::Hemisphere | Self::Sphere => {
                let (st, ct) = c[0].sin_cos();
                ([st * cos, st * s, ct], st)
            }
            Self::Disk => ([c[0] * cos, c[0] * s, 0.0], c[0]),
            Self::Square => ([c[0], c[1], 0.0], 1.0),
        }
    }

    /// Whether `p` belongs to the domain, up to rounding (1e-6, so that f32 samplers pass).
    #[must_use]
    pub fn contains(self, p: [f64; 3]) -> bool {
        const SLACK: f64 = 1e-6;
        let [x, y, z] = p;
        let length = x.hypot(y).hypot(z);
        match self {
            Self::Hemisphere => (length - 1.0).abs() < SLACK && z >= -SLACK,
            Self::Sphere => (length - 1.0).abs() < SLACK,
            Self::Disk => z.abs() < SLACK && length < 1.0 + SLACK,
            Self::Square => [x, y].iter().all(|v| (-SLACK..1.0 + SLACK).contains(v)),
        }
    }
}
