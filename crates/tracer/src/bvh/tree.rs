//! The eight-wide tree: obvhs' binary tree, opened up.

use super::block::WIDTH;
use crate::path::NONE;
use crate::shape::Triangle;
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec3A};
use obvhs::bvh2::Bvh2;

/// Children of a node: one register of AVX.
pub(super) const ARITY: usize = 8;

/// Set in a child that is a leaf; the rest is the index of its block.
pub(super) const LEAF: u32 = 1 << 31;

/// Subtrees of more triangles than this may be opened to fill a node.
const SPLIT: usize = 8;

/// Levels of nodes beyond which a subtree is cut into even halves, so that a stack of fixed size serves any tree.
const DEEP: usize = 16;

/// Levels there may be in all: even halves of 2^32 triangles take 11 more.
pub(super) const MAX_LEVELS: usize = DEEP + 12;

/// A node of the wide tree.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Axis, low or high, child. A child that is not there has the low plane at +inf and the high one at -inf.
    pub(super) planes: [[[f32; ARITY]; 2]; 3],
    /// Index of a node, or [`LEAF`] and the index of a block.
    pub(super) child: [u32; ARITY],
    /// Makes a node four lines of the cache.
    spare: [u32; 8],
}

impl Node {
    const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; ARITY], [f32::NEG_INFINITY; ARITY]]; 3],
        child: [LEAF; ARITY],
        spare: [0; 8],
    };

    /// Low and high corner of the box around all children.
    pub(super) fn bounds(&self) -> [Vec3; 2] {
        let low = self
            .planes
            .each_ref()
            .map(|[low, _]| low.iter().copied().fold(f32::INFINITY, f32::min));
        let high = self
            .planes
            .each_ref()
            .map(|[_, high]| high.iter().copied().fold(f32::NEG_INFINITY, f32::max));
        [low.into(), high.into()]
    }
}

/// What a child of a wide node stands for while the tree is built.
enum Part {
    /// A node of the binary tree.
    Binary(usize),
    /// Triangles `from..to` of the list of a subtree that was too deep.
    Range(usize, usize),
}

/// Nodes, the root first, and for each leaf the triangles in its block, [`NONE`] in lanes to spare.
pub(super) struct Wide {
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<[u32; WIDTH]>,
}

/// Opens the binary tree.
pub(super) struct Opener<'a> {
    binary: &'a Bvh2,
    triangles: &'a [Triangle],
    /// Triangles below each node of the binary tree.
    counts: Vec<u32>,
    wide: Wide,
    /// Triangles of subtrees that were too deep.
    cut: Vec<u32>,
}

/// A node to be filled in.
struct Task {
    node: usize,
    level: usize,
    part: Part,
}

impl<'a> Opener<'a> {
    /// `triangles` are those that `binary` was built over, of which there is at least one.
    pub(super) fn open(binary: &'a Bvh2, triangles: &'a [Triangle]) -> Wide {
        let mut opener = Self {
            binary,
            triangles,
            counts: counts(binary),
            wide: Wide {
                nodes: vec![Node::EMPTY],
                leaves: Vec::new(),
            },
            cut: Vec::new(),
        };
        let mut tasks = vec![Task {
            node: 0,
            level: 0,
            part: Part::Binary(0),
        }];
        while let Some(task) = tasks.pop() {
            opener.fill(&task, &mut tasks);
        }
        opener.wide
    }

    /// Gives a node its children, and those that are nodes a task each.
    fn fill(&mut self, task: &Task, tasks: &mut Vec<Task>) {
        let parts = match task.part {
            Part::Binary(root) if task.level < DEEP => self.opened(root),
            Part::Binary(root) => {
                let from = self.cut.len();
                let triangles = self.below(root);
                self.cut.extend(triangles);
                eighths(from, self.cut.len())
            }
            Part::Range(from, to) => eighths(from, to),
        };
        for (slot, part) in parts.into_iter().enumerate() {
            let [low, high] = self.bounds(&part);
            let node = &mut self.wide.nodes[task.node];
            for axis in 0..3 {
                node.planes[axis][0][slot] = low[axis];
                node.planes[axis][1][slot] = high[axis];
            }
            if self.count(&part) <= WIDTH {
                self.wide.nodes[task.node].child[slot] = LEAF | self.wide.leaves.len() as u32;
                let leaf = self.leaf(&part);
                self.wide.leaves.push(leaf);
            } else {
                let child = self.wide.nodes.len();
                self.wide.nodes[task.node].child[slot] = child as u32;
                self.wide.nodes.push(Node::EMPTY);
                tasks.push(Task {
                    node: child,
                    level: task.level + 1,
                    part,
                });
            }
        }
    }

