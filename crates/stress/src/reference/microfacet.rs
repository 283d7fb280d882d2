//! Cook-Torrance [CookTorrance1982], also with Smith's masking, and GGX [Walter2007], F D G / (4 ci co).

use super::he::smith;
use super::{Args, Vector};
use crate::real::Real;

fn specular(a: &Args<'_>, d_g: Real) -> Real {
    let f = a.fresnel(a.channel, &a.cos_d(), &a.sin2_d());
    a.diffuse() + a.own("ks") * f * d_g / (4.0 * &a.wi.z * &a.wo.z)
}

fn share(a: &Args<'_>) -> Real {
    let cos = a.wo.z.min(&Real::new(1.0));
    let sin2 = 1.0 - cos.sqr();
    a.share(
        |c| a.in_channel("ks", c) * a.fresnel(c, &cos, &sin2),
        |c| Real::new(a.in_channel("kd", c)),
    )
}

/// Beckmann's D.
fn beckmann(a: &Args<'_>, m: f64) -> Real {
    let z2 = a.hz().sqr();
    let tan2 = (1.0 - &z2) / &z2;
    (-tan2 / Real::new(m).sqr()).exp() / (Real::pi() * Real::new(m).sqr() * z2.sqr())
}

pub(super) fn cook_torrance(a: &Args<'_>) -> Real {
    let g = a.groove(&a.wi.z).min(&a.groove(&a.wo.z));
    specular(a, beckmann(a, a.scalar("m")) * g)
}

pub(super) fn cook_torrance_smith(a: &Args<'_>) -> Real {
    let m = a.scalar("m");
    let g1 = |w| smith(w, &Real::new(m)).g1;
    specular(a, beckmann(a, m) * g1(&a.wi) * g1(&a.wo))
}

pub(super) fn cook_torrance_pdf(a: &Args<'_>) -> Real {
    let lobe = a.groove(&a.wo.z) * beckmann(a, a.scalar("m")) / (4.0 * &a.wo.z);
    a.mixture(&share(a), lobe)
}

fn alphas(a: &Args<'_>) -> (f64, f64) {
    (a.scalar("alpha_x"), a.scalar("alpha_y"))
}

fn trowbridge_reitz(a: &Args<'_>) -> Real {
    let (ax, ay) = alphas(a);
    let (x, y) = (&a.half.x / &a.len / ax, &a.half.y / &a.len / ay);
    1.0 / (Real::pi() * ax * ay * (x.sqr() + y.sqr() + a.hz().sqr()).sqr())
}

/// Smith's lambda.
fn lambda(a: &Args<'_>, w: &Vector) -> Real {
    let (ax, ay) = alphas(a);
    let tan2 = ((&w.x * ax).sqr() + (&w.y * ay).sqr()) / w.z.sqr();
    ((1.0 + tan2).sqrt() - 1.0) * 0.5
}

pub(super) fn ggx(a: &Args<'_>) -> Real {
    let g2 = 1.0 / (1.0 + lambda(a, &a.wi) + lambda(a, &a.wo));
    specular(a, trowbridge_reitz(a) * g2)
}

pub(super) fn ggx_pdf(a: &Args<'_>) -> Real {
    let g1 = 1.0 / (1.0 + lambda(a, &a.wo));
    let lobe = g1 * trowbridge_reitz(a) / (4.0 * &a.wo.z);
    let bare = (0..3).all(|c| a.in_channel("kd", c) <= 0.0);
    let share = if bare { Real::new(1.0) } else { share(a) };
    a.mixture(&share, lobe)
}
