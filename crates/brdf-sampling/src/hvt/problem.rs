//! The variance of a table as a convex function of its node values.
//!
//! With T = f cos J on the chart, D = cos theta_i J / pi, node values C >= 0 and lobe weights L >= 0,
//!
//! P = sum_k t_k (L_k D + sum_ij C_kij phi_ij),   F = sum_m omega_m (int T^2 / P) / (int T)^2
//!
//! over viewers m; F - 1 is the mean relative variance if each slice has mass 1. P is linear in the
//! unknowns and 1/P is convex, so F is.

use super::shape::Shape;
use super::slices;
use crate::chart::Chart;
use crate::known_grid::ViewFrame;
use crate::target::Target;
use brdf::direction;
use glam::DVec2;
use rayon::prelude::*;

/// Points of a cell along a and b.
const SUB: [usize; 2] = [3, 2];
pub(crate) const POINTS: usize = SUB[0] * SUB[1];
/// Weight of viewers beside their share of theta_o: grazing ones have hardly any.
const GRAZING: f64 = 0.4;
/// Viewers are kept this far above the horizon, in cos theta_o.
const MIN_COS: f64 = 2e-3;

/// The unknowns, or a direction in their space.
#[derive(Clone, Debug)]
pub(crate) struct Unknowns {
    /// Node values, slice after slice, rows of constant a.
    pub(crate) nodes: Vec<f64>,
    /// Weight of the cosine lobe per slice.
    pub(crate) lobe: Vec<f64>,
}

impl Unknowns {
    pub(crate) fn zero(shape: Shape) -> Self {
        Self {
            nodes: vec![0.0; shape.nodes()],
            lobe: vec![0.0; shape.slices()],
        }
    }
}

/// One viewer of the quadrature.
struct View {
    /// Slices around and their weights.
    blend: Vec<(usize, f64)>,
    /// Weight among the viewers, before normalisation.
    omega: f64,
    /// Bilinear weights of the points of a cell at its corners (i,j), (i,j+1), (i+1,j), (i+1,j+1).
    hats: [[f32; 4]; POINTS],
    /// omega T^2 / (int T)^2 / points, cell after cell.
    s: Vec<f32>,
    /// D.
    d: Vec<f32>,
    /// T / int T.
    t_norm: Vec<f32>,
}

/// The sampled target.
pub(crate) struct Problem {
    pub(crate) shape: Shape,
    views: Vec<View>,
}

/// What one pass over the points yields.
pub(crate) struct Pass {
    pub(crate) value: f64,
    pub(crate) out: Unknowns,
}

impl Problem {
    /// Evaluates the target at `POINTS` points of every cell for `per_interval` viewers an interval of elevation and at
    /// the slices themselves.
    pub(crate) fn new(target: &Target<'_>, shape: Shape, r0: f64, per_interval: usize) -> Self {
        let mut views: Vec<View> = viewers(shape, per_interval)
            .par_iter()
            .enumerate()
            .filter_map(|(m, viewer)| view(target, shape, r0, m, viewer))
            .collect();
        let total: f64 = views.iter().map(|v| v.omega).sum();
        for v in &mut views {
            let share = (v.omega / total) as f32;
            v.s.iter_mut().for_each(|s| *s *= share);
        }
        Self { shape, views }
    }

    /// True if the target is zero for every viewer.
    pub(crate) fn is_empty(&self) -> bool {
        self.views.is_empty()
    }

    /// Which slices any point touches.
    pub(crate) fn touched(&self) -> Vec<bool> {
        let mut touched = vec![false; self.shape.slices()];
        for v in &self.views {
            for &(k, _) in &v.blend {
                touched[k] = true;
            }
        }
        touched
    }

    /// Hat-weighted means of T / int T around every node and slice: where the search starts. `share` of what a
    /// cosine lobe can hold is taken out and given to it.
    pub(crate) fn start(&self, share: f64) -> Unknowns {
        let (mut sum, mut weight) = (Unknowns::zero(self.shape), Unknowns::zero(self.shape));
        for v in &self.views {
            let lobe = share * v.lowest_lobe();
            for &(k, t) in &v.blend {
                let t = t * t; // slices near the viewer count most
                sum.lobe[k] += t * lobe;
                weight.lobe[k] += t;
                self.scatter_value(v, (k, t), lobe, &mut sum.nodes, &mut weight.nodes);
            }
        }
        for (s, w) in sum.nodes.iter_mut().zip(&weight.nodes) {
            *s = if *w > 0.0 { *s / w } else { 0.0 };
        }
        for (s, w) in sum.lobe.iter_mut().zip(&weight.lobe) {
            *s = if *w > 0.0 { *s / w } else { 0.0 };
        }
        sum
    }

