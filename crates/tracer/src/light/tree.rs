//! The light tree: a choice among many lights by about what each sends to a point [ContyEstevez2018].
//!
//! Each child of a node bounds the lights below it by a ball of radius r, a cone of normals and their intensity I. From
//! p, at distance d under the angle theta to the cone's axis, with theta_o the cone's and theta_u the ball's half
//! angle as seen from p, they are taken to shine with
//!
//! ```text
//!     I cos(max(0, theta - theta_o - theta_u)) / max(d^2, r^2 / 3)
//! ```
//!
//! for lobes of a cosine, which end 90 degrees off their normal. A walk from the root chooses a child in proportion to
//! this, with what is left of one number after each step, so that stratified numbers stay so. The receiver's normal and
//! reflectance are not asked: the probability depends on p alone, and paths that meet a light by chance know p.
//!
//! Nodes have [`LANES`] children, not two: up to that many lights are told apart by themselves, and coarse bounds, which
//! do not see the weak light next to p within a large group, decide less often.

use super::bound::{Bound, BoundLanes};
use crate::math::F;
use brdf::LANES;
use glam::Vec3;

/// The children of a node: what bounds them, and where they go on.
#[derive(Clone, Debug)]
struct Node {
    bounds: BoundLanes,
    /// Nodes, or [`LEAF`] and a light.
    next: [u32; LANES],
    /// Children in use.
    count: usize,
}

/// Marks leaves.
const LEAF: u32 = 1 << 31;

/// Bits of a trail a step takes.
const STEP: u32 = LANES.ilog2();

/// From this depth on groups are halved by number, so that no light is deeper than a trail has room for.
const HALVE_FROM: u32 = 8;

/// Parts along the longest side between which a split is sought.
const BUCKETS: usize = 12;

/// The part of the choice that is even: a light next to a point within a large group is not starved.
const EVEN: f32 = 0.1;

/// A tree over lights of finite extent.
#[derive(Clone, Debug)]
pub(crate) struct LightTree {
    nodes: Vec<Node>,
    /// The lights in here.
    members: Vec<u32>,
    /// By light: its way from the root, first step in the lowest bits, and its depth. `None` for lights that are not in here.
    trails: Vec<Option<(u64, u32)>>,
    /// The instruction set of this machine.
    arch: pulp::Arch,
}

/// A light on its way into the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Member {
    pub(crate) light: u32,
    pub(crate) bound: Bound,
}

impl LightTree {
    /// Over `members`, of `lights` in all. `None` if there are none.
    pub(crate) fn new(mut members: Vec<Member>, lights: usize) -> Option<Self> {
        if members.is_empty() {
            return None;
        }
        let mut tree = Self {
            nodes: Vec::new(),
            members: members.iter().map(|m| m.light).collect(),
            trails: vec![None; lights],
            arch: brdf::arch(),
        };
        tree.node(&mut members, 0, 0);
        Some(tree)
    }

    /// Makes the node above `members`, reached by `trail`; its index.
    fn node(&mut self, members: &mut [Member], trail: u64, depth: u32) -> u32 {
        let at = self.nodes.len();
        let mut groups = groups(members, depth);
        let bounds: Vec<Bound> = groups.iter().map(|g| bound(g)).collect();
        self.nodes.push(Node {
            bounds: BoundLanes::new(&bounds),
            next: [LEAF; LANES],
            count: groups.len(),
        });
        for (k, group) in groups.iter_mut().enumerate() {
            let trail = trail | ((k as u64) << (STEP * depth));
            self.nodes[at].next[k] = if let [one] = &**group {
                self.trails[one.light as usize] = Some((trail, depth + 1));
                LEAF | one.light
            } else {
                self.node(group, trail, depth + 1)
            };
        }
        at as u32
    }

    /// A light for the point `p` by a number in [0, 1), and its probability.
    #[inline]
    pub(crate) fn sample(&self, p: Vec3, u: f32) -> (usize, f32) {
        if u < EVEN {
            let i = (u / EVEN * self.members.len() as f32) as usize;
            let light = self.members[i.min(self.members.len() - 1)] as usize;
            return (light, self.probability(light, p));
        }
        let (light, probability) = self.arch.dispatch(
            #[inline(always)]
            || self.walk(p, (u - EVEN) / (1.0 - EVEN)),
        );
        (light, self.mixed(probability))
    }

    /// A light and the probability to come to it.
    #[inline(always)]
    fn walk(&self, p: Vec3, mut u: f32) -> (usize, f32) {
        let (mut at, mut probability) = (0, 1.0);
        loop {
            let node = &self.nodes[at];
            let importances = node.importances(p);
            let (k, rest) = choose(&importances, u);
            probability *= importances[k] / total(&importances);
            let next = node.next[k];
            if next & LEAF != 0 {
                return ((next & !LEAF) as usize, probability);
            }
            (at, u) = (next as usize, rest);
        }
    }

