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
mod sweep;
mod table;
mod validation;
mod view;

pub use options::{HvtOptions, MAX_B, Preset};

use crate::chart::Chart;
use crate::cosine::{cosine_hemisphere, cosine_pdf};
use crate::known_grid::UnitView;
use crate::target::Target;
use brdf::{DirectionSample, DirectionSampler, LANES, Lanes3, SampleLanes};
use glam::{DVec2, DVec3};
use optimise::{Effort, optimise};
use problem::{Problem, Unknowns};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use shape::{Blend, Shape};
use table::{Place, Table};
pub(crate) use validation::Validation;

/// Radial scales tried, radians.
const SCALES: [f64; 9] = [0.0007, 0.002, 0.005, 0.012, 0.03, 0.07, 0.16, 0.4, 1.0];

/// Half the step between them, as a factor.
const HALFWAY: f64 = 1.57;

/// A direction sampler of least variance. Isotropic targets have slices of the viewer's elevation, others of its
/// azimuth as well.
#[derive(Clone, Debug)]
pub struct Hvt {
    table: Table,
    r0: f64,
    /// r0^2 and its inverse.
    scale2: [f64; 2],
    predicted: f64,
    /// The widest instructions of this machine.
    arch: Arch,
}

/// The slice below a viewer among `n` slices even in tau, and the weight of the one above.
pub(crate) fn slice_blend(wo: DVec3, n: usize) -> (usize, f64) {
    let sin_o = wo.x.hypot(wo.y).min(1.0);
    let tau = slices::tau(sin_o as f32, wo.z as f32);
    slices::blend(f64::from(tau), n)
}

/// The viewer-dependent half of every query, for `S` slices around.
struct View<const S: usize> {
    chart: Chart,
    place: Place<S>,
    lobe: f64,
}

impl Hvt {
    /// Evaluates the target at some 10^5 points, 10^6 if it is anisotropic, and optimises; rayon over viewers.
    ///
    /// A target that is zero everywhere gives the cosine.
    #[must_use]
    pub fn new(target: Target<'_>, options: HvtOptions) -> Self {
        let shape = options.shape(target.turning());
        let r0 = match options.r0 {
            Some(r0) => r0.clamp(1e-4, 1.0),
            None => best_scale(&target, shape),
        };
        let problem = Problem::new(&target, shape, r0, 2);
        let (x, value) = if problem.is_empty() {
            let cosine = Unknowns {
                nodes: vec![1e-3; shape.nodes()],
                lobe: vec![1.0; shape.slices()],
            };
            (cosine, 1.0)
        } else {
            optimise(&problem, options.effort())
        };
        Self::of(Table::new(shape, x), r0, (value - 1.0).max(0.0))
    }

    fn of(table: Table, r0: f64, predicted: f64) -> Self {
        Self {
            table,
            r0,
            scale2: [r0 * r0, 1.0 / (r0 * r0)],
            predicted,
            arch: brdf::arch(),
        }
    }

    /// Slices of the viewer's elevation and azimuth; one azimuth for isotropic targets.
    #[must_use]
    pub fn slices(&self) -> [usize; 2] {
        [self.table.shape.n_theta, self.table.shape.n_phi]
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

    fn lane_scale2(&self) -> [f32; 2] {
        self.scale2.map(|x| x as f32)
    }

    #[inline(always)]
    fn view<const S: usize>(&self, o: UnitView) -> View<S> {
        let chart = Chart::of(o.sin_o, o.wo.z, self.scale2);
        let blend: Blend<S> = self.table.shape.blend(o.sin_o, o.wo);
        let place = self.table.place(blend);
        View {
            chart,
            lobe: f64::from(self.table.lobe(&place)),
            place,
        }
    }

    #[inline(always)]
    fn sample_among<const S: usize>(&self, wo: DVec3, u: DVec2) -> DirectionSample {
        let o = UnitView::new(wo);
        let view: View<S> = self.view(o);
        let body = 1.0 - view.lobe;
        if u.x < body {
            let hit = self.table.invert(&view.place, u.x as f32, u.y as f32);
            let (wi, density) = view.chart.direction(hit.a, hit.side);
            return DirectionSample {
                wi: o.frame().to_world(wi),
                pdf: view.lobe * cosine_pdf(wi) + f64::from(hit.density) * density,
            };
        }
        let wi = cosine_hemisphere(DVec2::new((u.x - body) / view.lobe, u.y));
        DirectionSample {
            wi,
            pdf: self.density(&view, wi, o),
        }
    }

    #[inline(always)]
    fn density<const S: usize>(&self, view: &View<S>, wi: DVec3, o: UnitView) -> f64 {
        let (ab, density) = view.chart.locate(o.half(wi), o.wo.truncate());
        let body = f64::from(self.table.density(&view.place, ab.x, ab.y));
        view.lobe * cosine_pdf(wi) + body * density
    }

    #[inline(always)]
    fn pdf_among<const S: usize>(&self, wi: DVec3, wo: DVec3) -> f64 {
        let o = UnitView::new(wo);
        self.density(&self.view::<S>(o), wi, o)
    }
}

/// A direction drawn by the widest instructions: fused products and rows of sixteen nodes in one or two registers.
struct Sample<'a>(&'a Hvt, DVec3, DVec2);

