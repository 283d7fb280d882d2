//! Koenderink and van Doorn's basis for reciprocal isotropic reflectance [Koenderink1998]: Zernike functions on
//! both hemispheres.

use brdf::{Brdf, DirectionSample, DirectionSampler, Symmetry};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, PI};

use crate::half::{MIN_COS, above};
use crate::lobe;
use crate::registry::{Built, Laws, ModelInfo, Parameter, Role, Values, numbered};

/// Highest order that fits the numbering of the registry: 55 functions.
const MAX_ORDER: usize = 8;

/// One function of the basis: c (R_n^m(ri) R_l^m(ro) + R_l^m(ri) R_n^m(ro)) cos(m dphi).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Term {
    m: usize,
    /// Where the radial polynomials of (n, m) and (l, m) stand.
    radial: [usize; 2],
    scale: f64,
}

/// R_n^m(r)/r^m, a polynomial in r^2.
#[derive(Clone, Debug, PartialEq)]
struct Radial {
    n: usize,
    m: usize,
    /// Coefficients of r^0, r^2, ...
    coefficients: Vec<f64>,
}

/// The functions up to an order, orthonormal over the product of the two hemispheres.
///
/// With r = sqrt 2 sin(theta/2), which maps solid angle to area on the unit disc, and R_n^m Zernike's radial
/// polynomials, every function is reciprocal, isotropic and bilateral. They come by rising n, then l <= n, then
/// m <= l (n, l, m of equal parity), so that a lower order is a prefix of a higher one; order 2 has 5, order 8 has 55.
/// The first is the constant 1/(2 pi).
#[derive(Clone, Debug, PartialEq)]
pub struct KoenderinkBasis {
    order: usize,
    radials: Vec<Radial>,
    terms: Vec<Term>,
    indices: Vec<[usize; 3]>,
}

impl KoenderinkBasis {
    /// All functions with n <= `order`.
    #[must_use]
    pub fn new(order: usize) -> Self {
        let mut basis = Self {
            order,
            radials: Vec::new(),
            terms: Vec::new(),
            indices: Vec::new(),
        };
        for n in 0..=order {
            for m in (n % 2..=n).step_by(2) {
                basis.radials.push(Radial::new(n, m));
            }
        }
        for n in 0..=order {
            for l in (n % 2..=n).step_by(2) {
                for m in (n % 2..=l).step_by(2) {
                    basis.push(n, l, m);
                }
            }
        }
        basis
    }

    fn push(&mut self, n: usize, l: usize, m: usize) {
        let find = |n: usize| self.radials.iter().position(|r| (r.n, r.m) == (n, m));
        let (Some(first), Some(second)) = (find(n), find(l)) else {
            return;
        };
        // the integral of R_n^m(r)^2 over solid angle is 2 pi/(2 (n + 1)) a turn; cos^2(m dphi) halves it
        let turns = if m == 0 { 4.0 * PI * PI } else { 2.0 * PI * PI };
        let norm2 = ((n + 1) * (l + 1)) as f64 / turns;
        // the two products are orthogonal for n != l, the same for n = l
        let scale = if n == l {
            0.5 * norm2.sqrt()
        } else {
            (0.5 * norm2).sqrt()
        };
        self.terms.push(Term {
            m,
            radial: [first, second],
            scale,
        });
        self.indices.push([n, l, m]);
    }

    /// Number of functions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Never: there is the constant.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// n, l and m of each function.
    #[must_use]
    pub fn indices(&self) -> &[[usize; 3]] {
        &self.indices
    }

    /// All functions at a pair of directions, into `out`; 0 where either is below the horizon.
    ///
    /// # Panics
    /// If `out` is shorter than [`Self::len`].
    pub fn eval(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) {
        let out = &mut out[..self.terms.len()];
        if !above(wi, wo) {
            out.fill(0.0);
            return;
        }
        let (i, o) = (Disc::new(wi), Disc::new(wo));
        // (ri ro)^m cos(m dphi) = Re (zi conj zo)^m, without an azimuth
        let t = [i.x * o.x + i.y * o.y, i.y * o.x - i.x * o.y];
        let mut turned = [1.0, 0.0];
        let mut cosines = vec![1.0; self.order + 1];
        for cosine in &mut cosines[1..] {
            turned = [
                turned[0] * t[0] - turned[1] * t[1],
                turned[0] * t[1] + turned[1] * t[0],
            ];
            *cosine = turned[0];
        }
        let radial = |d: &Disc| -> Vec<f64> { self.radials.iter().map(|r| r.at(d.r2)).collect() };
        let (ri, ro) = (radial(&i), radial(&o));
        for (out, term) in out.iter_mut().zip(&self.terms) {
            let [n, l] = term.radial;
            *out = term.scale * cosines[term.m] * (ri[n] * ro[l] + ri[l] * ro[n]);
        }
    }
}

/// A direction on the disc of equal areas, r = sqrt 2 sin(theta/2).
struct Disc {
    x: f64,
    y: f64,
    r2: f64,
}

impl Disc {
    fn new(w: DVec3) -> Self {
        let scale = 1.0 / (1.0 + w.z).sqrt();
        let (x, y) = (w.x * scale, w.y * scale);
        Self {
            x,
            y,
            r2: x * x + y * y,
        }
    }
}

