//! Directional albedos of several channels, tabulated over viewers.

use crate::chart::Chart;
use crate::known_grid::{KnownGrid, ViewFrame};
use brdf::Symmetry;
use glam::{DVec2, DVec3};

/// Elevations, even in theta_o, and azimuths where they matter.
const VIEWERS: [usize; 2] = [91, 16];
/// Quadrature points along the chart's coordinates.
const POINTS: [usize; 2] = [192, 32];
/// Radial scale of the quadrature chart.
const R0: f64 = 2e-3;

/// Reflectance of several channels: writes f_c(wi, wo) in 1/sr, without the cosine.
pub(crate) trait Channels: Fn(DVec3, DVec3, &mut [f64]) + Sync {}
impl<F: Fn(DVec3, DVec3, &mut [f64]) + Sync> Channels for F {}

/// The golden section: rows are shifted by its multiples, so that azimuths with a period do not meet the same phase in all.
const GOLDEN: f64 = 0.618_033_988_75;

/// Calls `visit(g, area)` for the points of a midpoint rule over the hemisphere of wi: g_c = f_c cos theta_i, 0 where
/// that is negative or not finite, and the solid angle of the point.
fn for_each_point(
    f: &impl Channels,
    channels: usize,
    frame: ViewFrame,
    wo: DVec3,
    mut visit: impl FnMut(&[f64], f64),
) {
    let chart = Chart::new(frame.sin_o, frame.cos_o, R0);
    let [n, m] = POINTS;
    let mut g = vec![0.0; channels];
    for k in 0..n * m {
        // 1 - x^2 takes the square-root end at the rim away
        let x = ((k / m) as f64 + 0.5) / n as f64;
        let shift = ((k / m) as f64 * GOLDEN).fract();
        let p = chart.forward(DVec2::new(1.0 - x * x, ((k % m) as f64 + shift) / m as f64));
        let wi = frame.to_world(p.wi);
        f(wi, wo, &mut g);
        for v in &mut g {
            let f_cos = *v * wi.z;
            *v = if f_cos > 0.0 && f_cos.is_finite() {
                f_cos
            } else {
                0.0
            };
        }
        visit(&g, 2.0 * x * p.jacobian() / (n * m) as f64);
    }
}

/// Albedos by viewer and channel, between viewers linear in their angles.
#[derive(Clone, Debug)]
pub(crate) struct AlbedoTable {
    grid: KnownGrid,
    channels: usize,
    albedo: Vec<f64>,
}

impl AlbedoTable {
    pub(crate) fn new(f: &impl Channels, channels: usize, symmetry: Symmetry) -> Self {
        let grid = KnownGrid::new(VIEWERS[0], if symmetry.isotropic { 1 } else { VIEWERS[1] });
        let mut albedo = vec![0.0; grid.len() * channels];
        for (k, sums) in albedo.chunks_exact_mut(channels.max(1)).enumerate() {
            let (theta, phi) = grid.angles(k);
            let (frame, wo) = (ViewFrame::from_angles(theta, phi), grid.viewer(k));
            for_each_point(f, channels, frame, wo, |g, area| {
                for (s, v) in sums.iter_mut().zip(g) {
                    *s += v * area;
                }
            });
        }
        Self {
            grid,
            channels,
            albedo,
        }
    }

    /// Albedo of channel `c` seen from `wo`.
    pub(crate) fn at(&self, wo: DVec3, c: usize) -> f64 {
        let part = |&(k, t): &(usize, f64)| t * self.albedo[k * self.channels + c];
        self.grid.blend(wo).iter().map(part).sum()
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.albedo[..])
    }
}
