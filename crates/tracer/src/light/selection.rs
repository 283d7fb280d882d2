//! Which light a vertex asks.

use super::bound::Bound;
use super::tree::{LightTree, Member};
use super::{Emitter, Light, LightLanes};
use crate::math::F;
use crate::mode::Emission;
use brdf::{LANES, Lanes3, Tag};
use glam::Vec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// How a vertex chooses among lights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightSelection {
    /// By power for a few lights, by a tree from [`MANY`] on.
    #[default]
    Auto,
    /// In proportion to power, mixed with an even share.
    Power,
    /// By a tree over position, orientation and intensity.
    Tree,
}

/// Lights of finite extent from which [`LightSelection::Auto`] takes the tree (measured: docs/scenes.md).
pub const MANY: usize = 16;

/// The lights of a scene, and how one of them is chosen.
#[derive(Clone, Debug)]
pub(crate) struct Lights<E> {
    pub(crate) lights: Arc<[Light<E>]>,
    choice: Choice,
}

#[derive(Clone, Debug)]
enum Choice {
    /// No light can be asked.
    Nothing,
    /// One can.
    Only(usize),
    Shares(Shares),
    /// Far lights by their shares, of which the first belongs to the tree.
    Tree(Shares, LightTree),
}

/// Fixed probabilities.
#[derive(Clone, Debug)]
struct Shares {
    probabilities: Vec<f32>,
    /// Probabilities up to and with each; from the last that has one on, exactly 1.
    cdf: Vec<f32>,
}

/// The part of fixed probabilities that ignores power, so that a weak light near by is not starved.
const EVEN: f64 = 0.5;

impl Shares {
    /// From powers; `None` keeps one out of the choice.
    fn new(powers: &[Option<f64>]) -> Self {
        let total: f64 = powers.iter().flatten().sum();
        let count = powers.iter().flatten().count() as f64;
        let share = |power: &Option<f64>| match power {
            Some(power) if total > 0.0 => EVEN / count + (1.0 - EVEN) * power / total,
            Some(_) => 1.0 / count,
            None => 0.0,
        };
        Self::of(&powers.iter().map(share).collect::<Vec<_>>())
    }

    /// From probabilities that sum to 1, up to rounding.
    fn of(shares: &[f64]) -> Self {
        let mut sum = 0.0;
        let mut cdf: Vec<f32> = shares
            .iter()
            .map(|p| {
                sum += p;
                sum as f32
            })
            .collect();
        // a sum rounded below 1 would leave the numbers above it to whoever comes last, asked or not
        let last = shares.iter().rposition(|p| *p > 0.0).unwrap_or(0);
        cdf[last..].fill(1.0);
        Self {
            probabilities: shares.iter().map(|&p| p as f32).collect(),
            cdf,
        }
    }

    #[inline]
    fn sample(&self, u: f32) -> usize {
        self.cdf.partition_point(|&c| c <= u)
    }

    /// What is left of `u` after the first was chosen.
    #[inline]
    fn rest_of_first(&self, u: f32) -> f32 {
        // the largest number below 1
        (u / self.cdf[0]).min(1.0 - f32::EPSILON / 2.0)
    }
}

impl<E> Lights<E> {
    /// From lights and their powers; a power of `None` keeps a light out of the choice.
    pub(crate) fn new(
        lights: Arc<[Light<E>]>,
        powers: &[Option<f64>],
        selection: LightSelection,
    ) -> Self {
        let mut asked = (0..lights.len()).filter(|&i| powers[i].is_some());
        let choice = match (asked.next(), asked.next()) {
            (None, _) => Choice::Nothing,
            (Some(i), None) => Choice::Only(i),
            _ => several(&lights, powers, selection),
        };
        Self { lights, choice }
    }

    /// Whether any light can be asked.
    pub(crate) fn any(&self) -> bool {
        !matches!(self.choice, Choice::Nothing)
    }

    /// Whether the choice takes a random number.
    pub(crate) fn several(&self) -> bool {
        matches!(self.choice, Choice::Shares(_) | Choice::Tree(..))
    }

    /// Whether a tree makes the choice.
    pub(crate) fn by_tree(&self) -> bool {
        matches!(self.choice, Choice::Tree(..))
    }

    /// A light for the point `p` by a number in [0, 1), and its probability there.
    #[inline]
    pub(crate) fn choose(&self, p: Vec3, u: f32) -> (usize, f32) {
        match &self.choice {
            Choice::Nothing => (0, 0.0),
            Choice::Only(i) => (*i, 1.0),
            Choice::Shares(shares) => {
                let i = shares.sample(u);
                (i, shares.probabilities[i])
            }
            Choice::Tree(shares, tree) => match shares.sample(u) {
                0 => {
                    let (i, probability) = tree.sample(p, shares.rest_of_first(u));
                    (i, shares.probabilities[0] * probability)
                }
                i => (i - 1, shares.probabilities[i]),
            },
        }
    }

