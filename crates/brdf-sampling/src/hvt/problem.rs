//! The variance of a table as a convex function of its node values.
//!
//! With T = f cos J on the chart, D = cos theta_i J / pi, node values C >= 0 and lobe weights L >= 0,
//!
//! P = sum_k t_k (L_k D + sum_ij C_kij phi_ij),   F = sum_m omega_m (int T^2 / P) / (int T)^2
//!
//! over viewers m; F - 1 is the mean relative variance if each slice has mass 1. P is linear in the
//! unknowns and 1/P is convex, so F is.

use super::shape::Shape;
use super::sweep::{Blended, Diagonal, Found, Gradient, Hessian, Kernel, gather, sweep};
use super::view::{View, Viewer};
use crate::target::Target;
use rayon::prelude::*;

/// Least part of T that the start leaves to the nodes where the lobe is taken out.
const KEPT: f32 = 0.03;

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
    /// Evaluates the target at six points of every cell for `per_interval` viewers an interval of elevation and at the
    /// slices themselves.
    pub(crate) fn new(target: &Target<'_>, shape: Shape, r0: f64, per_interval: usize) -> Self {
        let mut views: Vec<View> = viewers(shape, per_interval)
            .into_par_iter()
            .enumerate()
            .filter_map(|viewer| View::new(target, shape, r0, viewer))
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
    pub(crate) fn start(&self, share: f32) -> Unknowns {
        let part = |v: &View| {
            let lobe = share * v.lowest_lobe();
            let points = v.t_norm.iter().zip(&v.d);
            let rest: Vec<f32> = points.map(|(t, d)| (t - lobe * d).max(KEPT * t)).collect();
            (lobe, gather(v, self.shape.n_b, &rest))
        };
        let parts: Vec<_> = self.views.par_iter().map(part).collect();
        let (mut sum, mut weight) = (Unknowns::zero(self.shape), Unknowns::zero(self.shape));
        let n = self.shape.slice();
        for (v, (lobe, [values, hats])) in self.views.iter().zip(&parts) {
            for &(k, t) in &v.blend {
                let t = t * t; // slices near the viewer count most
                sum.lobe[k] += t * f64::from(*lobe);
                weight.lobe[k] += t;
                add_scaled(&mut sum.nodes[k * n..][..n], t, values);
                add_scaled(&mut weight.nodes[k * n..][..n], t, hats);
            }
        }
        let divide = |(s, w): (&mut f64, &f64)| *s = if *w > 0.0 { *s / w } else { 0.0 };
        sum.nodes.iter_mut().zip(&weight.nodes).for_each(divide);
        sum.lobe.iter_mut().zip(&weight.lobe).for_each(divide);
        sum
    }

    /// F and -dF/dC, -dF/dL.
    pub(crate) fn gradient(&self, x: &Unknowns) -> Pass {
        self.pass::<Gradient>(x, None)
    }

    /// The Hessian at `x` times `v`.
    pub(crate) fn hessian(&self, x: &Unknowns, v: &Unknowns) -> Unknowns {
        self.pass::<Hessian>(x, Some(v)).out
    }

    /// Its diagonal.
    pub(crate) fn hessian_diagonal(&self, x: &Unknowns) -> Unknowns {
        self.pass::<Diagonal>(x, None).out
    }

    fn pass<K: Kernel>(&self, x: &Unknowns, v: Option<&Unknowns>) -> Pass {
        let part = |view: &View| {
            let x = self.blended(view, x);
            let second = v.map(|v| self.blended(view, v));
            sweep::<K>(view, self.shape.n_b, &x, second.as_ref().unwrap_or(&x))
        };
        let parts: Vec<Found> = self.views.par_iter().map(part).collect();
        let (mut out, mut value) = (Unknowns::zero(self.shape), 0.0);
        let n = self.shape.slice();
        for (view, found) in self.views.iter().zip(&parts) {
            value += found.value;
            for &(k, t) in &view.blend {
                let t = if K::SQUARED { t * t } else { t };
                out.lobe[k] += t * found.lobe;
                add_scaled(&mut out.nodes[k * n..][..n], t, &found.nodes);
            }
        }
        Pass { value, out }
    }

    /// Node values and lobe weight at a viewer between slices.
    fn blended(&self, view: &View, x: &Unknowns) -> Blended {
        let n = self.shape.slice();
        let (mut nodes, mut lobe) = (vec![0.0_f32; n], 0.0);
        for &(k, t) in &view.blend {
            lobe += t * x.lobe[k];
            for (o, v) in nodes.iter_mut().zip(&x.nodes[k * n..][..n]) {
                *o += (t * v) as f32;
            }
        }
        // beyond the last node stands what may be divided by
        nodes.push(1.0);
        Blended {
            nodes,
            lobe: lobe as f32,
        }
    }
}

fn add_scaled(sum: &mut [f64], t: f64, part: &[f32]) {
    for (s, p) in sum.iter_mut().zip(part) {
        *s += t * f64::from(*p);
    }
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
