//! Unpolarised Fresnel reflectance, exact, for conductors and dielectrics alike [BornWolf1999].

use brdf::LANES;

/// Complex refractive indices n + ik relative to the outside, one a channel.
///
/// k = 0 is a dielectric. An infinite n is a perfect mirror (reflectance 1 at every angle).
///
/// A channel as wide as a primary of RGB sees many indices at once: it loses what a [`Mix`] of three of them loses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fresnel<const N: usize> {
    n: [f64; N],
    k: [f64; N],
    /// `None`: every channel has its own index.
    mix: Option<[Mix; N]>,
}

/// What a channel takes of the losses 1 - F of the channel before it, its own and the one after it, in a circle.
/// Channels of colours may take negative shares, and reflect more than 1.
pub type Mix = [f64; 3];

impl<const N: usize> Fresnel<N> {
    /// Reflects everything at every angle: the Fresnel term switched off.
    pub const ONE: Self = Self::from_index([f64::INFINITY; N], [0.0; N]);

    /// Index n + ik per channel, n > 0, k >= 0.
    #[must_use]
    pub const fn from_index(n: [f64; N], k: [f64; N]) -> Self {
        Self { n, k, mix: None }
    }

    /// Indices n + ik of which the channels see mixtures, 1 - `F_c` = sum of the shares times 1 - F.
    #[must_use]
    pub const fn mixed(n: [f64; N], k: [f64; N], mix: [Mix; N]) -> Self {
        Self {
            n,
            k,
            mix: Some(mix),
        }
    }

    /// The dielectric that reflects `f0` at normal incidence: n = (1 + sqrt f0) / (1 - sqrt f0)
    /// [CookTorrance1982]; f0 in [0, 1], and 1 is [`Self::ONE`].
    #[must_use]
    pub fn from_f0(f0: [f64; N]) -> Self {
        let n = f0.map(|f| {
            let s = f.clamp(0.0, 1.0).sqrt();
            if s < 1.0 {
                (1.0 + s) / (1.0 - s)
            } else {
                f64::INFINITY
            }
        });
        Self::from_index(n, [0.0; N])
    }

    /// Reflectance per channel at the cosine `c` of the angle of incidence, [0, 1].
    ///
    /// Near the critical angle of total reflection (n < 1, k = 0) the slope is infinite: take [`Self::eval_at`] there.
    #[inline]
    #[must_use]
    pub fn eval(&self, c: f64) -> [f64; N] {
        self.eval_at(c, (1.0 - c) * (1.0 + c))
    }

    /// [`Self::eval`] with the squared sine of the angle, too, for who knows it better than 1 - c^2 does.
    #[inline(always)]
    #[must_use]
    pub fn eval_at(&self, c: f64, sin2: f64) -> [f64; N] {
        let mut own = [0.0; N];
        for i in 0..N {
            own[i] = unpolarised(self.n[i], self.k[i], [c, sin2]);
        }
        let Some(mix) = &self.mix else {
            return own;
        };
        let mut mixed = [0.0; N];
        for i in 0..N {
            let ([a, b, d], share) = (neighbours(i, N), mix[i]);
            let loss = |j: usize| 1.0 - own[j];
            mixed[i] = 1.0 - (share[0] * loss(a) + share[1] * loss(b) + share[2] * loss(d));
        }
        mixed
    }

    /// [`Self::eval_at`] for a packet of cosines and squared sines.
    #[inline(always)]
    pub(crate) fn eval_lanes(&self, c: &[f32; LANES], sin2: &[f32; LANES]) -> [[f32; LANES]; N] {
        let own: [[f32; LANES]; N] = std::array::from_fn(|i| self.own_lanes(i, c, sin2));
        let Some(mix) = &self.mix else {
            return own;
        };
        std::array::from_fn(|i| {
            let ([a, b, d], share) = (neighbours(i, N), mix[i].map(|m| m as f32));
            let mut f = [0.0; LANES];
            for k in 0..LANES {
                let loss = |j: usize| 1.0 - own[j][k];
                f[k] = 1.0 - (share[0] * loss(a) + share[1] * loss(b) + share[2] * loss(d));
            }
            f
        })
    }

