//! The target as one viewer of the quadrature sees it, at points inside the cells of the chart.

use super::lane_chart::{Points, Views, forward};
use super::shape::Shape;
use super::slices;
use crate::lane_math::ZERO;
use crate::target::Target;
use brdf::{LANES, Lanes3, direction};
use pulp::{Simd, WithSimd};
use std::f32::consts::FRAC_1_PI;

/// Points of a cell along a and b.
const SUB: [usize; 2] = [3, 2];
pub(crate) const POINTS: usize = SUB[0] * SUB[1];
/// Weight of viewers beside their share of theta_o: grazing ones have hardly any.
const GRAZING: f64 = 0.4;
/// Viewers are kept this far above the horizon, in cos theta_o.
const MIN_COS: f64 = 2e-3;
/// And this far from the normal, radians: straight along it they would have no azimuth.
const MIN_THETA: f64 = 1e-6;

/// Slice coordinates of a viewer: of elevation, [0, 1], and of azimuth, [0, n_phi).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viewer {
    pub(crate) tau: f64,
    pub(crate) turn: f64,
}

/// One viewer of the quadrature.
///
/// Lists over points run through the rows of cells, the points of a cell, and the cells of a row; rows are filled up to
/// `n_b` with points at which all is 0, so that nodes and points of a row match lane by lane.
pub(crate) struct View {
    /// Slices around and their weights.
    pub(crate) blend: Vec<(usize, f64)>,
    /// Weight among the viewers, before normalisation.
    pub(crate) omega: f64,
    /// Bilinear weights of the points of a cell at its corners (i,j), (i,j+1), (i+1,j), (i+1,j+1).
    pub(crate) hats: [[f32; 4]; POINTS],
    /// omega T^2 / (int T)^2 / points.
    pub(crate) s: Vec<f32>,
    /// D.
    pub(crate) d: Vec<f32>,
    /// T / int T.
    pub(crate) t_norm: Vec<f32>,
}

impl View {
    /// Samples the target for viewer number `m`; `None` if it is zero everywhere.
    pub(crate) fn new(
        target: &Target<'_>,
        shape: Shape,
        r0: f64,
        (m, viewer): (usize, Viewer),
    ) -> Option<Self> {
        let places = Places::new(shape, m);
        let theta = slices::viewer(viewer.tau).1.max(MIN_COS).acos();
        let wo = direction(theta.max(MIN_THETA), shape.azimuth(viewer.turn));
        let mut view = Self {
            blend: blend(shape, viewer),
            omega: slices::spread(viewer.tau) + GRAZING,
            hats: std::array::from_fn(|p| places.hat(p)),
            s: Vec::new(),
            d: Vec::new(),
            t_norm: Vec::new(),
        };
        let mut wo_lanes = Lanes3::ZERO;
        for k in 0..LANES {
            wo_lanes.set(k, wo.as_vec3());
        }
        let scale2 = [(r0 * r0) as f32, (1.0 / (r0 * r0)) as f32];
        let values = brdf::arch().dispatch(Sampled {
            target,
            places: &places,
            wo: &wo_lanes,
            scale2,
            d: &mut view.d,
        });
        let total = (shape.cells() * POINTS) as f64;
        let mean = values.iter().sum::<f64>() / total;
        if !(mean > 0.0 && mean.is_finite()) {
            return None;
        }
        view.t_norm = values.iter().map(|v| (v / mean) as f32).collect();
        let s = |t: &f32| t * t / total as f32;
        view.s = view.t_norm.iter().map(s).collect();
        Some(view)
    }

    /// The weight a cosine lobe could have below T almost everywhere: the 4 % quantile of T / D.
    pub(crate) fn lowest_lobe(&self) -> f32 {
        let points = self.t_norm.iter().zip(&self.d);
        let mut ratio: Vec<f32> = points
            .filter(|(_, d)| **d > 0.0)
            .map(|(t, d)| t / d)
            .collect();
        let at = ratio.len() / 25;
        if ratio.is_empty() {
            return 0.0;
        }
        let (_, value, _) = ratio.select_nth_unstable_by(at, f32::total_cmp);
        value.clamp(0.0, 1.0)
    }
}

