//! He, Torrance, Sillion and Greenberg [He1991] and what its limit is made of: Smith's shadowing [Smith1967].

use super::{Args, Vector};
use crate::real::Real;

/// The terms that are left out, relative to the largest: e^-40.
const TAIL: f64 = 40.0;
/// From here on Stirling's series to 1/m^5 gives ln m! to 1e-20.
const STIRLING: f64 = 600.0;

/// What Smith's theory says of one direction over facets of slope `m`.
pub(super) struct Smith {
    /// erfc(cot(theta)/m).
    pub(super) erfc: Real,
    /// 1/(1 + Lambda).
    pub(super) g1: Real,
}

pub(super) fn smith(w: &Vector, m: &Real) -> Smith {
    let sine = w.sine();
    if sine.is_zero() || m.is_zero() {
        let (erfc, g1) = (Real::new(0.0), Real::new(1.0));
        return Smith { erfc, g1 };
    }
    let q = &w.z / (w.z.sqr() + w.x.sqr() + w.y.sqr()).sqrt() / (m * sine);
    let erfc = q.erfc();
    let lambda = ((-q.sqr()).exp() / (Real::pi().sqrt() * &q) - &erfc) * 0.5;
    let g1 = 1.0 / (1.0 + lambda.max(&Real::new(0.0)));
    Smith { erfc, g1 }
}

/// y with y e^y = c^2: by y + ln y = 2 ln c, Newton's method.
fn lambert_w(c: &Real) -> Real {
    let target = c.ln() * 2.0;
    let t = target.to_f64();
    if t < -100.0 {
        // y = c^2 (1 - c^2 ...)
        return c.sqr();
    }
    let step = |y: f64| y * (1.0 + t - y.ln()) / (1.0 + y);
    let mut y = if t > 1.0 { t } else { t.exp().min(1.0) };
    for _ in 0..60 {
        y = step(y).max(1e-60);
    }
    let mut y = Real::new(y);
    for _ in 0..2 {
        y = &y * (1.0 + &target - y.ln()) / (1.0 + &y);
    }
    y
}

/// sum over m >= 1 of e^-g g^m/(m! m) e^(-w/m).
fn series(g: &Real, w: &Real) -> Real {
    if !g.is_positive() {
        return Real::new(0.0);
    }
    let (gf, wf) = (g.to_f64(), w.to_f64());
    // the largest term, where ln(g/m) + w/m^2 = 0; the left side falls with m
    let slope = |m: f64| (gf / m).ln() + wf / m / m;
    let (mut low, mut high) = (gf.max(1e-300), gf.max(1.0));
    while slope(high) > 0.0 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        *if slope(middle) > 0.0 {
            &mut low
        } else {
            &mut high
        } = middle;
    }
    if high < STIRLING {
        direct(gf, wf, high)
    } else {
        strided(g, w, high)
    }
}

/// Term by term: a recurrence, each step good to 1e-16. The largest term is near `m0`.
fn direct(g: f64, w: f64, m0: f64) -> Real {
    let (mut factor, mut sum, mut m) = (Real::new(-g).exp() * g, Real::new(0.0), 1.0);
    loop {
        let exponent = -w / m;
        // under e^-1000 nothing is told from zero
        if exponent > -1000.0 {
            let term = &factor * Real::new(exponent).exp();
            sum = sum + &term;
            if m > m0 && term.to_f64() <= 1e-24 * sum.to_f64() {
                return sum;
            }
        }
        if m > 2.0 * STIRLING {
            return sum;
        }
        factor = factor * (g * m / ((m + 1.0) * (m + 1.0)));
        m += 1.0;
    }
}

/// Every n-th term, n a third of a deviation: for a summand as smooth as that the trapezoidal rule errs by
/// e^(-2 pi^2 9) [Trefethen2014]. Logarithms to 160 bits, since m ln g and ln m! cancel.
fn strided(g: &Real, w: &Real, m0: f64) -> Real {
    let ln_g = g.ln();
    let ln_term = |m: f64| {
        let inv = 1.0 / Real::new(m);
        let stirling = &inv / 12.0 - inv.pow(3.0) / 360.0 + inv.pow(5.0) / 1260.0;
        let ln_m = Real::new(m).ln();
        m * (&ln_g - &ln_m) + m
            - g
            - 1.5 * ln_m
            - 0.5 * (2.0 * Real::pi()).ln()
            - stirling
            - w * inv
    };
    let deviation = (m0 / (1.0 + 2.0 * w.to_f64() / m0 / m0)).sqrt();
    let (stride, m0) = ((deviation / 3.0).round().max(1.0), m0.round());
    let peak = ln_term(m0);
    let mut sum = 1.0;
    for side in [stride, -stride] {
        let mut m = m0 + side;
        while m >= 1.0 {
            let below = (ln_term(m) - &peak).to_f64();
            sum += below.exp();
            if below < -TAIL {
                break;
            }
            m += side;
        }
    }
    peak.exp() * sum * stride
}

/// S(i) S(o) and (sigma0/sigma)^2 = 1 + (z0/sigma0)^2.
fn shared(a: &Args<'_>, wi: &Vector, wo: &Vector) -> (Real, Real) {
    let m = 2.0 * Real::new(a.scalar("sigma")) / a.scalar("tau");
    let (i, o) = (smith(wi, &m), smith(wo, &m));
    let shadow = |s: &Smith| (1.0 - &s.erfc * 0.5) * &s.g1;
    let k = |w: &Vector, s: &Smith| w.sine() * w.length() / &w.z * &s.erfc;
    let c = (k(wi, &i) + k(wo, &o)) / (8.0 * Real::pi()).sqrt();
    let apparent = if c.is_positive() {
        1.0 + lambert_w(&c)
    } else {
        Real::new(1.0)
    };
    (shadow(&i) * shadow(&o), apparent)
}

