//! Lambert, Oren-Nayar [OrenNayar1994], EON [Portsmouth2025].

use super::Args;
use crate::real::Real;

pub(super) fn lambert(a: &Args<'_>) -> Real {
    a.diffuse()
}

pub(super) fn cosine(a: &Args<'_>) -> Real {
    &a.wi.z / Real::pi()
}

pub(super) fn oren_nayar(a: &Args<'_>) -> Real {
    let (rho, sigma) = (a.own("kd"), a.scalar("sigma"));
    let s2 = Real::new(sigma).sqr();
    let (si, so) = (a.wi.sine(), a.wo.sine());
    let product = &si * &so;
    let cos_phi = if product.is_zero() {
        Real::new(0.0)
    } else {
        (&a.wi.x * &a.wo.x + &a.wi.y * &a.wo.y) / product
    };
    let (ti, to) = (si.atan2(&a.wi.z), so.atan2(&a.wo.z));
    let (alpha, beta) = (ti.max(&to), ti.min(&to));
    let pi = Real::pi();
    let c1 = 1.0 - 0.5 * &s2 / (&s2 + 0.33);
    let back = if cos_phi.is_positive() || cos_phi.is_zero() {
        Real::new(0.0)
    } else {
        (&beta * 2.0 / &pi).pow(3.0)
    };
    let c2 = 0.45 * &s2 / (&s2 + 0.09) * (alpha.sin() - back);
    let c3 = 0.125 * &s2 / (&s2 + 0.09) * (&alpha * &beta * 4.0 / pi.sqr()).sqr();
    let tan = |x: &Real| x.sin() / x.cos();
    let direct = c1
        + &cos_phi * c2 * tan(&beta)
        + (1.0 - cos_phi.abs()) * c3 * tan(&((&alpha + &beta) * 0.5));
    let twice = 0.17 * &s2 / (&s2 + 0.13) * (1.0 - cos_phi * (&beta * 2.0 / &pi).sqr());
    // negative where the fit of the paper dips below zero: the model says 0
    (rho / pi * (direct + rho * twice)).max(&Real::new(0.0))
}

/// Directional albedo of the single-scattering part per unit of albedo, from the paper's G.
fn eon_albedo(sine: &Real, cosine: &Real, r: f64) -> Real {
    let pi = Real::pi();
    let g = sine * (sine.atan2(cosine) - sine * cosine)
        + 2.0 / Real::new(3.0) * (sine / cosine * (1.0 - sine.pow(3.0)) - sine);
    eon_a(r) * (1.0 + r * g / pi)
}

/// A = 1/(1 + (1/2 - 2/(3 pi)) r).
fn eon_a(r: f64) -> Real {
    1.0 / (1.0 + (0.5 - 2.0 / (3.0 * Real::pi())) * r)
}

pub(super) fn eon(a: &Args<'_>) -> Real {
    let (rho, r) = (a.own("kd"), a.scalar("r"));
    let pi = Real::pi();
    // of unit vectors, since 1 + s is almost 0 for opposite grazing directions
    let s = (&a.wi.x * &a.wo.x + &a.wi.y * &a.wo.y) / (a.wi.length() * a.wo.length());
    let t = if s.is_positive() {
        a.wi.z.max(&a.wo.z)
    } else {
        Real::new(1.0)
    };
    let single = rho / &pi * eon_a(r) * (1.0 + r * s / t);
    if r == 0.0 {
        return single;
    }
    let mean = eon_a(r) * (1.0 + (2.0 / Real::new(3.0) - 28.0 / (15.0 * &pi)) * r);
    let rho_ms = rho * rho * &mean / (1.0 - rho * (1.0 - &mean));
    let missing = |w: &super::Vector| 1.0 - eon_albedo(&w.sine(), &w.z, r);
    single + rho_ms / pi * missing(&a.wi) * missing(&a.wo) / (1.0 - mean)
}