    fn scatter_value(
        &self,
        v: &View,
        (k, t): (usize, f64),
        lobe: f64,
        sum: &mut [f64],
        weight: &mut [f64],
    ) {
        let (nb, base) = (self.shape.n_b, k * self.shape.slice());
        for cell in 0..self.shape.cells() {
            let node = base + cell / (nb - 1) * nb + cell % (nb - 1);
            for p in 0..POINTS {
                let at = cell * POINTS + p;
                let rest = f64::from(v.t_norm[at]) - lobe * f64::from(v.d[at]);
                let value = rest.max(0.03 * f64::from(v.t_norm[at]));
                for (corner, offset) in [0, 1, nb, nb + 1].into_iter().enumerate() {
                    let w = t * f64::from(v.hats[p][corner]);
                    sum[node + offset] += w * value;
                    weight[node + offset] += w;
                }
            }
        }
    }

    /// F and -dF/dC, -dF/dL.
    pub(crate) fn gradient(&self, x: &Unknowns) -> Pass {
        self.pass(x, None, |s, p, _| (s / (p * p), s / p))
    }

    /// The Hessian at `x` times `v`.
    pub(crate) fn hessian(&self, x: &Unknowns, v: &Unknowns) -> Unknowns {
        self.pass(x, Some(v), |s, p, q| (2.0 * s * q / (p * p * p), 0.0))
            .out
    }

    /// Its diagonal.
    pub(crate) fn hessian_diagonal(&self, x: &Unknowns) -> Unknowns {
        let parts: Vec<_> = self
            .views
            .par_iter()
            .map(|v| {
                self.sweep(v, &self.blended(v, x), None, true, &|s, p, _| {
                    (2.0 * s / (p * p * p), 0.0)
                })
            })
            .collect();
        self.reduce(&parts, |t| t * t).out
    }

    fn pass(
        &self,
        x: &Unknowns,
        v: Option<&Unknowns>,
        f: impl Fn(f32, f32, f32) -> (f32, f32) + Sync,
    ) -> Pass {
        let parts: Vec<_> = self
            .views
            .par_iter()
            .map(|view| {
                let second = v.map(|v| self.blended(view, v));
                self.sweep(view, &self.blended(view, x), second.as_ref(), false, &f)
            })
            .collect();
        self.reduce(&parts, |t| t)
    }

    /// Adds what the views found to their two slices.
    fn reduce(&self, parts: &[(Vec<f32>, f64, f64)], power: impl Fn(f64) -> f64) -> Pass {
        let mut out = Unknowns::zero(self.shape);
        let (mut value, n) = (0.0, self.shape.slice());
        for (view, (nodes, lobe, part)) in self.views.iter().zip(parts) {
            value += part;
            for &(k, t) in &view.blend {
                let t = power(t);
                out.lobe[k] += t * lobe;
                for (o, g) in out.nodes[k * n..(k + 1) * n].iter_mut().zip(nodes) {
                    *o += t * f64::from(*g);
                }
            }
        }
        Pass { value, out }
    }

    /// Node values and lobe weight at a viewer between slices.
    fn blended(&self, view: &View, x: &Unknowns) -> (Vec<f32>, f32) {
        let n = self.shape.slice();
        let (mut nodes, mut lobe) = (vec![0.0_f32; n], 0.0);
        for &(k, t) in &view.blend {
            lobe += t * x.lobe[k];
            for (o, v) in nodes.iter_mut().zip(&x.nodes[k * n..][..n]) {
                *o += (t * v) as f32;
            }
        }
        (nodes, lobe as f32)
    }

    /// Calls `f(s, P, Q)` at every point, P from `x` and Q from `v`; gathers its first result at the nodes by the
    /// hat weights (or their squares) and sums the second.
    fn sweep(
        &self,
        view: &View,
        x: &(Vec<f32>, f32),
        v: Option<&(Vec<f32>, f32)>,
        squared: bool,
        f: &(impl Fn(f32, f32, f32) -> (f32, f32) + Sync),
    ) -> (Vec<f32>, f64, f64) {
        let nb = self.shape.n_b;
        let mut out = vec![0.0_f32; self.shape.slice()];
        let (mut lobe, mut value) = (0.0, 0.0);
        for i in 0..self.shape.n_a - 1 {
            for j in 0..nb - 1 {
                let (node, first) = (i * nb + j, (i * (nb - 1) + j) * POINTS);
                let corners = |x: &[f32]| [x[node], x[node + 1], x[node + nb], x[node + nb + 1]];
                let c = corners(&x.0);
                let q = v.map_or([0.0; 4], |v| corners(&v.0));
                let mut sum = [0.0_f32; 4];
                for p in 0..POINTS {
                    let hat = &view.hats[p];
                    let d = view.d[first + p];
                    let at = |c: &[f32; 4], lobe: f32| {
                        c[0] * hat[0] + c[1] * hat[1] + c[2] * hat[2] + c[3] * hat[3] + lobe * d
                    };
                    let (g, part) = f(
                        view.s[first + p],
                        at(&c, x.1),
                        at(&q, v.map_or(0.0, |v| v.1)),
                    );
                    value += f64::from(part);
                    lobe += f64::from(if squared { g * d * d } else { g * d });
                    for corner in 0..4 {
                        sum[corner] += g * if squared {
                            hat[corner] * hat[corner]
                        } else {
                            hat[corner]
                        };
                    }
                }
                out[node] += sum[0];
                out[node + 1] += sum[1];
                out[node + nb] += sum[2];
                out[node + nb + 1] += sum[3];
            }
        }
        (out, lobe, value)
    }
}