/// k = 2 pi/lambda, 1/um.
fn wave_number(a: &Args<'_>, channel: usize) -> Real {
    2.0 * Real::pi() / (Real::new(a.in_channel("lambda", channel)) / 1000.0)
}

/// tan^2 of the half vector.
fn tan2(a: &Args<'_>) -> Real {
    (a.half.x.sqr() + a.half.y.sqr()) / a.half.z.sqr()
}

pub(super) fn he(a: &Args<'_>) -> Real {
    let (sigma, tau) = (a.scalar("sigma"), a.scalar("tau"));
    let (s, apparent) = shared(a, &a.wi, &a.wo);
    let wave_number = wave_number(a, a.channel);
    let g = (&wave_number * sigma * &a.half.z).sqr() / apparent;
    let k2_tau2 = (wave_number * tau).sqr();
    let w = &k2_tau2 * (a.half.x.sqr() + a.half.y.sqr()) * 0.25;
    let geometry = (a.len.sqr() / &a.half.z).sqr();
    let rough = geometry * k2_tau2 / 16.0 * series(&g, &w) / (Real::pi() * &a.wi.z * &a.wo.z);
    let width2 = Real::new(a.scalar("width")).sqr();
    let mirror =
        (-(tan2(a) / &width2)).exp() / (Real::pi() * width2) * a.len.sqr() / a.half.z.sqr().sqr();
    let parts = a.scalar("mirror") * (-g).exp() * mirror + rough;
    a.diffuse() + a.own("ks") * a.fresnel(a.channel, &a.cos_d(), &a.sin2_d()) * s * parts
}

/// The density of its own sampler: lobes of Beckmann's normals for the mirror and for the directional-diffuse part,
/// weighted by what each reflects toward the viewer, over at least a tenth of a cosine lobe.
pub(super) fn he_pdf(a: &Args<'_>) -> Real {
    let (shadow, apparent) = shared(a, &a.wo, &a.wo);
    let (sigma, cos) = (a.scalar("sigma"), a.wo.z.min(&Real::new(1.0)));
    let sin2 = 1.0 - cos.sqr();
    let (mut mirror, mut rough, mut width2) = (Real::new(0.0), Real::new(0.0), Real::new(0.0));
    let mut diffuse = 0.0;
    for c in 0..3 {
        let k = wave_number(a, c);
        let e = (-((&k * sigma * 2.0 * &a.wo.z).sqr() / &apparent)).exp();
        let weight = a.in_channel("ks", c) * a.fresnel(c, &cos, &sin2) * &shadow;
        mirror = mirror + a.scalar("mirror") * &weight * &e;
        rough = rough + weight * (1.0 - e);
        width2 = width2 + (1.0 / (k * a.scalar("tau") * &a.wo.z)).sqr();
        diffuse += a.in_channel("kd", c);
    }
    let slope2 = (2.0 * Real::new(sigma) / a.scalar("tau")).sqr();
    let m = (slope2 / &apparent + width2 / 3.0).sqrt();
    let m = m.max(&Real::new(1e-5)).min(&Real::new(1.0));
    let lobes = &mirror + &rough;
    let total = &lobes + diffuse;
    let cosine = if total.is_positive() {
        (1.0 - &lobes / &total).max(&Real::new(0.1))
    } else {
        Real::new(1.0)
    };
    let share = |part: Real| {
        if lobes.is_positive() {
            part / &lobes * (1.0 - &cosine)
        } else {
            Real::new(0.0)
        }
    };
    let hz = a.hz();
    let beckmann = |m2: Real| (-(tan2(a) / &m2)).exp() / (Real::pi() * m2 * hz.sqr().sqr());
    let width2 = Real::new(a.scalar("width")).sqr();
    // facets not weighted by what is seen of them, and those a viewer sees of grooves
    let narrow = beckmann(width2) * &hz / (4.0 * a.cos_d());
    let wide = a.groove(&a.wo.z) * beckmann(m.sqr()) / (4.0 * &a.wo.z);
    share(mirror) * narrow + share(rough) * wide + cosine * &a.wi.z / Real::pi()
}

#[cfg(test)]
mod tests {
    use super::{direct, lambert_w, strided};
    use crate::real::Real;

    #[test]
    fn both_sums_agree_where_either_may_be_taken() {
        for (g, w) in [(700.0, 0.0), (650.0, 3e4), (900.0, 1e3)] {
            let m0 = 700.0;
            let (a, b) = (direct(g, w, m0), strided(&Real::new(g), &Real::new(w), m0));
            let error = (a.to_f64() / b.to_f64() - 1.0).abs();
            assert!(error < 1e-12, "{g} {w}: {error:e}");
        }
    }

    #[test]
    fn lambert_w_solves_its_equation() {
        for c in [1e-40, 1e-9, 0.3, 1.0, 1e5, 1e15] {
            let c = Real::new(c);
            let y = lambert_w(&c);
            let error = (&y * y.exp() / c.sqr()).to_f64() - 1.0;
            assert!(error.abs() < 1e-15, "{c:?}: {error:e}");
        }
    }
}
