//! A stream of random numbers.

use glam::DVec2;
use rand_core::{Infallible, Rng as _, SeedableRng, TryRng};
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// PCG XSL RR 128/64 [ONeill2014]: the same numbers for a seed on every machine.
///
/// Implements `rand_core`'s traits, so it drives any distribution of that family, too.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rng(Pcg64);

impl Rng {
    /// The stream of `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed))
    }

    /// Stream number `k` of `seed`; different `k` give independent sequences (replicates, tiles, threads).
    #[must_use]
    pub fn stream(seed: u64, k: u64) -> Self {
        // PCG's own streams may be correlated, so state and increment are both hashed from both numbers.
        let mut bytes = [0; 32];
        for (j, word) in (1..).zip(bytes.chunks_exact_mut(8)) {
            let step = u64::wrapping_mul(0x9e37_79b9_7f4a_7c15, j);
            let mixed = mix64(mix64(seed.wrapping_add(step)).wrapping_add(k));
            word.copy_from_slice(&mixed.to_le_bytes());
        }
        Self(Pcg64::from_seed(bytes))
    }

    /// The next 64 uniform bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Uniform in [0, 1), a multiple of 2^-53.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (f64::EPSILON / 2.0)
    }

    /// Two independent numbers uniform in [0, 1).
    #[inline]
    pub fn uniform2(&mut self) -> DVec2 {
        let x = self.uniform();
        DVec2::new(x, self.uniform())
    }

    /// Standard normal, by Box and Muller [Box1958].
    #[inline]
    pub fn normal(&mut self) -> f64 {
        let u = self.uniform2();
        (-2.0 * (-u.x).ln_1p()).sqrt() * (TAU * u.y).cos()
    }

    /// Uniform in 0..n; 0 for n = 0. The bias of at most n / 2^64 is not removed.
    #[inline]
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.bits()) * n as u128) >> 64) as usize
    }
}

/// The finaliser of `SplitMix64` [Steele2014]: a bijection in which every bit depends on every other.
#[inline]
pub(crate) fn mix64(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl TryRng for Rng {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.0.try_next_u32()
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.0.try_next_u64()
    }

    fn try_fill_bytes(&mut self, out: &mut [u8]) -> Result<(), Infallible> {
        self.0.try_fill_bytes(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Welford;

    #[test]
    fn seeds_and_streams_are_reproducible_and_distinct() {
        assert_eq!(Rng::new(7).bits(), Rng::new(7).bits());
        assert_ne!(Rng::new(7).bits(), Rng::new(8).bits());
        assert_eq!(Rng::stream(7, 3), Rng::stream(7, 3));
        let mut first: Vec<u64> = (0..100).map(|k| Rng::stream(7, k).bits()).collect();
        first.sort_unstable();
        first.dedup();
        assert_eq!(first.len(), 100);
    }

    #[test]
    fn normal_has_its_moments() {
        let mut rng = Rng::new(1);
        let mut first = Welford::new();
        let mut fourth = Welford::new();
        for _ in 0..200_000 {
            let x = rng.normal();
            first.push(x);
            fourth.push(x.powi(4));
        }
        for (w, expected) in [(&first, 0.0), (&fourth, 3.0)] {
            let t = testkit::z_test(w.mean(), w.standard_error(), expected);
            assert!(t.p_value > testkit::sidak(0.01, 2), "{expected}: {t:?}");
        }
    }

    #[test]
    fn below_hits_every_value() {
        let mut rng = Rng::new(2);
        let mut hits = [0; 5];
        for _ in 0..1000 {
            hits[rng.below(5)] += 1;
        }
        assert!(hits.iter().all(|h| *h > 150), "{hits:?}");
        assert_eq!(rng.below(0), 0);
    }
}
