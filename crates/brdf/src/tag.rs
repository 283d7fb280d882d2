//! What tells the lanes of a packet apart beside their directions.

use crate::contract::Brdf;
use crate::lanes::{LANES, Lanes3};
use std::fmt::Debug;

/// Says of one lane what its channels are.
///
/// `()` where all lanes have the same channels, which costs nothing; [`Rotation`] where each path carries wavelengths
/// of its own.
pub trait Tag: Copy + Debug + Send + Sync + 'static {
    /// Any value; what unused lanes hold.
    const FIRST: Self;

    /// Number `k` of `all`. Where all tags are one, nothing is read and no index checked.
    ///
    /// # Panics
    /// If tags differ and there are not as many.
    #[inline(always)]
    #[must_use]
    fn of(all: &[Self], k: usize) -> Self {
        all[k]
    }

    /// Makes number `k` of `all` this one, likewise.
    ///
    /// # Panics
    /// As [`Self::of`].
    #[inline(always)]
    fn put(self, all: &mut [Self], k: usize) {
        all[k] = self;
    }
}

impl Tag for () {
    const FIRST: Self = ();

    #[inline(always)]
    fn of(_: &[Self], _: usize) -> Self {}

    #[inline(always)]
    fn put(self, _: &mut [Self], _: usize) {}
}

/// Wavelengths a path carries in hero sampling.
pub const HERO: usize = 8;

/// How many sets of [`HERO`] wavelengths there are to choose from.
pub const ROTATIONS: usize = 64;

/// Which of the [`ROTATIONS`] sets of wavelengths a path carries [Wilkie2014].
///
/// The visible range is divided into `HERO * ROTATIONS` narrow bins of equal probability; rotation r carries the bins
/// r, r + ROTATIONS, r + 2 ROTATIONS, ..: a stratified choice, the same in every lane that carries r, so that whatever
/// depends on wavelength is a table of [`RotatedTable`] form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rotation(u8);

/// A value for each wavelength of each rotation.
pub type RotatedTable = [[f32; HERO]; ROTATIONS];

/// Values of the [`HERO`] times [`ROTATIONS`] narrow bins, sorted by rotation: rotation r carries the bins r, r + ROTATIONS, ..;
/// 0 where there are fewer.
#[must_use]
pub fn rotated(values: &[f64]) -> RotatedTable {
    std::array::from_fn(|r| {
        std::array::from_fn(|c| values.get(c * ROTATIONS + r).map_or(0.0, |v| *v as f32))
    })
}

impl Rotation {
    /// Rotation number `index` modulo [`ROTATIONS`].
    #[inline(always)]
    #[must_use]
    pub const fn new(index: u32) -> Self {
        Self((index % ROTATIONS as u32) as u8)
    }

    /// Its number, below [`ROTATIONS`].
    #[inline(always)]
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize % ROTATIONS
    }
}

impl Tag for Rotation {
    const FIRST: Self = Self(0);
}

/// [`Brdf::eval_lanes`] for lanes with tags: what a [`Paired`](crate::Paired) material asks.
///
/// Every [`Brdf`] is one for lanes without tags.
pub trait TaggedBrdf<const N: usize, T: Tag>: Send + Sync {
    /// f_r in 1/sr per channel, lane by lane; as [`Brdf::eval_lanes`].
    fn eval_tagged(&self, wi: &Lanes3, wo: &Lanes3, tags: &[T; LANES]) -> [[f32; LANES]; N];

    /// Bytes of the tables it holds.
    fn table_bytes(&self) -> usize {
        0
    }
}

impl<const N: usize, B: Brdf<N>> TaggedBrdf<N, ()> for B {
    #[inline(always)]
    fn eval_tagged(&self, wi: &Lanes3, wo: &Lanes3, _: &[(); LANES]) -> [[f32; LANES]; N] {
        self.eval_lanes(wi, wo)
    }

    fn table_bytes(&self) -> usize {
        Brdf::table_bytes(self)
    }
}

impl<const N: usize, B: TaggedBrdf<N, Rotation> + ?Sized> TaggedBrdf<N, Rotation>
    for std::sync::Arc<B>
{
    #[inline(always)]
    fn eval_tagged(&self, wi: &Lanes3, wo: &Lanes3, tags: &[Rotation; LANES]) -> [[f32; LANES]; N] {
        (**self).eval_tagged(wi, wo, tags)
    }

    fn table_bytes(&self) -> usize {
        (**self).table_bytes()
    }
}