    /// Up to [`ARITY`] descendants of a binary node: the largest is opened until there is room for no more.
    fn opened(&self, root: usize) -> Vec<Part> {
        let nodes = &self.binary.nodes;
        let mut open = vec![root];
        while open.len() < ARITY {
            let largest = (0..open.len())
                .filter(|&i| {
                    nodes[open[i]].prim_count == 0 && self.counts[open[i]] as usize > SPLIT
                })
                .max_by(|&a, &b| {
                    let area = |i: usize| nodes[open[i]].aabb.half_area();
                    area(a).total_cmp(&area(b))
                });
            let Some(largest) = largest else { break };
            let first = nodes[open[largest]].first_index as usize;
            open[largest] = first;
            open.push(first + 1);
        }
        open.into_iter().map(Part::Binary).collect()
    }

    fn bounds(&self, part: &Part) -> [Vec3A; 2] {
        match *part {
            Part::Binary(node) => {
                let aabb = &self.binary.nodes[node].aabb;
                [aabb.min, aabb.max]
            }
            Part::Range(from, to) => {
                let none = [Vec3A::INFINITY, Vec3A::NEG_INFINITY];
                let boxes = self.cut[from..to]
                    .iter()
                    .map(|&i| bounds(&self.triangles[i as usize]));
                boxes.fold(none, |a, b| [a[0].min(b[0]), a[1].max(b[1])])
            }
        }
    }

    fn count(&self, part: &Part) -> usize {
        match *part {
            Part::Binary(node) => self.counts[node] as usize,
            Part::Range(from, to) => to - from,
        }
    }

    fn leaf(&self, part: &Part) -> [u32; WIDTH] {
        let members = match *part {
            Part::Binary(node) => &self.below(node),
            Part::Range(from, to) => &self.cut[from..to],
        };
        let mut leaf = [NONE; WIDTH];
        leaf[..members.len()].copy_from_slice(members);
        leaf
    }

    /// All triangles below a binary node.
    fn below(&self, root: usize) -> Vec<u32> {
        let mut found = Vec::new();
        let mut todo = vec![root];
        while let Some(i) = todo.pop() {
            let (node, first) = (
                &self.binary.nodes[i],
                self.binary.nodes[i].first_index as usize,
            );
            if node.prim_count == 0 {
                todo.extend([first, first + 1]);
            } else {
                found.extend(
                    &self.binary.primitive_indices[first..first + node.prim_count as usize],
                );
            }
        }
        found
    }
}

/// Low and high corner of a triangle's box.
fn bounds(triangle: &Triangle) -> [Vec3A; 2] {
    let [a, b, c] = triangle.corners.map(Vec3A::from);
    [a.min(b).min(c), a.max(b).max(c)]
}

/// Triangles below each node.
fn counts(binary: &Bvh2) -> Vec<u32> {
    let nodes = &binary.nodes;
    let mut counts = vec![0; nodes.len()];
    let mut todo = vec![(0, false)];
    while let Some((i, seen)) = todo.pop() {
        let first = nodes[i].first_index as usize;
        if nodes[i].prim_count > 0 {
            counts[i] = nodes[i].prim_count;
        } else if seen {
            counts[i] = counts[first] + counts[first + 1];
        } else {
            todo.extend([(i, true), (first, false), (first + 1, false)]);
        }
    }
    counts
}

/// Cuts a list into [`ARITY`] even parts, none of them empty.
fn eighths(from: usize, to: usize) -> Vec<Part> {
    let parts = ARITY.min(to - from);
    let at = |i: usize| from + (to - from) * i / parts;
    (0..parts).map(|i| Part::Range(at(i), at(i + 1))).collect()
}
