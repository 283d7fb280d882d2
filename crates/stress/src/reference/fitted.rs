//! Distributions made to fit: the shifted gamma [Bagher2012], ABC [Low2012].

use super::Args;
use super::fresnel::unpolarised;
use crate::real::Real;

/// tan^2 of the half vector.
fn tan2(a: &Args<'_>) -> Real {
    (a.half.x.sqr() + a.half.y.sqr()) / a.half.z.sqr()
}

/// 1 + lambda (1 - exp(c (t - theta0)_+^k)), clamped to 0 ... 1.
fn shadow(a: &Args<'_>, w: &super::Vector) -> Real {
    let t = w.sine().atan2(&w.z) - a.own("theta0");
    if !t.is_positive() {
        return Real::new(1.0);
    }
    let rise = (a.own("c") * t.pow(a.own("k"))).min(&Real::new(1e4));
    let g = 1.0 + a.own("lambda") * (1.0 - rise.exp());
    g.max(&Real::new(0.0)).min(&Real::new(1.0))
}

pub(super) fn sgd(a: &Args<'_>) -> Real {
    let (alpha, f0, m) = (a.own("alpha"), a.own("f0"), 1.0 - a.cos_d());
    let x = alpha + tan2(a) / alpha;
    let hz4 = a.hz().sqr().sqr();
    let d = a.own("kap") * (-&x).exp() / (Real::pi() * x.pow(a.own("p")) * hz4);
    let f = f0 - a.own("f1") * a.cos_d() + (1.0 - Real::new(f0)) * m.pow(5.0);
    let lobe = f * d * shadow(a, &a.wi) * shadow(a, &a.wo) / (&a.wi.z * &a.wo.z);
    a.diffuse() + a.own("ks") * lobe.max(&Real::new(0.0)) / Real::pi()
}

/// Drawn from: x^-p from x = alpha to 1, e^(1-x) beyond; a third of the samples for each channel.
pub(super) fn sgd_pdf(a: &Args<'_>) -> Real {
    let tan2 = tan2(a);
    let one = |c: usize| {
        let (alpha, p) = (a.in_channel("alpha", c), a.in_channel("p", c));
        let x = alpha + &tan2 / alpha;
        let (ln, e) = (Real::new(alpha).ln(), 1.0 - Real::new(p));
        let mass = if alpha >= 1.0 {
            (1.0 - Real::new(alpha)).exp()
        } else if e.is_zero() {
            1.0 - ln
        } else {
            1.0 + (1.0 - (&e * ln).exp()) / e
        };
        let q = if x < 1.0 {
            1.0 / x.pow(p)
        } else {
            (1.0 - x).exp()
        };
        let sec2 = 1.0 + &tan2;
        q / mass * &sec2 * sec2.sqrt() / (Real::pi() * alpha)
    };
    let lobe = (one(0) + one(1) + one(2)) / 3.0 / (4.0 * a.cos_d());
    let any = |name: &str| (0..3).any(|c| a.in_channel(name, c) > 0.0);
    let share = match (any("ks"), any("kd")) {
        (true, true) => Real::new(0.7),
        (true, false) => Real::new(0.9),
        (false, _) => Real::new(0.0),
    };
    a.mixture(&share, lobe)
}

/// (1 + b (1 - hz))^-c.
fn fall_off(a: &Args<'_>) -> Real {
    let base = 1.0 + a.scalar("b") * (1.0 - a.hz());
    (-a.scalar("c") * base.ln()).exp()
}

pub(super) fn abc(a: &Args<'_>) -> Real {
    let fresnel = unpolarised(a.scalar("n"), 0.0, &a.cos_d(), &a.sin2_d());
    let g = a.groove(&a.wi.z).min(&a.groove(&a.wo.z));
    let lobe = fresnel * fall_off(a) * g / (Real::pi() * &a.wi.z * &a.wo.z);
    a.diffuse() + a.own("a") * lobe
}

pub(super) fn abc_pdf(a: &Args<'_>) -> Real {
    let (b, e) = (a.scalar("b"), 1.0 - Real::new(a.scalar("c")));
    let end = (1.0 + Real::new(b)).ln();
    // the integral of (1 + b v)^-c from 0 to 1
    let mass = if e.is_zero() {
        end / b
    } else {
        ((&e * end).exp() - 1.0) / (e * b)
    };
    let cos = a.wo.z.min(&Real::new(1.0));
    let energy = 8.0 * unpolarised(a.scalar("n"), 0.0, &cos, &(1.0 - cos.sqr())) * &mass;
    let share = a.share(
        |c| a.in_channel("a", c) * &energy,
        |c| Real::new(a.in_channel("kd", c)),
    );
    a.mixture(
        &share,
        fall_off(a) / (2.0 * Real::pi() * mass * 4.0 * a.cos_d()),
    )
}
