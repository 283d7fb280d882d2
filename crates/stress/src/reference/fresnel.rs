//! Fresnel's equations for a complex index [BornWolf1999], as quotients of complex numbers.

use super::Args;
use crate::real::Real;
use brdf_models::Substance;

/// (Rs + Rp)/2 of n + ik at cosine `c` and squared sine `s2`.
///
/// Both are scaled to cos^2 + sin^2 = 1, and q^2 is (n + ik)^2 - 1 + cos^2, so that an index of 1 reflects nothing: with
/// 1 - sin^2 in its place the last of the 160 bits, over the square of a cosine of 1e-7, would be seen as 1e-56.
pub(crate) fn unpolarised(n: f64, k: f64, c: &Real, s2: &Real) -> Real {
    let one = c.sqr() + s2;
    let c = &(c / one.sqrt());
    let (n, k) = (Real::new(n), Real::new(k));
    // (n + ik)^2 and q = a + ib = sqrt((n + ik)^2 - s^2)
    let (e_re, e_im) = (n.sqr() - k.sqr(), 2.0 * &n * &k);
    let (q_re, q_im) = (&e_re - 1.0 + c.sqr(), e_im.clone());
    let modulus = (q_re.sqr() + q_im.sqr()).sqrt();
    let a = ((&modulus + &q_re) * 0.5).sqrt();
    // no absorption, no total reflection: exactly 0
    let b = if q_im.is_zero() && q_re.is_positive() {
        Real::new(0.0)
    } else {
        ((&modulus - &q_re) * 0.5).sqrt()
    };
    let quotient = |re: Real, im: Real, over_re: Real, over_im: Real| {
        let over = over_re.sqr() + over_im.sqr();
        if over.is_zero() {
            Real::new(1.0)
        } else {
            (re.sqr() + im.sqr()) / over
        }
    };
    let rs = quotient(c - &a, -&b, c + &a, b.clone());
    let (p_re, p_im) = (&e_re * c, &e_im * c);
    let rp = quotient(&p_re - &a, &p_im - &b, &p_re + &a, &p_im + &b);
    (rs + rp) * 0.5
}

impl Args<'_> {
    /// The Fresnel term of a microfacet model at cosine `c` and squared sine `s2`, from whichever of f0, n and k, or
    /// index was given.
    pub(super) fn fresnel(&self, channel: usize, c: &Real, s2: &Real) -> Real {
        if let Some(substance) = self.values.choice("index").and_then(Substance::named) {
            let seen = substance.srgb();
            // the losses of the channel before, its own and of the one after, in a circle
            let loss = |j: usize| {
                let of = seen[(channel + 2 + j) % 3];
                seen[channel].mix[j] * (1.0 - unpolarised(of.n, of.k, c, s2))
            };
            return 1.0 - (loss(0) + loss(1) + loss(2));
        }
        let (n, k) = (self.values.get("n"), self.values.get("k"));
        if !n.is_empty() || !k.is_empty() {
            let or = |name, given: &[f64], otherwise: f64| {
                if given.is_empty() {
                    otherwise
                } else {
                    self.in_channel(name, channel)
                }
            };
            return unpolarised(or("n", n, 1.0), or("k", k, 0.0), c, s2);
        }
        let f0 = self.values.get("f0");
        let f0 = if f0.is_empty() {
            1.0
        } else {
            self.in_channel("f0", channel)
        };
        if f0 >= 1.0 {
            return Real::new(1.0);
        }
        let root = Real::new(f0).sqrt();
        unpolarised(((1.0 + &root) / (1.0 - &root)).to_f64(), 0.0, c, s2)
    }
}
