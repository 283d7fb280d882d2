//! A spectrum as `N` numbers, in single precision: what rendering carries along a path.

use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, MulAssign, Sub};

/// `N` spectral (or colour) samples; what each of them means is told by a [`crate::Basis`].
///
/// Values may be negative: measured colour out of gamut is kept until the film.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Samples<const N: usize>(pub [f32; N]);

/// Linear RGB.
pub type Rgb = Samples<3>;

impl<const N: usize> Samples<N> {
    /// All samples zero.
    pub const ZERO: Self = Self([0.0; N]);
    /// All samples one: a perfect white reflectance.
    pub const ONE: Self = Self([1.0; N]);

    /// The same value in every sample.
    #[inline]
    #[must_use]
    pub const fn splat(value: f32) -> Self {
        Self([value; N])
    }

    /// From channels in double precision; `None` unless there are `N` of them.
    #[must_use]
    pub fn from_channels(channels: &[f64]) -> Option<Self> {
        let channels: &[f64; N] = channels.try_into().ok()?;
        Some(Self(channels.map(|v| v as f32)))
    }

    /// Applies `f` to every sample.
    #[inline]
    #[must_use]
    pub fn map(self, f: impl FnMut(f32) -> f32) -> Self {
        Self(self.0.map(f))
    }

    /// The largest sample.
    #[inline]
    #[must_use]
    pub fn max_element(self) -> f32 {
        self.0.iter().copied().fold(f32::NEG_INFINITY, f32::max)
    }

    /// The arithmetic mean of the samples.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "N is a handful of channels")]
    pub fn mean(self) -> f32 {
        self.0.iter().sum::<f32>() / N as f32
    }

    /// The sum of `weights[k] * self[k]`: luminance, when the weights are those of the basis.
    #[inline]
    #[must_use]
    pub fn dot(self, weights: &[f32; N]) -> f32 {
        self.0.iter().zip(weights).map(|(a, b)| a * b).sum()
    }

    /// True when every sample is exactly zero.
    #[inline]
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.0.iter().all(|v| v.abs() == 0.0)
    }

    /// True when no sample is NaN or infinite.
    #[inline]
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|v| v.is_finite())
    }
}

impl<const N: usize> Default for Samples<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> Index<usize> for Samples<N> {
    type Output = f32;
    #[inline]
    fn index(&self, k: usize) -> &f32 {
        &self.0[k]
    }
}

impl<const N: usize> IndexMut<usize> for Samples<N> {
    #[inline]
    fn index_mut(&mut self, k: usize) -> &mut f32 {
        &mut self.0[k]
    }
}

macro_rules! elementwise {
    ($trait:ident, $method:ident, $assign:tt) => {
        impl<const N: usize> $trait for Samples<N> {
            type Output = Self;
            #[inline]
            fn $method(mut self, other: Self) -> Self {
                for (a, b) in self.0.iter_mut().zip(other.0) {
                    *a $assign b;
                }
                self
            }
        }
    };
}
elementwise!(Add, add, +=);
elementwise!(Sub, sub, -=);
elementwise!(Mul, mul, *=);
elementwise!(Div, div, /=);

impl<const N: usize> Mul<f32> for Samples<N> {
    type Output = Self;
    #[inline]
    fn mul(self, k: f32) -> Self {
        self.map(|v| v * k)
    }
}

impl<const N: usize> AddAssign for Samples<N> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> MulAssign for Samples<N> {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const N: usize> MulAssign<f32> for Samples<N> {
    #[inline]
    fn mul_assign(&mut self, k: f32) {
        *self = *self * k;
    }
}