impl Radial {
    /// Zernike's: sum over k of (-1)^k (n-k)! / (k! ((n+m)/2-k)! ((n-m)/2-k)!) r^(n-2k) [BornWolf1999, 9.2.1].
    fn new(n: usize, m: usize) -> Self {
        let (p, q) = ((n + m) / 2, (n - m) / 2);
        let factorial = |k: usize| (1..=k).map(|i| i as f64).product::<f64>();
        let coefficients = (0..=q).rev().map(|k| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            sign * factorial(n - k) / (factorial(k) * factorial(p - k) * factorial(q - k))
        });
        Self {
            n,
            m,
            coefficients: coefficients.collect(),
        }
    }

    fn at(&self, r2: f64) -> f64 {
        let horner = |sum: f64, c: &f64| sum * r2 + c;
        self.coefficients.iter().rev().fold(0.0, horner)
    }
}

/// f = kd/pi + sum_k a_k b_k, b_k the functions of [`KoenderinkBasis`] after the constant. May be negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Koenderink<const N: usize> {
    basis: KoenderinkBasis,
    /// Of all functions, the constant included.
    coefficients: Vec<[f64; N]>,
}

pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "koenderink",
    title: "reciprocal isotropic basis of Zernike functions, orders up to 8",
    formula: "kd/pi + sum_k a_k c_k (R_n^m(ri) R_l^m(ro) + R_l^m(ri) R_n^m(ro)) cos(m dphi), r = sqrt 2 sin(t/2), (n,l,m) = 111, 200, 220, 222, 311, 331, 333, ...",
    citation: "Koenderink1998",
    parameters: &[
        Parameter {
            repeats: true,
            range: (-10.0, 10.0),
            role: Role::Weight,
            ..Parameter::albedo("a", "coefficient of the function after the constant", 0.0)
        },
        Parameter::base("kd", "albedo of the constant", 0.5),
    ],
    laws: Laws {
        conserves_energy: false,
        non_negative: false,
        ..Laws::KEPT
    },
    examples: &[
        "kd=0.9/0.5/0.2,a=0.3,a2=-0.1,a3=0.2,a4=0.05",
        "kd=0.2,a=1.5,a4=1",
        "kd=0.5,a10=0.1,a24=-0.2,a54=0.1",
    ],
};

pub(crate) fn build<const N: usize>(values: &Values) -> Built<N> {
    let given = (1..)
        .take_while(|k| values.is_given(&numbered("a", *k)))
        .count();
    let order = (0..=MAX_ORDER)
        .find(|order| KoenderinkBasis::new(*order).len() > given)
        .unwrap_or(MAX_ORDER);
    // 1/pi over the constant function, 1/(2 pi)
    let constant = values.channels::<N>("kd").map(|kd| 2.0 * kd);
    let rest = (1..=given).map(|k| values.channels(&numbered("a", k)));
    Built::new(Koenderink::new(
        KoenderinkBasis::new(order),
        std::iter::once(constant).chain(rest).collect(),
    ))
}

impl<const N: usize> Koenderink<N> {
    /// The sum of the functions of `basis` times `coefficients`; missing ones are 0, superfluous ones are ignored.
    #[must_use]
    pub fn new(basis: KoenderinkBasis, mut coefficients: Vec<[f64; N]>) -> Self {
        coefficients.resize(basis.len(), [0.0; N]);
        Self {
            basis,
            coefficients,
        }
    }
}

impl<const N: usize> Brdf<N> for Koenderink<N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let mut functions = vec![0.0; self.basis.len()];
        self.basis.eval(wi, wo, &mut functions);
        let mut f = [0.0; N];
        for (value, a) in functions.iter().zip(&self.coefficients) {
            for c in 0..N {
                f[c] += a[c] * value;
            }
        }
        f
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
}

impl<const N: usize> DirectionSampler for Koenderink<N> {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let wi = lobe::cosine(u);
        let pdf = lobe::cosine_pdf(wi);
        (wo.z > MIN_COS && wi.z > MIN_COS).then_some(DirectionSample { wi, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if above(wi, wo) { wi.z * FRAC_1_PI } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::KoenderinkBasis;
    use glam::DVec3;
    use testkit::assert_close;
    use testkit::integrate::hemisphere;

    #[test]
    fn counts_of_the_orders_that_curet_ships() {
        assert_eq!(
            [0, 1, 2, 8].map(|n| KoenderinkBasis::new(n).len()),
            [1, 2, 5, 55]
        );
        let (low, high) = (KoenderinkBasis::new(2), KoenderinkBasis::new(8));
        assert_eq!(low.indices(), &high.indices()[..5]);
        assert_eq!(
            low.indices(),
            [[0, 0, 0], [1, 1, 1], [2, 0, 0], [2, 2, 0], [2, 2, 2]]
        );
    }

    /// The integral of b_j b_k over both hemispheres is 1 for j = k and else 0. The functions are polynomials in
    /// cos(theta), sines of azimuth and sin(theta)/sqrt(1 + cos) to powers that are even in the product, so that
    /// quadrature in both is exact; the azimuth of one direction may be fixed.
    #[test]
    fn orthonormal_over_both_hemispheres() {
        let basis = KoenderinkBasis::new(4);
        let n = basis.len();
        for j in 0..n {
            for k in 0..=j {
                let outer = hemisphere(
                    |o: [f64; 3]| {
                        // the azimuth of `o` alone changes nothing: its nodes are the same
                        let wo = DVec3::new((1.0 - o[2] * o[2]).sqrt(), 0.0, o[2]);
                        hemisphere(
                            |i: [f64; 3]| {
                                let mut b = vec![0.0; n];
                                basis.eval(DVec3::from_array(i), wo, &mut b);
                                b[j] * b[k]
                            },
                            5,
                        )
                    },
                    5,
                );
                let expected = f64::from(u8::from(j == k));
                assert_close(outer, expected, 1e-12, &format!("{:?}", (j, k)));
            }
        }
    }
}
