//! The slices of the known direction: where a sampler has tables, and how it blends them.

use brdf::direction;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The last slice sits this far above the horizon, radians (0.1 degree): at the horizon f cos has no shape.
const RIM: f64 = 0.1 * std::f64::consts::PI / 180.0;

/// Viewer directions: theta_o evenly spaced from the normal to the horizon; one azimuth for isotropic targets,
/// evenly spaced azimuths otherwise. Index = azimuth * n_theta + theta.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct KnownGrid {
    pub(crate) n_theta: usize,
    pub(crate) n_phi: usize,
}

/// Slices around one viewer direction with weights that add to 1.
pub(crate) type Blend = [(usize, f64); 4];

impl KnownGrid {
    /// At least two elevations and one azimuth.
    pub(crate) fn new(n_theta: usize, n_phi: usize) -> Self {
        Self {
            n_theta: n_theta.max(2),
            n_phi: n_phi.max(1),
        }
    }

    pub(crate) fn len(self) -> usize {
        self.n_theta * self.n_phi
    }

    /// Polar angle and azimuth of slice `k`, radians.
    pub(crate) fn angles(self, k: usize) -> (f64, f64) {
        let step = FRAC_PI_2 / (self.n_theta - 1) as f64;
        let theta = ((k % self.n_theta) as f64 * step).min(FRAC_PI_2 - RIM);
        let phi = TAU * (k / self.n_theta) as f64 / self.n_phi as f64;
        (theta, phi)
    }

    /// The viewer direction of slice `k`.
    pub(crate) fn viewer(self, k: usize) -> DVec3 {
        let (theta, phi) = self.angles(k);
        direction(theta, phi)
    }

    /// The slices whose bilinear blend stands for `wo`; weights >= 0, sum 1.
    pub(crate) fn blend(self, wo: DVec3) -> Blend {
        let theta = wo.x.hypot(wo.y).atan2(wo.z);
        let x = (theta / FRAC_PI_2).clamp(0.0, 1.0) * (self.n_theta - 1) as f64;
        let i = (x as usize).min(self.n_theta - 2);
        let t = x - i as f64;
        if self.n_phi == 1 {
            return [(i, 1.0 - t), (i + 1, t), (i, 0.0), (i, 0.0)];
        }
        let y = (wo.y.atan2(wo.x) / TAU).rem_euclid(1.0) * self.n_phi as f64;
        let j = (y as usize).min(self.n_phi - 1);
        let (v, j0) = (y - j as f64, j * self.n_theta);
        let j1 = (j + 1) % self.n_phi * self.n_theta;
        [
            (j0 + i, (1.0 - t) * (1.0 - v)),
            (j0 + i + 1, t * (1.0 - v)),
            (j1 + i, (1.0 - t) * v),
            (j1 + i + 1, t * v),
        ]
    }
}

/// What makes a vector of squared length near 1 a unit vector: 1 / sqrt(x) to first order. Directions arrive
/// rounded to f32, and unequal lengths of wi and wo would tilt the half vector.
#[inline(always)]
fn unit_factor(length_squared: f64) -> f64 {
    1.5 - 0.5 * length_squared
}

/// A viewer direction made a unit vector to first order, and its sine: all that densities need to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitView {
    pub(crate) wo: DVec3,
    pub(crate) sin_o: f64,
}

impl UnitView {
    #[inline(always)]
    pub(crate) fn new(wo: DVec3) -> Self {
        let r2 = wo.x * wo.x + wo.y * wo.y;
        let unit = unit_factor(r2 + wo.z * wo.z);
        Self {
            wo: unit * wo,
            sin_o: (r2.sqrt() * unit).min(1.0),
        }
    }

    /// wi + wo, both made unit vectors to first order.
    #[inline(always)]
    pub(crate) fn half(self, wi: DVec3) -> DVec3 {
        unit_factor(wi.length_squared()) * wi + self.wo
    }

    /// Elevation and azimuth; azimuth 0 straight along the normal.
    #[inline(always)]
    pub(crate) fn frame(self) -> ViewFrame {
        let (cos_phi, sin_phi) = if self.sin_o > 0.0 {
            let inv = 1.0 / self.sin_o;
            (self.wo.x * inv, self.wo.y * inv)
        } else {
            (1.0, 0.0)
        };
        ViewFrame {
            sin_o: self.sin_o,
            cos_o: self.wo.z,
            cos_phi,
            sin_phi,
        }
    }
}

/// A viewer direction split into elevation and azimuth: rotates light directions into the frame where the
/// viewer has azimuth 0, and back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ViewFrame {
    pub(crate) sin_o: f64,
    pub(crate) cos_o: f64,
    cos_phi: f64,
    sin_phi: f64,
}

impl ViewFrame {
    #[inline(always)]
    pub(crate) fn new(wo: DVec3) -> Self {
        UnitView::new(wo).frame()
    }

    /// The frame of a slice; keeps its azimuth even at theta = 0.
    pub(crate) fn from_angles(theta: f64, phi: f64) -> Self {
        let ((sin_o, cos_o), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
        Self {
            sin_o,
            cos_o,
            cos_phi,
            sin_phi,
        }
    }

    /// Also makes `w` a unit vector to first order.
    #[inline]
    pub(crate) fn to_local(self, w: DVec3) -> DVec3 {
        unit_factor(w.length_squared())
            * DVec3::new(
                w.x * self.cos_phi + w.y * self.sin_phi,
                w.y * self.cos_phi - w.x * self.sin_phi,
                w.z,
            )
    }

    #[inline(always)]
    pub(crate) fn to_world(self, w: DVec3) -> DVec3 {
        DVec3::new(
            w.x * self.cos_phi - w.y * self.sin_phi,
            w.x * self.sin_phi + w.y * self.cos_phi,
            w.z,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::KnownGrid;
    use brdf::direction;

    #[test]
    fn blends_are_partitions_of_unity_and_hit_the_nodes() {
        for grid in [KnownGrid::new(7, 1), KnownGrid::new(5, 6)] {
            for k in 0..200 {
                let x = f64::from(k) / 200.0;
                let blend = grid.blend(direction(1.57 * x, 40.0 * x));
                let sum: f64 = blend.iter().map(|b| b.1).sum();
                assert!((sum - 1.0).abs() < 1e-12, "weights add to {sum}");
                assert!(
                    blend.iter().all(|b| b.0 < grid.len() && b.1 >= -1e-12),
                    "{blend:?}"
                );
            }
            // slices at theta = 0 know no azimuth, so start at 1; the last lies at the rim
            for k in
                (0..grid.len()).filter(|k| k % grid.n_theta != 0 && (k + 1) % grid.n_theta != 0)
            {
                let best = grid
                    .blend(grid.viewer(k))
                    .into_iter()
                    .max_by(|a, b| a.1.total_cmp(&b.1));
                assert_eq!(best.unwrap().0, k, "node {k} is its own slice");
            }
        }
    }
}
