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

pub(super) fn he(a: &Args<'_>) -> Real {
    let (sigma, tau) = (a.scalar("sigma"), a.scalar("tau"));
    let m = 2.0 * Real::new(sigma) / tau;
    let (i, o) = (smith(&a.wi, &m), smith(&a.wo, &m));
    let shadow = |s: &Smith| (1.0 - &s.erfc * 0.5) * &s.g1;
    let s = shadow(&i) * shadow(&o);
    let k = |w: &Vector, s: &Smith| w.sine() * w.length() / &w.z * &s.erfc;
    let c = (k(&a.wi, &i) + k(&a.wo, &o)) / (8.0 * Real::pi()).sqrt();
    // (sigma0/sigma)^2 = 1 + (z0/sigma0)^2
    let apparent = if c.is_positive() {
        1.0 + lambert_w(&c)
    } else {
        Real::new(1.0)
    };
    let wave_number = 2.0 * Real::pi() / (Real::new(a.own("lambda")) / 1000.0);
    let g = (&wave_number * sigma * &a.half.z).sqr() / apparent;
    let k2_tau2 = (wave_number * tau).sqr();
    let w = &k2_tau2 * (a.half.x.sqr() + a.half.y.sqr()) * 0.25;
    let geometry = (a.len.sqr() / &a.half.z).sqr();
    let rough = geometry * k2_tau2 / 16.0 * series(&g, &w) / (Real::pi() * &a.wi.z * &a.wo.z);
    let width2 = Real::new(a.scalar("width")).sqr();
    let tan2 = (a.half.x.sqr() + a.half.y.sqr()) / a.half.z.sqr();
    let mirror =
        (-(tan2 / &width2)).exp() / (Real::pi() * width2) * a.len.sqr() / a.half.z.sqr().sqr();
    let parts = a.scalar("mirror") * (-g).exp() * mirror + rough;
    a.diffuse() + a.own("ks") * a.fresnel(a.channel, &a.cos_d(), &a.sin2_d()) * s * parts
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
