//! Scatter by the distance of direction cosines: ABg [Pfisterer2011], Harvey-Shack [Harvey1976], K-correlation
//! [Church1989], [Dittman2006].

use super::Args;
use crate::real::Real;

/// |beta - beta0|^2.
fn distance2(a: &Args<'_>) -> Real {
    a.half.x.sqr() + a.half.y.sqr()
}

/// The integral of t^(e-1) from 1 to `end`.
fn power_integral(e: &Real, end: &Real) -> Real {
    if e.is_zero() {
        end.ln()
    } else {
        ((e * end.ln()).exp() - 1.0) / e
    }
}

/// Share of the lobe whose integral is `mass` times its weight, and the density of a direction in it.
fn mixed(a: &Args<'_>, weight: &str, mass: &Real, density: Real) -> Real {
    let share = a.share(
        |c| a.in_channel(weight, c) * mass,
        |c| Real::new(a.in_channel("kd", c)),
    );
    a.mixture(&share, density * &a.wi.z)
}

pub(super) fn abg(a: &Args<'_>) -> Real {
    let power = distance2(a).sqrt().pow(a.scalar("g"));
    a.diffuse() + a.own("a") / (a.scalar("b") + power)
}

/// Drawn from: flat up to r0 = b^(1/g), at most 2, then (r0/r)^g up to the radius 2.
pub(super) fn abg_pdf(a: &Args<'_>) -> Real {
    let g = Real::new(a.scalar("g"));
    let shoulder = (Real::new(a.scalar("b")).ln() / &g)
        .exp()
        .min(&Real::new(2.0));
    let slope = 2.0 * power_integral(&(2.0 - &g), &(2.0 / &shoulder));
    let whole = Real::pi() * shoulder.sqr() * (1.0 + slope);
    let beyond = (distance2(a).sqrt() / shoulder).max(&Real::new(1.0));
    let density = (-(g * beyond.ln())).exp() / &whole;
    mixed(a, "a", &(whole / a.scalar("b")), density)
}

/// (1 + r^2/l^2)^(s/2) at r^2.
fn power(r2: &Real, l: &Real, s: &Real) -> Real {
    (s * 0.5 * (1.0 + r2 / l.sqr()).ln()).exp()
}

/// Its integral over the disc of `radius`.
fn disc(radius: f64, l: &Real, s: &Real) -> Real {
    let end = 1.0 + (radius / l).sqr();
    Real::pi() * l.sqr() * power_integral(&(s * 0.5 + 1.0), &end)
}

fn harvey(a: &Args<'_>) -> (Real, Real) {
    (Real::new(a.scalar("l")), Real::new(a.scalar("s")))
}

pub(super) fn harvey_shack(a: &Args<'_>) -> Real {
    let (l, s) = harvey(a);
    a.diffuse() + a.own("b0") * power(&distance2(a), &l, &s)
}

pub(super) fn harvey_shack_pdf(a: &Args<'_>) -> Real {
    let (l, s) = harvey(a);
    let density = power(&distance2(a), &l, &s) / disc(2.0, &l, &s);
    mixed(a, "b0", &disc(1.0, &l, &s), density)
}

/// lambda/B, the shoulder in direction cosines.
fn shoulder(a: &Args<'_>, channel: usize) -> Real {
    Real::new(a.in_channel("lambda", channel)) / 1000.0 / a.scalar("b")
}

/// (4 pi sigma/lambda)^2.
fn phase2(a: &Args<'_>, channel: usize) -> Real {
    (4.0 * Real::pi() * a.scalar("sigma") / a.in_channel("lambda", channel)).sqr()
}

pub(super) fn k_correlation(a: &Args<'_>) -> Real {
    let (l, s) = (shoulder(a, a.channel), a.scalar("s"));
    let peak = phase2(a, a.channel) * (Real::new(s) - 2.0) / (2.0 * Real::pi() * l.sqr());
    let shape = power(&distance2(a), &l, &Real::new(-s));
    a.diffuse() + a.own("ks") * (&a.wi.z * &a.wo.z) * peak * shape
}

pub(super) fn k_correlation_pdf(a: &Args<'_>) -> Real {
    let s = Real::new(a.scalar("s"));
    let cos2 = a.wo.z.min(&Real::new(1.0)).sqr();
    // the share of sigma^2 at frequencies below 1/lambda
    let seen = |c: usize| 1.0 - power(&Real::new(1.0), &shoulder(a, c), &(2.0 - &s));
    let share = a.share(
        |c| a.in_channel("ks", c) * phase2(a, c) * seen(c) * &cos2,
        |c| Real::new(a.in_channel("kd", c)),
    );
    let density = |c: usize| {
        let (l, s) = (shoulder(a, c), -&s);
        power(&distance2(a), &l, &s) / disc(2.0, &l, &s)
    };
    let mean = (density(0) + density(1) + density(2)) / 3.0;
    a.mixture(&share, mean * &a.wi.z)
}