    /// The probability that [`Self::choose`] takes `light` at `p`.
    #[inline]
    pub(crate) fn probability(&self, light: usize, p: Vec3) -> f32 {
        match &self.choice {
            Choice::Nothing => 0.0,
            Choice::Only(i) => f32::from(u8::from(*i == light)),
            Choice::Shares(shares) => shares.probabilities[light],
            Choice::Tree(shares, tree) => {
                // lights in the tree have no share of their own
                shares.probabilities[0] * tree.probability(light, p)
                    + shares.probabilities[light + 1]
            }
        }
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
        match self.choice {
            Choice::Only(i) => self.lights[i].sample(p, u, tags, 0..LANES, out),
            _ => self.sample_several(p, (choice, u), tags, out),
        }
    }

    /// Asks each light for the lanes that chose it.
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
        let chosen: [(usize, f32); LANES] =
            std::array::from_fn(|k| self.choose(p.get(k), choice[k]));
        let mut one = LightLanes::EMPTY;
        for k in 0..LANES {
            let first = chosen[k].0;
            if chosen[..k].iter().any(|c| c.0 == first) {
                continue;
            }
            let Some(light) = self.lights.get(first) else {
                continue;
            };
            let lanes = chosen.iter().filter(|c| c.0 == first).count();
            if lanes < FEW {
                for j in (k..LANES).filter(|&j| chosen[j].0 == first) {
                    light.sample(p, u, tags, j..j + 1, out);
                }
            } else {
                light.sample(p, u, tags, 0..LANES, &mut one);
                for j in (k..LANES).filter(|&j| chosen[j].0 == first) {
                    out.copy(j, &one);
                }
            }
        }
        for k in 0..LANES {
            out.pdf[k] *= chosen[k].1;
        }
    }
}

/// Lanes of one light below which it is asked lane by lane.
const FEW: usize = 4;

/// The choice among two or more lights.
fn several<E>(lights: &[Light<E>], powers: &[Option<f64>], selection: LightSelection) -> Choice {
    let members: Vec<Member> = (lights.iter().zip(powers).enumerate())
        .filter_map(|(i, (light, power))| {
            Some(Member {
                light: i as u32,
                bound: bound(&light.emitter, (*power)?)?,
            })
        })
        .collect();
    let tree = match selection {
        LightSelection::Power => false,
        LightSelection::Tree => true,
        LightSelection::Auto => members.len() >= MANY,
    };
    if !tree {
        return Choice::Shares(Shares::new(powers));
    }
    // the tree first, then lights that are not in it
    let mut far = [&[Some(0.0)], powers].concat();
    for m in &members {
        let power = far[m.light as usize + 1].take();
        far[0] = Some(far[0].unwrap_or(0.0) + power.unwrap_or(0.0));
    }
    match LightTree::new(members, lights.len()) {
        Some(tree) => Choice::Tree(Shares::new(&far), tree),
        None => Choice::Shares(Shares::new(powers)),
    }
}

/// What bounds a light; `None` for what is infinitely far.
fn bound<E>(emitter: &Emitter<E>, power: f64) -> Option<Bound> {
    // of a lobe of a cosine, and of one all around
    let (ahead, around) = ((power / PI) as f32, (power / (4.0 * PI)) as f32);
    match emitter {
        Emitter::Rect(rect) => Some(Bound::facing(rect.bounds(), rect.z, ahead)),
        Emitter::Sphere(sphere) => {
            let r = Vec3::splat(sphere.radius);
            Some(Bound::all_around(
                [sphere.center - r, sphere.center + r],
                around,
            ))
        }
        Emitter::Triangles(light) => Some(light.bound(power)),
        Emitter::Point(p) => Some(Bound::all_around([*p; 2], around)),
        Emitter::Directional(_) | Emitter::Constant | Emitter::Image(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::Shares;

    #[test]
    fn what_is_kept_out_is_never_chosen() {
        let largest = 1.0 - f32::EPSILON / 2.0;
        for count in 2..400_u16 {
            let power = |i: u16| (i > 0 && i <= count).then(|| 1.0 / f64::from(i).sqrt());
            let powers: Vec<_> = (0..count + 2).map(power).collect();
            let shares = Shares::new(&powers);
            for u in [0.0, 0.5, largest] {
                let chosen = shares.sample(u);
                assert!(shares.probabilities[chosen] > 0.0, "{chosen} of {count}");
            }
        }
    }

    /// As the sums of very many shares may be.
    #[test]
    fn a_sum_rounded_below_one_leaves_nothing_to_what_is_kept_out() {
        let largest = 1.0 - f32::EPSILON / 2.0;
        for rounded in [1e-7, 1e-6] {
            let shares = Shares::of(&[0.0, 0.25, 0.75 - rounded, 0.0, 0.0]);
            assert_eq!([0.0, 0.25, largest].map(|u| shares.sample(u)), [1, 2, 2]);
        }
    }
}
