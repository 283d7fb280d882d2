//! The half-vector table: a few kilobytes that follow a reflectance almost without noise.
//!
//! A slice of the viewer's elevation holds a density that is bilinear on the half-vector chart
//! ([`crate::chart`]) plus a cosine lobe; slices blend linearly ([`slices`]). Node values are not samples of
//! the reflectance but the solution of a convex problem: least variance ([`problem`], [`optimise`]). Nodes are
//! stored in a byte ([`minifloat`]); sampling is by marginal and conditional inversion ([`table`]).

mod lane_chart;
mod lane_table;
mod lanes;
mod minifloat;
mod optimise;
mod options;
mod problem;
mod shape;
mod slices;
mod table;
mod validation;

pub use options::{HvtOptions, MAX_B, Preset};

use crate::chart::{Chart, ChartPoint};
use crate::cosine::{cosine_hemisphere, cosine_pdf};
use crate::known_grid::ViewFrame;
use crate::target::Target;
use brdf::{DirectionSample, DirectionSampler, LANES, Lanes3, SampleLanes};
use glam::{DVec2, DVec3};
use optimise::{Effort, optimise};
use problem::{Problem, Unknowns};
use rayon::prelude::*;
use shape::Shape;
use table::{Place, Table};
pub(crate) use validation::Validation;

/// Radial scales tried, radians.
const SCALES: [f64; 9] = [0.0007, 0.002, 0.005, 0.012, 0.03, 0.07, 0.16, 0.4, 1.0];

/// A direction sampler of least variance for isotropic targets; anisotropic ones are averaged over the viewer's
/// azimuth, which stays exact but loses variance.
#[derive(Clone, Debug)]
pub struct Hvt {
    table: Table,
    r0: f64,
    predicted: f64,
}

/// The slice below a viewer among `n` slices even in tau, and the weight of the one above.
pub(crate) fn slice_blend(cos_o: f64, n: usize) -> (usize, f64) {
    slices::blend(slices::tau(cos_o.min(1.0)), n)
}

/// The viewer-dependent half of every query.
struct View {
    frame: ViewFrame,
    chart: Chart,
    place: Place,
    lobe: f64,
}

impl Hvt {
    /// Evaluates the target at some 10^5 points and optimises; rayon over viewers.
    ///
    /// A target that is zero everywhere gives the cosine.
    #[must_use]
    pub fn new(target: Target<'_>, options: HvtOptions) -> Self {
        if target.symmetry.isotropic {
            return Self::build(target, options);
        }
        let mean = |wi: DVec3, wo: DVec3| target.turned_mean(wi, wo);
        Self::build(Target::new(&mean), options)
    }

    fn build(target: Target<'_>, options: HvtOptions) -> Self {
        let shape = options.shape();
        let r0 = match options.r0 {
            Some(r0) => r0.clamp(1e-4, 1.0),
            None => best_scale(&target, shape),
        };
        let problem = Problem::new(&target, shape, r0, 2);
        let (x, value) = if problem.is_empty() {
            let cosine = Unknowns {
                nodes: vec![1e-3; shape.nodes()],
                lobe: vec![1.0; shape.n_theta],
            };
            (cosine, 1.0)
        } else {
            optimise(&problem, options.effort())
        };
        Self {
            table: Table::new(shape, x),
            r0,
            predicted: (value - 1.0).max(0.0),
        }
    }

    /// The mean relative variance at the points the table was optimised for, before rounding to bytes.
    #[must_use]
    pub fn predicted_variance(&self) -> f64 {
        self.predicted
    }

    /// Radial scale of the chart, radians of theta_h.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.r0
    }

    /// f(wi, wo) as the table has it, in 1/sr, for a directional albedo `albedo` at this viewer: albedo * pdf / cos.
    ///
    /// An approximation, not the target: evaluated this way every sample has the weight `albedo`, so luminance is
    /// free of noise, at a systematic error whose relative square is the relative variance of the exact mode. It
    /// is not reciprocal. 0 below the horizon.
    #[must_use]
    pub fn baked(&self, wi: DVec3, wo: DVec3, albedo: f64) -> f64 {
        if wi.z > 0.0 {
            albedo * self.pdf(wi, wo) / wi.z
        } else {
            0.0
        }
    }

    /// Density of a point of the chart per unit solid angle.
    #[inline]
    fn density(&self, view: &View, p: &ChartPoint) -> f64 {
        let (a, b) = (p.ab.x as f32, p.ab.y as f32);
        let body = f64::from(self.table.density(view.place, a, b));
        view.lobe * cosine_pdf(p.wi) + body / p.jacobian
    }

    #[inline]
    fn finish(&self, view: &View, wi: DVec3, p: &ChartPoint) -> DirectionSample {
        let pdf = self.density(view, p);
        DirectionSample { wi, pdf }
    }

    #[inline]
    fn view(&self, wo: DVec3) -> View {
        let frame = ViewFrame::new(wo);
        let slice = slices::tau(frame.cos_o) * (self.table.shape.n_theta - 1) as f64;
        let place = self.table.place_at(slice as f32);
        View {
            frame,
            chart: Chart::new(frame.sin_o, frame.cos_o, self.r0),
            place,
            lobe: f64::from(self.table.lobe_at(place)),
        }
    }
}

/// The scale whose coarse table has the least variance at the validation points.
fn best_scale(target: &Target<'_>, shape: Shape) -> f64 {
    let coarse = Shape {
        n_theta: shape.n_theta.min(7),
        n_a: shape.n_a.min(32),
        n_b: shape.n_b.min(9),
    };
    let effort = Effort {
        multiplicative: 4,
        newton: 0,
        gradients: 0,
    };
    let validation = Validation::new(target);
    let costs: Vec<f64> = SCALES
        .par_iter()
        .map(|&r0| {
            let problem = Problem::new(target, coarse, r0, 1);
            if problem.is_empty() {
                return f64::INFINITY;
            }
            let (x, _) = optimise(&problem, effort);
            validation.variance(&Hvt {
                table: Table::new(coarse, x),
                r0,
                predicted: 0.0,
            })
        })
        .collect();
    let best = (0..SCALES.len()).min_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    best.map_or(0.1, |k| SCALES[k])
}

impl DirectionSampler for Hvt {
    #[inline]
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let view = self.view(wo);
        let body = 1.0 - view.lobe;
        if u.x < body {
            let (a, b) = self.table.invert(view.place, u.x as f32, u.y as f32);
            let p = view.chart.forward(DVec2::new(f64::from(a), f64::from(b)));
            let wi = view.frame.to_world(p.wi);
            return Some(self.finish(&view, wi, &p));
        }
        let wi = cosine_hemisphere(DVec2::new((u.x - body) / view.lobe, u.y));
        let p = view.chart.inverse(view.frame.to_local(wi));
        Some(self.finish(&view, wi, &p))
    }

    #[inline]
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let view = self.view(wo);
        let (h, xy2) = view.frame.half(wi, wo);
        let p = view.chart.locate(h, xy2);
        self.density(&view, &p)
    }

    fn bytes(&self) -> usize {
        self.table.bytes()
    }

    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        lanes::sample(&self.table, self.r0 as f32, wo, u)
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        lanes::pdf(&self.table, self.r0 as f32, wi, wo)
    }
}