    #[inline(always)]
    fn own_lanes(&self, channel: usize, c: &[f32; LANES], sin2: &[f32; LANES]) -> [f32; LANES] {
        let (n, k) = (self.n[channel], self.k[channel]);
        if n.is_infinite() {
            return [1.0; LANES];
        }
        let index = Unpolarised32::new(n, k);
        let mut out = [0.0; LANES];
        for lane in 0..LANES {
            out[lane] = index.at(c[lane], sin2[lane]);
        }
        out
    }
}

/// The channel before `i` of `count`, itself and the one after it, in a circle.
#[inline]
pub(crate) const fn neighbours(i: usize, count: usize) -> [usize; 3] {
    [(i + count - 1) % count, i, (i + 1) % count]
}

/// Re (n + ik)^2 - 1, with the digits of indices close to 1.
#[inline(always)]
fn excess(n: f64, k: f64) -> f64 {
    (n - 1.0) * (n + 1.0) - k * k
}

/// (Rs + Rp) / 2 of n + ik at cosine c.
///
/// With a + ib = sqrt((n + ik)^2 - sin^2): Rs = |a + ib - c|^2 / |a + ib + c|^2 and Rp = Rs times the same
/// with c -> sin^2 / cos; written so that nothing cancels for k = 0, large k, n close to 1, or grazing angles: with
/// e = Re (n + ik)^2 - 1 the real part of the root's square is e + c^2 or (e + 1) - sin^2, whichever subtracts less, and
/// a - c = (e + b^2)/(a + c). Indices are far from the sixth powers that would overflow. Without branches, so that channels
/// side by side become vector code.
#[inline(always)]
fn unpolarised(n: f64, k: f64, [c, s2]: [f64; 2]) -> f64 {
    let c2 = c * c;
    let e = excess(n, k);
    let re = if c2 < s2 { e + c2 } else { n * n - k * k - s2 };
    let im = n * k;
    let r = (re * re + 4.0 * im * im).sqrt();
    // a^2 and b^2 = (r +- re)/2: take the sum that does not cancel, the other by a b = n k
    let big = 0.5 * (r + re.abs());
    let small = if big > 0.0 { im * im / big } else { 0.0 };
    let a2 = if re >= 0.0 { big } else { small };
    let b2 = if re >= 0.0 { small } else { big };
    let a = a2.sqrt();
    let plus = a + c;
    let plus2 = plus * plus;
    // (a - c)(a + c)
    let product = if re >= 0.0 { e + b2 } else { (a - c) * plus };
    let (s_num, s_den) = (product * product + b2 * plus2, plus2 * (plus2 + b2));
    let (minus, plus) = (a * c - s2, a * c + s2);
    let (p_num, p_den) = (minus * minus + b2 * c2, plus * plus + b2 * c2);
    // along the normal Rp = Rs, also where a is 0
    let rp = if p_den > 0.0 { p_num / p_den } else { 1.0 };
    let f = 0.5 * s_num / s_den * (1.0 + rp);
    // neither index nor cosine: no boundary, or one that light runs along
    let edge = if e.abs() > 0.0 { 1.0 } else { 0.0 };
    let f = if s_den > 0.0 { f } else { edge };
    if n < f64::INFINITY { f } else { 1.0 }
}

/// [`unpolarised`] in f32, of one finite index.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unpolarised32 {
    excess: f32,
    /// n^2 - k^2.
    square: f32,
    /// n k.
    im: f32,
}

impl Unpolarised32 {
    #[inline(always)]
    pub(crate) fn new(n: f64, k: f64) -> Self {
        Self {
            excess: excess(n, k) as f32,
            square: (n * n - k * k) as f32,
            im: (n * k) as f32,
        }
    }

    #[inline(always)]
    pub(crate) fn at(self, c: f32, s2: f32) -> f32 {
        let Self {
            excess: e,
            square,
            im,
        } = self;
        let c2 = c * c;
        let re = if c2 < s2 { e + c2 } else { square - s2 };
        let r = (re * re + 4.0 * im * im).sqrt();
        let big = 0.5 * (r + re.abs()) + f32::MIN_POSITIVE;
        let small = im * im / big;
        let (a2, b2) = if re >= 0.0 {
            (big, small)
        } else {
            (small, big)
        };
        let a = a2.sqrt();
        let plus = a + c;
        let minus = if re >= 0.0 { (e + b2) / plus } else { a - c };
        // one division for Rs (1 + Rp/Rs)
        let (s_num, s_den) = (minus * minus + b2, plus * plus + b2);
        let (minus, plus) = (a * c - s2, a * c + s2);
        let (p_num, p_den) = (
            minus * minus + b2 * c2,
            plus * plus + b2 * c2 + f32::MIN_POSITIVE,
        );
        0.5 * s_num * (p_num + p_den) / (s_den * p_den)
    }
}

