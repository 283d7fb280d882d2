//! Cells that follow a density: a grid whose crowded cells are halved.

use crate::domain::{Domain, Rect};
use crate::integrate::grid;

/// Cells of the grid every partition starts from, along either axis of the chart.
const START: [usize; 2] = [4, 8];
/// A cell is halved while it holds more than this fraction of the pilot.
const CROWDED: f64 = 1.0 / 256.0;
/// Halvings at most: a lobe of 1e-7 of the chart's width along both axes.
const MAX_DEPTH: usize = 46;
/// Points that show where in a cell the density lies.
const TELLING: usize = 8;

/// A node of the tree below one grid cell.
enum Node {
    Split {
        axis: usize,
        at: f64,
        children: [usize; 2],
    },
    Leaf(usize),
}

/// A partition of the chart, with a count per cell.
pub(super) struct Cells {
    chart: Rect,
    nodes: Vec<Node>,
    roots: Vec<usize>,
    rects: Vec<Rect>,
    counts: Vec<usize>,
}

impl Cells {
    /// The partition for a density like that of `pilot` (chart coordinates).
    pub(super) fn build(domain: Domain, pilot: Vec<[f64; 2]>) -> Self {
        let chart = domain.chart();
        let crowd = ((pilot.len() as f64 * CROWDED) as usize).max(8);
        let mut cells = Self {
            chart,
            nodes: Vec::new(),
            roots: Vec::new(),
            rects: Vec::new(),
            counts: Vec::new(),
        };
        let mut members = vec![Vec::new(); START[0] * START[1]];
        for p in pilot {
            members[cells.root(p)].push(p);
        }
        for (rect, points) in grid(chart, START).zip(members) {
            let root = cells.split(rect, points, crowd, 0);
            cells.roots.push(root);
        }
        cells.counts = vec![0; cells.rects.len()];
        cells
    }

    fn split(&mut self, rect: Rect, points: Vec<[f64; 2]>, crowd: usize, depth: usize) -> usize {
        let narrow = narrow_axis(&rect, &points);
        if depth == MAX_DEPTH || narrow.is_none() && points.len() <= crowd {
            self.rects.push(rect);
            self.nodes.push(Node::Leaf(self.rects.len() - 1));
            return self.nodes.len() - 1;
        }
        let axis = narrow.unwrap_or(depth % 2);
        let [low, high] = rect.halves(axis);
        let at = high.min[axis];
        let (below, above) = points.into_iter().partition(|p| p[axis] < at);
        let children = [
            self.split(low, below, crowd, depth + 1),
            self.split(high, above, crowd, depth + 1),
        ];
        self.nodes.push(Node::Split { axis, at, children });
        self.nodes.len() - 1
    }

    /// Which grid cell a point lies in; points off the chart by rounding go to the nearest.
    fn root(&self, p: [f64; 2]) -> usize {
        let size = self.chart.size();
        let at = |axis: usize| {
            let t = (p[axis] - self.chart.min[axis]) / size[axis];
            // `as` saturates: NaN and negatives go to 0
            ((t * START[axis] as f64) as usize).min(START[axis] - 1)
        };
        at(0) * START[1] + at(1)
    }

    /// Counts one sample.
    pub(super) fn add(&mut self, p: [f64; 2]) {
        let mut node = self.roots[self.root(p)];
        loop {
            match self.nodes[node] {
                Node::Leaf(cell) => {
                    self.counts[cell] += 1;
                    return;
                }
                Node::Split { axis, at, children } => {
                    node = children[usize::from(p[axis] >= at)];
                }
            }
        }
    }

    pub(super) fn rects(&self) -> &[Rect] {
        &self.rects
    }

    pub(super) fn counts(&self) -> &[usize] {
        &self.counts
    }
}

/// The axis along which `points` fill less than a quarter of `rect`, if one does: halving it hugs a lobe that
/// quadrature over the whole cell would overlook.
fn narrow_axis(rect: &Rect, points: &[[f64; 2]]) -> Option<usize> {
    let size = rect.size();
    let share = |axis: usize| {
        let all = points.iter().map(|p| p[axis]);
        let low = all.clone().fold(f64::INFINITY, f64::min);
        (all.fold(f64::NEG_INFINITY, f64::max) - low) / size[axis]
    };
    let axis = usize::from(share(1) < share(0));
    (points.len() >= TELLING && share(axis) < 0.25).then_some(axis)
}
