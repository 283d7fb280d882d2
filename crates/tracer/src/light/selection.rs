//! Which light a vertex asks.

use super::{Light, LightLanes};
use crate::math::F;
use crate::mode::Emission;
use brdf::{LANES, Lanes3, Tag};

/// The lights of a scene. `lights[..asked]` take part in the choice, in proportion to their power mixed with an even
/// share, so that a weak light near by is not starved.
#[derive(Clone, Debug)]
pub(crate) struct Lights<E> {
    pub(crate) lights: Vec<Light<E>>,
    /// Probabilities up to and with each light.
    cdf: Vec<f32>,
    /// The only light with a probability, if there is just one.
    only: Option<usize>,
}

/// The part of the choice that ignores power.
const EVEN: f64 = 0.5;

impl<E> Lights<E> {
    /// From lights and their powers; a power of `None` keeps a light out of the choice.
    pub(crate) fn new(mut lights: Vec<Light<E>>, powers: &[Option<f64>]) -> Self {
        let total: f64 = powers.iter().flatten().sum();
        let count = powers.iter().flatten().count() as f64;
        let share = |power: &Option<f64>| match power {
            Some(power) if total > 0.0 => EVEN / count + (1.0 - EVEN) * power / total,
            Some(_) => 1.0 / count,
            None => 0.0,
        };
        let shares: Vec<f64> = powers.iter().map(share).collect();
        let mut sum = 0.0;
        let cdf = shares
            .iter()
            .map(|p| {
                sum += p;
                sum as f32
            })
            .collect();
        for (light, share) in lights.iter_mut().zip(&shares) {
            light.probability = *share as f32;
        }
        let mut asked = (0..lights.len()).filter(|&i| shares[i] > 0.0);
        let only = asked.next().filter(|_| asked.next().is_none());
        Self { lights, cdf, only }
    }

    /// Whether any light can be asked.
    pub(crate) fn any(&self) -> bool {
        self.cdf.last().is_some_and(|&p| p > 0.0)
    }

    /// Whether the choice takes a random number.
    pub(crate) fn several(&self) -> bool {
        self.any() && self.only.is_none()
    }

    /// Directions toward one light a lane; `choice` is read when there are several.
    #[inline(always)]
    pub(crate) fn sample<const N: usize, T: Tag>(
        &self,
        p: &Lanes3,
        (choice, u): (&F, &[F; 2]),
        tags: &[T; LANES],
        out: &mut LightLanes<N>,
    ) where
        E: Emission<N, T>,
    {
        match self.only {
            Some(i) => self.lights[i].sample(p, u, tags, out),
            None => self.sample_several(p, (choice, u), tags, out),
        }
    }

    /// Asks each light that any lane chose, and keeps the lanes that chose it.
    #[inline(never)]
    fn sample_several<const N: usize, T: Tag>(
        &self,
        p: &Lanes3,
        (choice, u): (&F, &[F; 2]),
        tags: &[T; LANES],
        out: &mut LightLanes<N>,
    ) where
        E: Emission<N, T>,
    {
        let last = self.cdf.len().saturating_sub(1);
        let chosen: [usize; LANES] =
            std::array::from_fn(|k| self.cdf.partition_point(|&c| c <= choice[k]).min(last));
        let mut one = LightLanes::EMPTY;
        for k in 0..LANES {
            // the first lane of each light fills all of its lanes
            if chosen[..k].contains(&chosen[k]) {
                continue;
            }
            let Some(light) = self.lights.get(chosen[k]) else {
                continue;
            };
            light.sample(p, u, tags, &mut one);
            for j in k..LANES {
                if chosen[j] == chosen[k] {
                    out.wi.set(j, one.wi.get(j));
                    out.distance[j] = one.distance[j];
                    out.pdf[j] = one.pdf[j];
                    out.shared[j] = one.shared[j];
                    out.prim[j] = one.prim[j];
                    for c in 0..N {
                        out.radiance[c][j] = one.radiance[c][j];
                    }
                }
            }
        }
    }
}