#[cfg(test)]
mod tests {
    use super::Fresnel;
    use brdf::LANES;

    #[test]
    fn normal_incidence_and_grazing() {
        let f = Fresnel::from_index([1.5, 0.2, 2.0], [0.0, 3.9, 1.0]);
        let normal = f.eval(1.0);
        for (c, (n, k)) in [(1.5_f64, 0.0_f64), (0.2, 3.9), (2.0, 1.0)]
            .into_iter()
            .enumerate()
        {
            let expected = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
            assert!(
                (normal[c] - expected).abs() < 1e-15,
                "{} {expected}",
                normal[c]
            );
        }
        assert!(
            f.eval(0.0).iter().all(|r| (r - 1.0).abs() < 1e-15),
            "{:?}",
            f.eval(0.0)
        );
    }

    #[test]
    fn brewster_and_total_reflection() {
        // at Brewster's angle tan t = n only s light returns: R = ((n^2-1)/(n^2+1))^2 / 2
        let n = 1.5_f64;
        let r = Fresnel::from_index([n], [0.0]).eval(1.0 / n.hypot(1.0))[0];
        let expected = 0.5 * ((n * n - 1.0) / (n * n + 1.0)).powi(2);
        assert!((r - expected).abs() < 1e-15, "{r} {expected}");
        // from glass to air beyond the critical angle
        assert!(
            (Fresnel::from_index([1.0 / n], [0.0]).eval(0.5)[0] - 1.0).abs() < 1e-15,
            "total reflection"
        );
    }

    #[test]
    fn f0_gives_back_itself_and_one_is_one() {
        let f0 = [0.04, 0.5, 1.0];
        let f = Fresnel::from_f0(f0);
        for c in 0..3 {
            assert!((f.eval(1.0)[c] - f0[c]).abs() < 1e-14, "{c}");
        }
        assert!(
            (f.eval(0.3)[2] - 1.0).abs() < 1e-15,
            "f0 = 1 reflects everything"
        );
    }

    #[test]
    fn mixtures_add_losses() {
        let (n, k) = ([0.2, 0.9, 1.7], [3.9, 2.5, 9.2]);
        let own = Fresnel::from_index(n, k);
        let mix = [[0.5, 0.25, 0.25], [0.0, 1.0, 0.0], [2.0, -1.0, 0.0]];
        let mixed = Fresnel::mixed(n, k, mix);
        for c in [0.0, 0.3, 1.0] {
            let ([a, b, d], f) = (own.eval(c), mixed.eval(c));
            // the neighbours of the first are the last and the second
            assert!(
                (f[0] - (0.5 * d + 0.25 * a + 0.25 * b)).abs() < 1e-15,
                "{f:?}"
            );
            assert!((f[1] - b).abs() < 1e-15, "{f:?}");
            assert!((f[2] - (2.0 * b - d)).abs() < 1e-15, "{f:?}");
        }
    }

    #[test]
    fn lanes_follow_the_scalar_form() {
        let (n, k) = ([0.2, 0.9, 1.7], [3.9, 2.5, 9.2]);
        let mix = [[0.0, 1.0, 0.0], [-0.1, 0.9, 0.2], [0.3, 1.2, -0.5]];
        for f in [Fresnel::from_index(n, k), Fresnel::mixed(n, k, mix)] {
            let c: [f32; LANES] = std::array::from_fn(|k| k as f32 / (LANES - 1) as f32);
            let sin2 = c.map(|c| (1.0 - c) * (1.0 + c));
            let lanes = f.eval_lanes(&c, &sin2);
            for channel in 0..3 {
                for k in 0..LANES {
                    let exact = f.eval(f64::from(c[k]))[channel];
                    // a dozen f32 operations on numbers of order |n + ik|^2
                    assert!(
                        (f64::from(lanes[channel][k]) - exact).abs() < 3e-6,
                        "{} {exact}",
                        lanes[channel][k]
                    );
                }
            }
        }
    }
}
