//! Rays through the eight-wide tree, one after the other, nearest child first.

use super::block::{Block, WIDTH};
use super::lanes::{Lanes8, Slab};
use super::tree::{ARITY, LEAF, MAX_LEVELS, Node};
use crate::shape::ShearedRay;
use glam::Vec3;

/// Room for what a ray leaves for later: at each level all children but one, and one more.
const STACK: usize = MAX_LEVELS * (ARITY - 1) + ARITY;

/// How far sideways of a ray the sheared corners of a triangle may be off, relative to the largest coordinate of a corner
/// from the origin: in half epsilons one for the subtraction of either coordinate, two for the slope, one for its
/// product and two for the last subtraction; one more for the origin moved by it. These are seven, eight, and two for
/// products of them. The widening of distances does not cover it where the ray hardly moves along an axis.
const SLACK: f32 = 5.0 * f32::EPSILON;

/// No scaled coordinate is larger.
const LARGEST: f32 = 2.0;

/// By how much boxes are widened for a ray whose origin has `size` as its largest coordinate.
#[inline(always)]
pub(super) fn slack(size: f32) -> f32 {
    SLACK * (size + LARGEST)
}

/// What is left for later: the entry distance's bits above, the child below. Distances are not negative, so that
/// their bits are in order.
pub(super) struct Stack {
    entries: [u64; STACK],
    len: usize,
}

impl Stack {
    pub(super) const fn new() -> Self {
        Self {
            entries: [0; STACK],
            len: 0,
        }
    }

    #[inline(always)]
    fn push(&mut self, entry: u64) {
        self.entries[self.len] = entry;
        self.len += 1;
    }

    /// Where the ray enters what was pushed last, and what that is.
    #[inline(always)]
    fn pop(&mut self) -> Option<(f32, u32)> {
        self.len = self.len.checked_sub(1)?;
        let entry = self.entries[self.len];
        Some((f32::from_bits((entry >> 32) as u32), entry as u32))
    }

    /// Leaves for later all but the first entered of the children `met`, of which there is at least one; that one.
    #[inline(always)]
    fn push_all_but_first(&mut self, node: &Node, near: &[f32; ARITY], met: u32) -> u32 {
        let entry = |k: usize| (u64::from(near[k].to_bits()) << 32) | u64::from(node.child[k]);
        let mut rest = bits(met);
        let mut first = entry(rest.next().unwrap_or(0));
        let base = self.len;
        for k in rest {
            let other = entry(k);
            let later = first.max(other);
            first = first.min(other);
            let mut at = self.len;
            self.push(later);
            while at > base && self.entries[at - 1] < later {
                self.entries[at] = self.entries[at - 1];
                at -= 1;
            }
            self.entries[at] = later;
        }
        first as u32
    }
}

/// A ray as nodes and leaves see it.
pub(super) struct TreeRay {
    leaf: ShearedRay,
    /// The origin for planes met first and last, moved along and against the ray: widens every box.
    o: [[f32; 3]; 2],
    inverse: [f32; 3],
    /// 0 where the low plane is met first, 1 where the high one is.
    near: [usize; 3],
}

impl TreeRay {
    #[inline(always)]
    pub(super) fn new(o: Vec3, d: Vec3) -> Self {
        let inverse = d.to_array().map(|x| 1.0 / x);
        let slack = slack(o.abs().max_element());
        let along = inverse.map(|x| slack.copysign(x));
        Self {
            o: [o + Vec3::from(along), o - Vec3::from(along)].map(|o| o.to_array()),
            leaf: ShearedRay::new(o, d),
            inverse,
            near: inverse.map(|x| usize::from(x.is_sign_negative())),
        }
    }

    /// Where the ray enters each child of a node, and a bit for each that it enters before `t_max`.
    #[inline(always)]
    fn enter(&self, lanes: Lanes8, node: &Node, t_max: f32) -> ([f32; ARITY], u32) {
        let slabs = [0, 1, 2].map(|axis| {
            let side = self.near[axis] & 1;
            Slab {
                near: &node.planes[axis][side],
                far: &node.planes[axis][1 - side],
                o: [self.o[0][axis], self.o[1][axis]],
                inverse: self.inverse[axis],
            }
        });
        lanes.enter(slabs, t_max)
    }
}

/// Nodes and the blocks of their leaves.
#[derive(Clone, Copy)]
pub(super) struct Tree<'a> {
    pub(super) nodes: &'a [Node],
    pub(super) blocks: &'a [Block],
    pub(super) lanes: Lanes8,
}

impl Tree<'_> {
    /// The nearest triangle before `t_max` other than `skip`, and its distance.
    #[inline(always)]
    pub(super) fn closest(
        self,
        ray: &TreeRay,
        mut t_max: f32,
        skip: u32,
        stack: &mut Stack,
    ) -> Option<(f32, u32)> {
        let mut best = None;
        let mut child = 0;
        stack.len = 0;
        loop {
            if child & LEAF == 0 {
                let node = &self.nodes[child as usize];
                let (near, met) = ray.enter(self.lanes, node, t_max);
                if met != 0 {
                    child = stack.push_all_but_first(node, &near, met);
                    continue;
                }
            } else {
                let block = child & !LEAF;
                let triangles = &self.blocks[block as usize];
                let hits = triangles.hits(self.lanes, &ray.leaf);
                for k in bits(self.lanes.below(&hits, t_max)) {
                    let id = block * WIDTH as u32 + k as u32;
                    let t = triangles.distance(k, hits[k], &ray.leaf);
                    if t < t_max && id != skip {
                        t_max = t;
                        best = Some((t_max, id));
                    }
                }
            }
            child = loop {
                let Some((entered, next)) = stack.pop() else {
                    return best;
                };
                if entered < t_max {
                    break next;
                }
            }
        }
    }

    /// Whether any triangle but those of `skip` lies before `t_max`.
    #[inline(always)]
    pub(super) fn blocked(
        self,
        ray: &TreeRay,
        t_max: f32,
        skip: [u32; 2],
        stack: &mut Stack,
    ) -> bool {
        let mut child = 0;
        stack.len = 0;
        loop {
            if child & LEAF == 0 {
                let node = &self.nodes[child as usize];
                let (_, met) = ray.enter(self.lanes, node, t_max);
                for k in bits(met) {
                    stack.push(u64::from(node.child[k]));
                }
            } else {
                let block = child & !LEAF;
                let triangles = &self.blocks[block as usize];
                let hits = triangles.hits(self.lanes, &ray.leaf);
                for k in bits(self.lanes.below(&hits, t_max)) {
                    let other = !skip.contains(&(block * WIDTH as u32 + k as u32));
                    if other && triangles.distance(k, hits[k], &ray.leaf) < t_max {
                        return true;
                    }
                }
            }
            match stack.pop() {
                Some((_, next)) => child = next,
                None => return false,
            }
        }
    }
}

/// The bits that are set, at most eight, from the lowest.
#[inline(always)]
fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let k = (set != 0).then_some(set.trailing_zeros() as usize & 7)?;
        set &= set - 1;
        Some(k)
    })
}
