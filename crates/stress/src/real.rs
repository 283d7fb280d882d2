//! Numbers of 160 bits, in which the references are written as textbooks print them.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

/// Bits of the significand: three times those of f64, so that a difference of nearly equal f64 directions (1e-32 after
/// squaring) still has more digits than the value it is compared with.
const BITS: usize = 160;

/// A number of [`BITS`] bits whose exponent neither over- nor underflows; functions are rounded correctly.
#[derive(Clone, Debug)]
pub(crate) struct Real(FBig<HalfEven, 2>);

/// Below this exp is zero: far under the smallest f64, and range reduction stays in the machine's integers.
const LEAST_EXPONENT: f64 = -1e6;

static PI: LazyLock<Real> = LazyLock::new(|| Real::new(1.0).atan2(&Real::new(1.0)) * 4.0);

impl Real {
    /// Exactly `x`; zero for what is not finite.
    pub(crate) fn new(x: f64) -> Self {
        let exact = FBig::try_from(x).unwrap_or(FBig::ZERO);
        Self(exact.with_precision(BITS).value())
    }

    pub(crate) fn pi() -> Self {
        PI.clone()
    }

    /// The nearest f64.
    pub(crate) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.0 == FBig::<HalfEven, 2>::ZERO
    }

    pub(crate) fn is_positive(&self) -> bool {
        self.0 > FBig::<HalfEven, 2>::ZERO
    }

    pub(crate) fn sqr(&self) -> Self {
        self * self
    }

    /// Square root; zero for what is negative.
    pub(crate) fn sqrt(&self) -> Self {
        if self.is_positive() {
            Self(self.0.clone().sqrt())
        } else {
            Self::new(0.0)
        }
    }

    pub(crate) fn exp(&self) -> Self {
        if *self < LEAST_EXPONENT {
            Self::new(0.0)
        } else if self.is_zero() {
            Self::new(1.0)
        } else {
            Self(self.0.exp())
        }
    }

    /// Natural logarithm of a positive number.
    pub(crate) fn ln(&self) -> Self {
        Self(self.0.ln())
    }

    /// self^n for self >= 0; 0^0 is 1.
    pub(crate) fn pow(&self, n: f64) -> Self {
        if n == 0.0 {
            Self::new(1.0)
        } else if self.is_zero() {
            Self::new(0.0)
        } else {
            (self.ln() * n).exp()
        }
    }

    /// 1 - erf of a number >= 0, to 1e-30 absolute: erf x = 2/sqrt(pi) e^(-x^2) sum 2^k x^(2k+1)/(2k+1)!!
    /// [Abramowitz1964, 7.1.6], whose terms have one sign; 0 from 8.5 on, where it is 3e-33.
    pub(crate) fn erfc(&self) -> Self {
        if *self > 8.5 {
            return Self::new(0.0);
        }
        let twice = self.sqr() * 2.0;
        let (mut term, mut sum, mut odd) = (self.clone(), self.clone(), 1.0);
        while term.to_f64() > 1e-44 * sum.to_f64() {
            odd += 2.0;
            term = term * &twice / odd;
            sum = sum + &term;
        }
        1.0 - 2.0 / Self::pi().sqrt() * (-self.sqr()).exp() * sum
    }

    pub(crate) fn sin(&self) -> Self {
        Self(self.0.sin())
    }

    pub(crate) fn cos(&self) -> Self {
        Self(self.0.cos())
    }

    pub(crate) fn atan2(&self, x: &Self) -> Self {
        if self.is_zero() && *x >= 0.0 {
            Self::new(0.0)
        } else {
            Self(self.0.atan2(&x.0))
        }
    }

    pub(crate) fn abs(&self) -> Self {
        if self.is_positive() {
            self.clone()
        } else {
            -self
        }
    }

    pub(crate) fn max(&self, other: &Self) -> Self {
        if self.0 < other.0 {
            other.clone()
        } else {
            self.clone()
        }
    }

    pub(crate) fn min(&self, other: &Self) -> Self {
        if self.0 < other.0 {
            self.clone()
        } else {
            other.clone()
        }
    }
}