    /// Probability of `light` at `p`: bit for bit that of [`Self::sample`]. 0 for lights that are not in the tree.
    #[inline]
    pub(crate) fn probability(&self, light: usize, p: Vec3) -> f32 {
        self.trails[light].map_or(0.0, |trail| {
            let follow = self.arch.dispatch(
                #[inline(always)]
                || self.follow(p, trail),
            );
            self.mixed(follow)
        })
    }

    /// The probability to come to the end of a trail.
    #[inline(always)]
    fn follow(&self, p: Vec3, (mut trail, depth): (u64, u32)) -> f32 {
        let (mut at, mut probability) = (0, 1.0);
        for _ in 0..depth {
            let node = &self.nodes[at];
            let k = trail as usize % LANES;
            let importances = node.importances(p);
            probability *= importances[k] / total(&importances);
            at = (node.next[k] & !LEAF) as usize;
            trail >>= STEP;
        }
        probability
    }

    #[inline(always)]
    fn mixed(&self, probability: f32) -> f32 {
        EVEN / self.members.len() as f32 + (1.0 - EVEN) * probability
    }
}

impl Node {
    /// Where no child shines it does not matter which is taken.
    #[inline(always)]
    fn importances(&self, p: Vec3) -> F {
        let mut importances = self.bounds.importances(p);
        if total(&importances) <= 0.0 {
            for k in 0..LANES {
                importances[k] = if k < self.count { 1.0 } else { 0.0 };
            }
        }
        importances
    }
}

/// The sum, in halves, as registers add.
#[inline(always)]
fn total(importances: &F) -> f32 {
    let mut sums = *importances;
    let mut half = LANES / 2;
    while half > 0 {
        for k in 0..half {
            sums[k] += sums[k + half];
        }
        half /= 2;
    }
    sums[0]
}

/// A child by a number in [0, 1), and what is left of the number.
#[inline(always)]
fn choose(importances: &F, u: f32) -> (usize, f32) {
    let at = u * total(importances);
    let (mut chosen, mut below, mut sum) = (0, 0.0, 0.0);
    for k in 0..LANES {
        // the last of those whose part begins at or before `at`
        if importances[k] > 0.0 && sum <= at {
            (chosen, below) = (k, sum);
        }
        sum += importances[k];
    }
    let rest = (at - below) / importances[chosen];
    (chosen, rest.clamp(0.0, 1.0 - f32::EPSILON / 2.0))
}

fn bound(members: &[Member]) -> Bound {
    Bound::of(members.iter().map(|m| &m.bound))
}

/// Splits members into at most [`LANES`] groups, always the one that costs most.
fn groups(members: &mut [Member], depth: u32) -> Vec<&mut [Member]> {
    let mut groups = vec![members];
    while groups.len() < LANES {
        let halve = depth >= HALVE_FROM;
        let size = |g: &[Member]| if halve { 0.0 } else { bound(g).cost() };
        let largest = (groups.iter().enumerate())
            .filter(|(_, g)| g.len() > 1)
            .map(|(i, g)| (i, size(g), g.len()))
            .max_by(|a, b| a.1.total_cmp(&b.1).then(a.2.cmp(&b.2)));
        let Some((i, ..)) = largest else { break };
        let group = groups.swap_remove(i);
        let middle = partition(group, halve);
        let (left, right) = group.split_at_mut(middle);
        groups.extend([left, right]);
    }
    groups
}

/// Reorders two or more members into two groups; how many are in the first.
fn partition(members: &mut [Member], halve: bool) -> usize {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for m in &*members {
        low = low.min(m.bound.center());
        high = high.max(m.bound.center());
    }
    let size = high - low;
    let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
    if size[axis] > 0.0 && !halve {
        let bucket = |m: &Member| {
            let part = (m.bound.center()[axis] - low[axis]) / size[axis];
            ((part * BUCKETS as f32) as usize).min(BUCKETS - 1)
        };
        let end = best_end(members, bucket);
        let mut first = 0;
        for i in 0..members.len() {
            if bucket(&members[i]) < end {
                members.swap(first, i);
                first += 1;
            }
        }
        if first > 0 && first < members.len() {
            return first;
        }
    }
    members.sort_by(|a, b| a.bound.center()[axis].total_cmp(&b.bound.center()[axis]));
    members.len() / 2
}

