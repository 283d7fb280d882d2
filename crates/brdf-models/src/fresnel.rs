//! Unpolarised Fresnel reflectance, exact, for conductors and dielectrics alike [BornWolf1999].

use brdf::LANES;

/// Complex refractive indices n + ik relative to the outside, one a channel.
///
/// k = 0 is a dielectric. An infinite n is a perfect mirror (reflectance 1 at every angle).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fresnel<const N: usize> {
    n: [f64; N],
    k: [f64; N],
}

impl<const N: usize> Fresnel<N> {
    /// Reflects everything at every angle: the Fresnel term switched off.
    pub const ONE: Self = Self {
        n: [f64::INFINITY; N],
        k: [0.0; N],
    };

    /// Index n + ik per channel, n > 0, k >= 0.
    #[must_use]
    pub const fn from_index(n: [f64; N], k: [f64; N]) -> Self {
        Self { n, k }
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
        Self { n, k: [0.0; N] }
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
    #[inline]
    #[must_use]
    pub fn eval_at(&self, c: f64, sin2: f64) -> [f64; N] {
        std::array::from_fn(|i| unpolarised(self.n[i], self.k[i], [c, sin2]))
    }

    /// [`Self::eval_at`] of one channel for a packet of cosines and squared sines.
    #[inline(always)]
    pub(crate) fn eval_lanes(
        &self,
        channel: usize,
        c: &[f32; LANES],
        sin2: &[f32; LANES],
    ) -> [f32; LANES] {
        let (n, k) = (self.n[channel], self.k[channel]);
        if n.is_infinite() {
            return [1.0; LANES];
        }
        let (e, square, im) = (excess(n, k) as f32, (n * n - k * k) as f32, (n * k) as f32);
        let mut out = [0.0; LANES];
        for lane in 0..LANES {
            out[lane] = unpolarised_f32(e, square, im, [c[lane], sin2[lane]]);
        }
        out
    }
}

/// Re (n + ik)^2 - 1, with the digits of indices close to 1.
#[inline]
fn excess(n: f64, k: f64) -> f64 {
    (n - 1.0) * (n + 1.0) - k * k
}

/// (Rs + Rp) / 2 of n + ik at cosine c.
///
/// With a + ib = sqrt((n + ik)^2 - sin^2): Rs = |a + ib - c|^2 / |a + ib + c|^2 and Rp = Rs times the same
/// with c -> sin^2 / cos; written so that nothing cancels for k = 0, large k, n close to 1, or grazing angles: with
/// e = Re (n + ik)^2 - 1 the real part of the root's square is e + c^2 or (e + 1) - sin^2, whichever subtracts less, and
/// a - c = (e + b^2)/(a + c).
#[inline]
fn unpolarised(n: f64, k: f64, [c, s2]: [f64; 2]) -> f64 {
    if n.is_infinite() {
        return 1.0;
    }
    let c2 = c * c;
    let e = excess(n, k);
    let re = if c2 < s2 { e + c2 } else { n * n - k * k - s2 };
    let im = n * k;
    // indices are far from the squares that would overflow: no hypot needed
    let r = (re * re + 4.0 * im * im).sqrt();
    // a^2 and b^2 = (r +- re)/2: take the sum that does not cancel, the other by a b = n k
    let big = 0.5 * (r + re.abs());
    let small = if big > 0.0 { im * im / big } else { 0.0 };
    let (a2, b2) = if re >= 0.0 {
        (big, small)
    } else {
        (small, big)
    };
    let a = a2.sqrt();
    let plus = a + c;
    // neither index nor cosine: no boundary, or one that light runs along
    if plus <= 0.0 && b2 <= 0.0 {
        return if e.abs() > 0.0 { 1.0 } else { 0.0 };
    }
    let minus = if re >= 0.0 { (e + b2) / plus } else { a - c };
    let rs = (minus * minus + b2) / (plus * plus + b2);
    let (minus, plus) = (a * c - s2, a * c + s2);
    let rp = (minus * minus + b2 * c2) / (plus * plus + b2 * c2);
    0.5 * rs * (1.0 + if rp.is_nan() { 1.0 } else { rp })
}

/// [`unpolarised`] in f32; `e` is the [`excess`], `square` = n^2 - k^2, `im` = n k.
#[inline(always)]
fn unpolarised_f32(e: f32, square: f32, im: f32, [c, s2]: [f32; 2]) -> f32 {
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

/// Refractive index n and extinction k of a metal in linear sRGB.
///
/// The values are what Mitsuba 3 (RGB mode) makes of its measured spectra [Mitsuba3]: a projection of the
/// index, not of the reflectance, on the colour matching functions. Good for comparing renderers; use
/// spectra where the colour of the metal matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// Chemical symbol, lower case.
    pub symbol: &'static str,
    /// n of red, green, blue.
    pub n: [f64; 3],
    /// k of red, green, blue.
    pub k: [f64; 3],
}

/// The metals known by name.
pub const METALS: [Metal; 4] = [
    Metal {
        symbol: "cu",
        n: [0.201005, 0.923750, 1.102215],
        k: [3.913262, 2.453045, 2.142090],
    },
    Metal {
        symbol: "au",
        n: [0.143036, 0.375307, 1.442045],
        k: [3.982997, 2.385556, 1.603359],
    },
    Metal {
        symbol: "ag",
        n: [0.155276, 0.116728, 0.138388],
        k: [4.828354, 3.122222, 2.146901],
    },
    Metal {
        symbol: "al",
        n: [1.657501, 0.880405, 0.521244],
        k: [9.223811, 6.269502, 4.837005],
    },
];

#[cfg(test)]
mod tests {
    use super::{Fresnel, METALS};
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
    fn lanes_follow_the_scalar_form() {
        for metal in METALS {
            let f = Fresnel::from_index(metal.n, metal.k);
            let c: [f32; LANES] = std::array::from_fn(|k| k as f32 / (LANES - 1) as f32);
            let sin2 = c.map(|c| (1.0 - c) * (1.0 + c));
            for channel in 0..3 {
                let lanes = f.eval_lanes(channel, &c, &sin2);
                for k in 0..LANES {
                    let exact = f.eval(f64::from(c[k]))[channel];
                    // a dozen f32 operations on numbers of order |n + ik|^2
                    assert!(
                        (f64::from(lanes[k]) - exact).abs() < 3e-6,
                        "{} {exact}",
                        lanes[k]
                    );
                }
            }
        }
    }
}