/// Where the points of a viewer lie.
struct Places {
    shape: Shape,
    /// Offset within the cells, by the golden section different for every viewer.
    shift: f64,
}

impl Places {
    fn new(shape: Shape, m: usize) -> Self {
        let shift = (m as f64 * 0.618_033_988_75).fract();
        Self { shape, shift }
    }

    /// Point `p` of a cell, in units of the cell.
    fn inside(&self, p: usize) -> [f64; 2] {
        let at = |k: usize, n: usize, x: f64| (k as f64 + x) / n as f64;
        [
            at(p / SUB[1], SUB[0], 0.2 + 0.6 * self.shift),
            at(p % SUB[1], SUB[1], 0.8 - 0.6 * self.shift),
        ]
    }

    fn hat(&self, p: usize) -> [f32; 4] {
        let [x, y] = self.inside(p);
        [(1.0 - x) * (1.0 - y), (1.0 - x) * y, x * (1.0 - y), x * y].map(|w| w as f32)
    }

    /// How many there are, filled ones too: a multiple of [`LANES`], since `n_b` is one of 8 and [`POINTS`] is even.
    fn count(&self) -> usize {
        (self.shape.n_a - 1) * POINTS * self.shape.n_b
    }

    /// (a, b) of point number `at`, and whether it is one.
    fn at(&self, at: usize) -> ([f64; 2], bool) {
        let (row, j) = (at / self.shape.n_b, at % self.shape.n_b);
        let (i, [x, y]) = (row / POINTS, self.inside(row % POINTS));
        let (n, m) = (self.shape.n_a - 1, self.shape.n_b - 1);
        let ab = [(i as f64 + x) / n as f64, (j as f64 + y) / m as f64];
        (ab, j < m)
    }
}

/// T at all points, as f64, for not all targets fit into f32; D goes to `d`.
struct Sampled<'a> {
    target: &'a Target<'a>,
    places: &'a Places,
    wo: &'a Lanes3,
    scale2: [f32; 2],
    d: &'a mut Vec<f32>,
}

impl WithSimd for Sampled<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) -> Vec<f64> {
        let views = Views::new(self.wo, self.scale2);
        let count = self.places.count();
        let mut values = Vec::with_capacity(count);
        self.d.reserve(count);
        for first in (0..count).step_by(LANES) {
            let mut points = Points {
                a: ZERO,
                b: ZERO,
                jacobian: ZERO,
            };
            let mut real = ZERO;
            for k in 0..LANES {
                let ([a, b], is) = self.places.at(first + k);
                points.a[k] = a as f32;
                points.b[k] = b.min(1.0) as f32;
                real[k] = if is { 1.0 } else { 0.0 };
            }
            let wi = forward(&views, self.scale2, &mut points);
            let g = self.target.f_cos_lanes(&wi, self.wo);
            for k in 0..LANES {
                let area = real[k] * points.jacobian[k];
                values.push(g[k] * f64::from(area));
                self.d.push(wi.z[k] * area * FRAC_1_PI);
            }
        }
        values
    }
}

/// Slices around a viewer, with weights above 0 only.
fn blend(shape: Shape, viewer: Viewer) -> Vec<(usize, f64)> {
    let (k, t) = slices::blend(viewer.tau, shape.n_theta);
    let (j, v) = (viewer.turn as usize, viewer.turn.fract());
    let next = (j + 1) % shape.n_phi;
    let corners = [
        (j, k, (1.0 - v) * (1.0 - t)),
        (j, k + 1, (1.0 - v) * t),
        (next, k, v * (1.0 - t)),
        (next, k + 1, v * t),
    ];
    corners
        .into_iter()
        .filter(|c| c.2 > 0.0)
        .map(|(j, k, w)| (j * shape.n_theta + k, w))
        .collect()
}