/// The first bucket of the right group, where intensity, extent and spread of normals of both groups are least.
fn best_end(members: &[Member], bucket: impl Fn(&Member) -> usize) -> usize {
    let mut buckets = [Bound::NONE; BUCKETS];
    for m in members {
        let all = &mut buckets[bucket(m)];
        *all = all.and(&m.bound);
    }
    let cost = |end: usize| {
        let (left, right) = buckets.split_at(end);
        [left, right].map(|side| Bound::of(side.iter()).cost())
    };
    let costs = (1..BUCKETS).map(|end| (end, cost(end).iter().sum::<f32>()));
    costs
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(1, |(end, _)| end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::mix;

    fn number(i: u64) -> f32 {
        (mix(i) >> 40) as f32 / 16_777_216.0
    }

    /// `n` spheres and rectangles, in clusters, of intensities over four decades.
    fn members(n: u64) -> Vec<Member> {
        let vector = |i: u64| Vec3::from_array([0, 1, 2].map(|k| 2.0 * number(i + k) - 1.0));
        (0..n)
            .map(|i| {
                let at = vector(100 * (i % 7)) * 10.0 + vector(1000 + 16 * i);
                let intensity = 10.0_f32.powf(4.0 * number(1003 + 16 * i));
                let radius = 0.1 * number(1004 + 16 * i);
                let bound = if i % 2 == 0 {
                    Bound::all_around([at - radius, at + radius], intensity)
                } else {
                    let normal = vector(1005 + 16 * i).normalize_or(Vec3::X);
                    Bound::facing([at - radius, at + radius], normal, intensity)
                };
                Member {
                    light: i as u32,
                    bound,
                }
            })
            .collect()
    }

    #[test]
    fn probabilities_are_those_of_the_samples_and_sum_to_one() {
        for n in [1, 2, 3, 17, 1000] {
            let tree = LightTree::new(members(n), n as usize).expect("members");
            for j in 0..20 {
                let p = Vec3::from_array([0, 1, 2].map(|k| 30.0 * number(7 + 3 * j + k) - 15.0));
                let sum: f64 = (0..n as usize)
                    .map(|i| f64::from(tree.probability(i, p)))
                    .sum();
                assert!((sum - 1.0).abs() < 1e-5, "{n} lights: {sum}");
                for i in 0..200 {
                    let u = number(99 + i);
                    let (light, probability) = tree.sample(p, u);
                    let again = tree.probability(light, p);
                    assert_eq!(
                        probability.to_bits(),
                        again.to_bits(),
                        "{n} lights, {light} by {u}"
                    );
                    let even = EVEN / n as f32;
                    assert!(
                        u < EVEN || probability > even,
                        "{n} lights: {light} by {u} is dark"
                    );
                }
            }
        }
    }

    /// Even numbers fall on each light as often as its probability says: the walk is an inversion.
    #[test]
    fn lights_are_chosen_as_often_as_their_probability_says() {
        let tree = LightTree::new(members(60), 60).expect("members");
        let p = Vec3::new(1.0, -2.0, 3.0);
        let n = 1_u32 << 16;
        let mut seen = [0_u32; 60];
        for i in 0..n {
            seen[tree.sample(p, (i as f32 + 0.5) / n as f32).0] += 1;
        }
        for (light, seen) in seen.into_iter().enumerate() {
            let expected = f64::from(tree.probability(light, p)) * f64::from(n);
            // a light takes two intervals of u, whose ends the steps round
            assert!(
                (f64::from(seen) - expected).abs() < 5.0,
                "light {light}: {seen} for {expected}"
            );
        }
    }

    /// No light that shines on a point is out of the walk's reach, and many that can't are.
    #[test]
    fn only_lights_that_look_away_are_left_to_the_even_part() {
        let all = members(200);
        let tree = LightTree::new(all.clone(), 200).expect("members");
        let mut never = 0;
        for j in 0..50 {
            let p = Vec3::from_array([0, 1, 2].map(|k| 30.0 * number(7 + 3 * j + k) - 15.0));
            for m in &all {
                let shines = m.bound.importance(p) > 0.0;
                let chosen = tree.probability(m.light as usize, p) > EVEN / 200.0;
                assert!(chosen || !shines, "light {} from {p}", m.light);
                never += usize::from(!chosen);
            }
        }
        assert!(never > 1000, "half of the rectangles look away: {never}");
    }

    #[test]
    fn lights_in_one_place_make_no_endless_tree() {
        let one = members(1)[0];
        let all: Vec<_> = (0..5000).map(|light| Member { light, ..one }).collect();
        let tree = LightTree::new(all, 5000).expect("members");
        let p = tree.probability(4711, Vec3::ZERO);
        assert!((p * 5000.0 - 1.0).abs() < 0.3, "{p}");
    }
}
