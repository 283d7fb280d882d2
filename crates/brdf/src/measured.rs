//! Reflectance with as many channels as its file has, and how it becomes a [`Brdf`] of `N` channels.

use crate::contract::{Brdf, Symmetry};
use glam::DVec3;
use spectrum::{Basis, RgbSpace};

/// How an evaluated value came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Exactly a measured sample.
    Measured,
    /// Between measured samples.
    Interpolated,
    /// No measurement reaches here; a named policy filled it.
    Filled,
}

/// Reflectance in the channels it was measured in.
pub trait Measured: Send + Sync {
    /// What the channels mean; its length is the channel count.
    fn basis(&self) -> &Basis;

    /// f_r(wi, wo) in 1/sr into `out` (one entry a channel), and where it came from.
    ///
    /// Zero and [`Status::Filled`] where either direction is at or below the horizon.
    ///
    /// # Panics
    /// If `out` is not as long as the basis.
    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status;

    /// The symmetries that hold exactly.
    fn symmetry(&self) -> Symmetry;

    /// Bytes of the tables it holds.
    fn table_bytes(&self) -> usize {
        0
    }
}

/// A [`Measured`] seen through a linear map to `N` channels (colour conversion, resampling to bins).
#[derive(Clone, Debug)]
pub struct Projected<M, const N: usize> {
    measured: M,
    /// Row per native channel: what one unit of it adds to each of the `N` channels.
    matrix: Vec<[f64; N]>,
}

impl<M: Measured, const N: usize> Projected<M, N> {
    /// `matrix` has one row a native channel. `None` if the row count differs from the basis.
    pub fn new(measured: M, matrix: Vec<[f64; N]>) -> Option<Self> {
        (measured.basis().len() == matrix.len()).then_some(Self { measured, matrix })
    }
}

/// Native channels the projection holds on the stack before it allocates.
const INLINE: usize = 80;

impl<M: Measured, const N: usize> Brdf<N> for Projected<M, N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let (mut inline, mut heap) = ([0.0; INLINE], Vec::new());
        let native = match inline.get_mut(..self.matrix.len()) {
            Some(slice) => slice,
            None => {
                heap.resize(self.matrix.len(), 0.0);
                &mut heap[..]
            }
        };
        self.measured.eval_native(wi, wo, native);
        let mut out = [0.0; N];
        for (value, row) in native.iter().zip(&self.matrix) {
            for (o, m) in out.iter_mut().zip(row) {
                *o += value * m;
            }
        }
        out
    }

    fn symmetry(&self) -> Symmetry {
        self.measured.symmetry()
    }

    fn table_bytes(&self) -> usize {
        self.measured.table_bytes()
    }
}

/// A [`Brdf`] of linear sRGB channels read as if it had been measured: models beside measurements.
#[derive(Clone, Debug)]
pub struct Computed<B> {
    brdf: B,
    basis: Basis,
}

impl<B: Brdf<3>> Computed<B> {
    /// Every value counts as [`Status::Measured`].
    pub fn new(brdf: B) -> Self {
        let basis = Basis::Rgb(RgbSpace::srgb());
        Self { brdf, basis }
    }
}

impl<B: Brdf<3>> Measured for Computed<B> {
    fn basis(&self) -> &Basis {
        &self.basis
    }
    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        out.copy_from_slice(&self.brdf.eval(wi, wo));
        if wi.z > 0.0 && wo.z > 0.0 {
            Status::Measured
        } else {
            Status::Filled
        }
    }
    fn symmetry(&self) -> Symmetry {
        self.brdf.symmetry()
    }
    fn table_bytes(&self) -> usize {
        self.brdf.table_bytes()
    }
}

impl<T: Measured + ?Sized> Measured for std::sync::Arc<T> {
    fn basis(&self) -> &Basis {
        (**self).basis()
    }
    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        (**self).eval_native(wi, wo, out)
    }
    fn symmetry(&self) -> Symmetry {
        (**self).symmetry()
    }
    fn table_bytes(&self) -> usize {
        (**self).table_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Channel k reads k + 1.
    struct Ramp(Basis);

    impl Measured for Ramp {
        fn basis(&self) -> &Basis {
            &self.0
        }
        fn eval_native(&self, _: DVec3, _: DVec3, out: &mut [f64]) -> Status {
            for (value, n) in out.iter_mut().zip(1_u32..) {
                *value = f64::from(n);
            }
            Status::Measured
        }
        fn symmetry(&self) -> Symmetry {
            Symmetry::FULL
        }
    }

    fn bands(n: u32) -> Basis {
        Basis::Bands((0..n).map(|k| 400.0 + f64::from(k)).collect())
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "sums of small whole numbers are exact")]
    fn projection_is_the_matrix_product_on_stack_and_heap() {
        for n in [3_u32, 80, 81, 200] {
            let matrix = (0..n).map(|k| [1.0, f64::from(k % 2)]).collect();
            let projected = Projected::<_, 2>::new(Ramp(bands(n)), matrix).unwrap();
            let sum = f64::from(n * (n + 1) / 2);
            let odd = f64::from((n / 2) * (n / 2 + 1));
            assert_eq!(projected.eval(DVec3::Z, DVec3::Z), [sum, odd], "{n} bands");
        }
    }

    #[test]
    fn a_matrix_of_another_size_is_refused() {
        assert!(
            Projected::<_, 2>::new(Ramp(bands(4)), vec![[0.0; 2]; 3]).is_none(),
            "3 rows for 4 bands"
        );
    }
}