impl View {
    /// The weight a cosine lobe could have below T almost everywhere: the 4 % quantile of T / D.
    fn lowest_lobe(&self) -> f64 {
        let mut ratio: Vec<f32> = self
            .t_norm
            .iter()
            .zip(&self.d)
            .filter(|(_, d)| **d > 0.0)
            .map(|(t, d)| t / d)
            .collect();
        let at = ratio.len() / 25;
        if ratio.is_empty() {
            return 0.0;
        }
        let (_, value, _) = ratio.select_nth_unstable_by(at, f32::total_cmp);
        f64::from(*value).clamp(0.0, 1.0)
    }
}

/// A viewer of the quadrature: slice coordinates of elevation, [0, 1], and of azimuth, [0, n_phi).
struct Viewer {
    tau: f64,
    turn: f64,
}

/// `per_interval` an interval of elevation, and the slices; where azimuths count they lie on the slices of azimuth and
/// between them by turns.
fn viewers(shape: Shape, per_interval: usize) -> Vec<Viewer> {
    let n = (shape.n_theta - 1) * per_interval + 1;
    let viewer = |m: usize, j: usize| {
        let between = if shape.n_phi > 1 && m % 2 == 1 {
            0.5
        } else {
            0.0
        };
        Viewer {
            tau: m as f64 / (n - 1) as f64,
            turn: j as f64 + between,
        }
    };
    (0..n)
        .flat_map(|m| (0..shape.n_phi).map(move |j| (m, j)))
        .map(|(m, j)| viewer(m, j))
        .collect()
}

/// Slices around a viewer, with weights above 0 only.
fn blend(shape: Shape, viewer: &Viewer) -> Vec<(usize, f64)> {
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

/// Samples the target for viewer number `m`; `None` if it is zero everywhere.
fn view(target: &Target<'_>, shape: Shape, r0: f64, m: usize, viewer: &Viewer) -> Option<View> {
    let cos_o = slices::viewer(viewer.tau).1.max(MIN_COS);
    let (theta, phi) = (cos_o.acos(), shape.azimuth(viewer.turn));
    let wo = direction(theta, phi);
    let frame = ViewFrame::from_angles(theta, phi);
    let chart = Chart::new(frame.sin_o, frame.cos_o, r0);
    // a different offset within the cells for every viewer, by the golden section
    let shift = (m as f64 * 0.618_033_988_75).fract();
    let place = |p: usize| {
        let at = |k: usize, n: usize, x: f64| (k as f64 + x) / n as f64;
        (
            at(p / SUB[1], SUB[0], 0.2 + 0.6 * shift),
            at(p % SUB[1], SUB[1], 0.8 - 0.6 * shift),
        )
    };
    let hats = std::array::from_fn(|p| {
        let (x, y) = place(p);
        [(1.0 - x) * (1.0 - y), (1.0 - x) * y, x * (1.0 - y), x * y].map(|w| w as f32)
    });
    let size = DVec2::new((shape.n_a - 1) as f64, (shape.n_b - 1) as f64);
    let total = shape.cells() * POINTS;
    let (mut values, mut d) = (Vec::with_capacity(total), Vec::with_capacity(total));
    for i in 0..shape.n_a - 1 {
        for j in 0..shape.n_b - 1 {
            for p in 0..POINTS {
                let (x, y) = place(p);
                let ab = DVec2::new(i as f64 + x, j as f64 + y) / size;
                let point = chart.forward(ab);
                let jacobian = point.jacobian();
                values.push(target.f_cos(frame.to_world(point.wi), wo) * jacobian);
                d.push((point.wi.z * jacobian * std::f64::consts::FRAC_1_PI) as f32);
            }
        }
    }
    let mean = values.iter().sum::<f64>() / total as f64;
    if !(mean > 0.0 && mean.is_finite()) {
        return None;
    }
    let t_norm: Vec<f32> = values.iter().map(|v| (v / mean) as f32).collect();
    let s = t_norm.iter().map(|v| v * v / total as f32).collect();
    Some(View {
        blend: blend(shape, viewer),
        omega: slices::spread(viewer.tau) + GRAZING,
        hats,
        s,
        d,
        t_norm,
    })
}