impl WithSimd for Sample<'_> {
    type Output = DirectionSample;

    #[inline(always)]
    fn with_simd<T: Simd>(self, _: T) -> DirectionSample {
        let Self(hvt, wo, u) = self;
        if hvt.table.shape.n_phi == 1 {
            hvt.sample_among::<2>(wo, u)
        } else {
            hvt.sample_among::<4>(wo, u)
        }
    }
}

/// A density by the widest instructions.
struct Density<'a>(&'a Hvt, DVec3, DVec3);

impl WithSimd for Density<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<T: Simd>(self, _: T) -> f64 {
        let Self(hvt, wi, wo) = self;
        if hvt.table.shape.n_phi == 1 {
            hvt.pdf_among::<2>(wi, wo)
        } else {
            hvt.pdf_among::<4>(wi, wo)
        }
    }
}

/// The scale whose coarse table has the least variance at the validation points.
fn best_scale(target: &Target<'_>, shape: Shape) -> f64 {
    let coarse = Shape {
        n_theta: shape.n_theta.min(7),
        n_phi: shape.n_phi.min(4),
        n_a: shape.n_a.min(32),
        n_b: 8,
        ..shape
    };
    let effort = Effort {
        multiplicative: 4,
        newton: 0,
        gradients: 0,
    };
    let validation = Validation::new(target);
    let cost = |r0: f64| {
        let problem = Problem::new(target, coarse, r0, 1);
        if problem.is_empty() {
            return f64::INFINITY;
        }
        let (x, _) = optimise(&problem, effort);
        validation.variance(&Hvt::of(Table::new(coarse, x), r0, 0.0))
    };
    let best = |scales: &[f64]| {
        let costs: Vec<f64> = scales.par_iter().map(|&r0| cost(r0)).collect();
        let k = (0..scales.len()).min_by(|&a, &b| costs[a].total_cmp(&costs[b]));
        k.map_or((f64::INFINITY, 0.1), |k| (costs[k], scales[k]))
    };
    let first = best(&SCALES);
    // then halfway to the neighbours
    let second = best(&[first.1 * HALFWAY, first.1 / HALFWAY]);
    if second.0 < first.0 {
        second.1
    } else {
        first.1
    }
}

impl DirectionSampler for Hvt {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        (wo.z > 0.0).then(|| self.arch.dispatch(Sample(self, wo, u)))
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        self.arch.dispatch(Density(self, wi, wo))
    }

    fn bytes(&self) -> usize {
        self.table.bytes()
    }

    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        if self.table.shape.n_phi == 1 {
            lanes::sample::<2>(&self.table, self.lane_scale2(), wo, u)
        } else {
            lanes::sample::<4>(&self.table, self.lane_scale2(), wo, u)
        }
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        if self.table.shape.n_phi == 1 {
            lanes::pdf::<2>(&self.table, self.lane_scale2(), wi, wo)
        } else {
            lanes::pdf::<4>(&self.table, self.lane_scale2(), wi, wo)
        }
    }
}
