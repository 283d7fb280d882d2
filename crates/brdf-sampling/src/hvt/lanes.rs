//! The same density for packets of directions in f32.
//!
//! Arithmetic runs in loops over lanes, which the compiler vectorises; tables are read in loops of their own, lane
//! by lane, which it can't. All of it is inlined always: whoever calls decides the instruction set.

use super::lane_chart::{Points, Scale2, Views, forward, inverse};
use super::lane_table::{Hit, Places, density, invert};
use super::table::Table;
use crate::lane_math::{F, ZERO, cosine_hemisphere};
use brdf::{LANES, Lanes3, SampleLanes};
use std::f32::consts::FRAC_1_PI;

/// Densities of `wi`; 0 where either direction is below the horizon.
#[inline(always)]
pub(crate) fn pdf<const S: usize>(table: &Table, scale2: Scale2, wi: &Lanes3, wo: &Lanes3) -> F {
    let views = Views::new(wo, scale2);
    let points = inverse(&views, scale2, wi);
    let places = Places::<S>::new(table, &views.tau, wo);
    let body = density(table, &places, &points.a, &points.b);
    let mut out = ZERO;
    for k in 0..LANES {
        let above = wi.z[k] > 0.0 && wo.z[k] > 0.0;
        let p = places.lobe[k] * FRAC_1_PI * wi.z[k] + body[k] / points.jacobian[k];
        out[k] = if above { p } else { 0.0 };
    }
    out
}

/// Directions and their densities.
#[inline(always)]
pub(crate) fn sample<const S: usize>(
    table: &Table,
    scale2: Scale2,
    wo: &Lanes3,
    u: &[F; 2],
) -> SampleLanes {
    let views = Views::new(wo, scale2);
    let places = Places::<S>::new(table, &views.tau, wo);
    let (mut in_body, mut any_lobe) = (ZERO, false);
    for k in 0..LANES {
        let body = 1.0 - places.lobe[k];
        in_body[k] = u[0][k].min(body);
        any_lobe |= u[0][k] >= body;
    }
    let Hit {
        a,
        b,
        density: body,
    } = invert(table, &places, &in_body, &u[1]);
    let mut drawn = Drawn::new(
        &views,
        scale2,
        Points {
            a,
            b,
            jacobian: ZERO,
        },
        body,
    );
    if any_lobe {
        drawn.replace(
            &Drawn::by_cosine(table, scale2, &views, &places, u),
            &places.lobe,
            u,
        );
    }
    let mut out = ZERO;
    for k in 0..LANES {
        let p = places.lobe[k] * FRAC_1_PI * drawn.wi.z[k] + drawn.body[k] / drawn.jacobian[k];
        out[k] = if wo.z[k] > 0.0 { p } else { 0.0 };
    }
    SampleLanes {
        wi: drawn.wi,
        pdf: out,
    }
}

/// Directions, the table's density there on the chart, and the chart's Jacobian.
struct Drawn {
    wi: Lanes3,
    body: F,
    jacobian: F,
}

impl Drawn {
    #[inline(always)]
    fn new(views: &Views, scale2: Scale2, mut points: Points, body: F) -> Self {
        Self {
            wi: forward(views, scale2, &mut points),
            body,
            jacobian: points.jacobian,
        }
    }

    /// What the cosine lobe draws, for all lanes.
    #[inline(always)]
    fn by_cosine<const S: usize>(
        table: &Table,
        scale2: Scale2,
        views: &Views,
        places: &Places<S>,
        u: &[F; 2],
    ) -> Self {
        let mut x = ZERO;
        for k in 0..LANES {
            x[k] = (u[0][k] - (1.0 - places.lobe[k])) / places.lobe[k];
        }
        let wi = cosine_hemisphere(&x, &u[1]);
        let points = inverse(views, scale2, &wi);
        Self {
            wi,
            body: density(table, places, &points.a, &points.b),
            jacobian: points.jacobian,
        }
    }

    /// Takes `other` in the lanes whose first number falls to the cosine lobe.
    #[inline(always)]
    fn replace(&mut self, other: &Self, lobe: &F, u: &[F; 2]) {
        for k in 0..LANES {
            let chosen = u[0][k] >= 1.0 - lobe[k];
            let pick = |a: f32, b: f32| if chosen { b } else { a };
            self.wi.x[k] = pick(self.wi.x[k], other.wi.x[k]);
            self.wi.y[k] = pick(self.wi.y[k], other.wi.y[k]);
            self.wi.z[k] = pick(self.wi.z[k], other.wi.z[k]);
            self.body[k] = pick(self.body[k], other.body[k]);
            self.jacobian[k] = pick(self.jacobian[k], other.jacobian[k]);
        }
    }
}
