//! How paths carry colour: fixed channels, or wavelengths that differ from path to path.
//!
//! A [`Mode`] is chosen by type, so that what a scene does not use is not in its program: with [`Fixed`] there are no
//! tags, no look-ups by wavelength and nothing to develop.

use crate::math::F;
use brdf::{HERO, LANES, ROTATIONS, RotatedTable, Rotation, Tag};
use spectrum::Samples;
use std::fmt::Debug;
use std::sync::Arc;

/// What a light sends out (radiance, intensity or irradiance), in the channels of paths with tags `T`.
pub trait Emission<const N: usize, T: Tag>: Clone + Debug + Send + Sync {
    /// What a path with this tag receives.
    fn at(&self, tag: T) -> [f32; N];

    /// What [`LANES`] paths receive, channel by channel.
    fn at_lanes(&self, tags: &[T; LANES]) -> [F; N];

    /// Mean over the channels, not below zero: what choices go by.
    fn brightness(&self) -> f64;

    /// Whether it sends out nothing at all.
    fn is_zero(&self) -> bool;

    /// Whether no channel is NaN or infinite.
    fn is_finite(&self) -> bool;
}

/// How the `N` channels of a path are to be understood.
pub trait Mode<const N: usize>: Debug + Send + Sync {
    /// What paths tell materials and lights.
    type Tag: Tag;
    /// What lights send out.
    type Emission: Emission<N, Self::Tag>;
    /// Whether a path draws its tag from the points, in a dimension of its own.
    const DRAWS: bool;

    /// The tag of a path that drew `u` in [0, 1).
    fn tag(&self, u: f32) -> Self::Tag;
}

/// How the light of a path becomes the `M` channels of a film.
pub trait Develop<const N: usize, const M: usize>: Mode<N> {
    /// Film channels of what a path with this tag has collected; linear.
    fn develop(&self, tag: Self::Tag, light: &[f32; N]) -> [f32; M];
}

/// The same channels on every path, and on the film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fixed;

impl<const N: usize> Emission<N, ()> for Samples<N> {
    #[inline(always)]
    fn at(&self, (): ()) -> [f32; N] {
        self.0
    }

    #[inline(always)]
    fn at_lanes(&self, _: &[(); LANES]) -> [F; N] {
        self.0.map(|value| [value; LANES])
    }

    fn brightness(&self) -> f64 {
        let sum: f64 = self.0.iter().map(|&x| f64::from(x)).sum();
        (sum / N.max(1) as f64).max(0.0)
    }

    fn is_zero(&self) -> bool {
        Self::is_zero(*self)
    }

    fn is_finite(&self) -> bool {
        Self::is_finite(*self)
    }
}

impl<const N: usize> Mode<N> for Fixed {
    type Tag = ();
    type Emission = Samples<N>;
    const DRAWS: bool = false;

    #[inline(always)]
    fn tag(&self, _: f32) {}
}

impl<const N: usize> Develop<N, N> for Fixed {
    #[inline(always)]
    fn develop(&self, (): (), light: &[f32; N]) -> [f32; N] {
        *light
    }
}

/// [`HERO`] wavelengths a path, one of [`ROTATIONS`] sets each [Wilkie2014], added up to three channels on the film.
///
/// All wavelengths of a path go the same way, chosen with a density that does not depend on wavelength; the weights of
/// multiple importance sampling over rotations are then all 1/[`HERO`], and are part of `weights`.
#[derive(Clone, Debug)]
pub struct Hero {
    weights: Arc<[[[f32; 3]; HERO]; ROTATIONS]>,
}

impl Hero {
    /// `weights[r][c]` is what one unit of wavelength `c` of rotation `r` adds to the film, given that the rotation was
    /// chosen with probability 1/[`ROTATIONS`].
    #[must_use]
    pub fn new(weights: Arc<[[[f32; 3]; HERO]; ROTATIONS]>) -> Self {
        Self { weights }
    }
}

/// What a light sends out at each wavelength of each rotation.
#[derive(Clone, Debug)]
pub enum HeroEmission {
    /// Given by wavelength.
    Table(Arc<RotatedTable>),
    /// Given by how much of three spectra: pixels of an environment share these.
    Mixture {
        /// Weights of the spectra, not negative.
        parts: [f32; 3],
        /// The spectra.
        basis: Arc<[RotatedTable; 3]>,
    },
}

impl HeroEmission {
    fn values(&self) -> impl Iterator<Item = f32> + '_ {
        (0..ROTATIONS as u32).flat_map(|r| self.at(Rotation::new(r)))
    }
}

impl Emission<HERO, Rotation> for HeroEmission {
    #[inline(always)]
    fn at(&self, tag: Rotation) -> [f32; HERO] {
        match self {
            Self::Table(table) => table[tag.index()],
            Self::Mixture { parts, basis } => std::array::from_fn(|c| {
                let of = |b: usize| parts[b] * basis[b][tag.index()][c];
                of(0) + of(1) + of(2)
            }),
        }
    }

    #[inline(always)]
    fn at_lanes(&self, tags: &[Rotation; LANES]) -> [F; HERO] {
        let mut out = [[0.0; LANES]; HERO];
        for k in 0..LANES {
            let row = self.at(tags[k]);
            for c in 0..HERO {
                out[c][k] = row[c];
            }
        }
        out
    }

    fn brightness(&self) -> f64 {
        let mean = |t: &RotatedTable| {
            let sum: f64 = t.as_flattened().iter().map(|&x| f64::from(x)).sum();
            sum / (HERO * ROTATIONS) as f64
        };
        let mean = match self {
            Self::Table(table) => mean(table),
            Self::Mixture { parts, basis } => {
                (0..3).map(|b| f64::from(parts[b]) * mean(&basis[b])).sum()
            }
        };
        mean.max(0.0)
    }

    fn is_zero(&self) -> bool {
        self.values().all(|v| v == 0.0)
    }

    fn is_finite(&self) -> bool {
        match self {
            Self::Table(_) => self.values().all(f32::is_finite),
            Self::Mixture { parts, .. } => parts.iter().all(|p| p.is_finite()),
        }
    }
}

impl Mode<HERO> for Hero {
    type Tag = Rotation;
    type Emission = HeroEmission;
    const DRAWS: bool = true;

    #[inline(always)]
    fn tag(&self, u: f32) -> Rotation {
        Rotation::new((u * ROTATIONS as f32) as u32)
    }
}

impl Develop<HERO, 3> for Hero {
    #[inline(always)]
    fn develop(&self, tag: Rotation, light: &[f32; HERO]) -> [f32; 3] {
        let mut out = [0.0; 3];
        for (light, weights) in light.iter().zip(&self.weights[tag.index()]) {
            for c in 0..3 {
                out[c] += light * weights[c];
            }
        }
        out
    }
}