impl PartialEq<f64> for Real {
    fn eq(&self, other: &f64) -> bool {
        self.0 == Self::new(*other).0
    }
}

impl PartialOrd<f64> for Real {
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        self.0.partial_cmp(&Self::new(*other).0)
    }
}

impl PartialEq for Real {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl PartialOrd for Real {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real(-self.0.clone())
    }
}

impl Neg for Real {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// An operator for owned and borrowed numbers and f64.
macro_rules! operator {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait<&Real> for &Real {
            type Output = Real;
            fn $method(self, other: &Real) -> Real {
                Real((&self.0).$method(&other.0))
            }
        }
        impl $trait<Real> for Real {
            type Output = Real;
            fn $method(self, other: Real) -> Real {
                (&self).$method(&other)
            }
        }
        impl $trait<&Real> for Real {
            type Output = Real;
            fn $method(self, other: &Real) -> Real {
                (&self).$method(other)
            }
        }
        impl $trait<Real> for &Real {
            type Output = Real;
            fn $method(self, other: Real) -> Real {
                self.$method(&other)
            }
        }
        impl $trait<f64> for Real {
            type Output = Real;
            fn $method(self, other: f64) -> Real {
                (&self).$method(&Real::new(other))
            }
        }
        impl $trait<f64> for &Real {
            type Output = Real;
            fn $method(self, other: f64) -> Real {
                self.$method(&Real::new(other))
            }
        }
        impl $trait<Real> for f64 {
            type Output = Real;
            fn $method(self, other: Real) -> Real {
                (&Real::new(self)).$method(&other)
            }
        }
        impl $trait<&Real> for f64 {
            type Output = Real;
            fn $method(self, other: &Real) -> Real {
                (&Real::new(self)).$method(other)
            }
        }
    )*};
}

operator!(Add add, Sub sub, Mul mul, Div div);

#[cfg(test)]
mod tests {
    use super::Real;
    use std::f64::consts::{LN_2, PI};

    #[test]
    fn functions_round_to_those_of_f64() {
        let close = |a: Real, b: f64| assert!((a.to_f64() - b).abs() <= 2e-16 * b.abs(), "{b}");
        close(Real::pi(), PI);
        close(Real::new(2.0).ln(), LN_2);
        close(Real::new(0.5).exp(), 0.5_f64.exp());
        close(Real::new(0.3).pow(7.5), 0.3_f64.powf(7.5));
        close(Real::new(1.0).atan2(&Real::new(0.0)), 0.5 * PI);
        // as Python's math.erfc prints them
        close(Real::new(0.5).erfc(), 0.479_500_122_186_953_5);
        close(Real::new(2.0).erfc(), 0.004_677_734_981_047_265_6);
        close(Real::new(6.0).erfc(), 2.151_973_671_249_891_6e-17);
        close(Real::new(1.0).sin(), 1.0_f64.sin());
        close(Real::new(1.0).cos(), 1.0_f64.cos());
    }

    #[test]
    fn digits_survive_where_f64_has_none() {
        // 1 - (1 - 1e-30)
        let tiny = 1.0 - (1.0 - Real::new(1e-30));
        assert!((tiny.to_f64() / 1e-30 - 1.0).abs() < 1e-12, "{tiny:?}");
        let square = 1.0 - Real::new(1e-9).cos().sqr();
        assert!(
            (square.sqrt().to_f64() / 1e-9 - 1.0).abs() < 1e-15,
            "{square:?}"
        );
    }

    #[test]
    fn nothing_over_or_underflows_on_the_way() {
        let huge = Real::new(1e300).pow(3.0) * Real::new(1e-300).pow(3.0);
        assert!((huge.to_f64() - 1.0).abs() < 1e-15, "{huge:?}");
        assert!(Real::new(-1e30).exp().is_zero());
        assert!(Real::new(0.0).pow(0.0) == 1.0 && Real::new(0.0).pow(2.0).is_zero());
    }
}
