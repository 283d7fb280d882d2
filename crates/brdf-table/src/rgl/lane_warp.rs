//! The warp in f32, laid out so that each lane reads few, neighbouring numbers.

use crate::rgl::warp::Warp;

/// The two incidences a known direction lies between; `t` is the weight of `upper`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Between {
    pub(crate) lower: usize,
    pub(crate) upper: usize,
    pub(crate) t: f32,
}

impl Between {
    #[inline(always)]
    pub(crate) fn mix(&self, lower: f32, upper: f32) -> f32 {
        lower + self.t * (upper - lower)
    }

    /// Entrywise blend of two neighbouring pairs.
    #[inline(always)]
    fn mix2(&self, lower: [[f32; 2]; 2], upper: [[f32; 2]; 2]) -> [[f32; 2]; 2] {
        std::array::from_fn(|i| std::array::from_fn(|j| self.mix(lower[i][j], upper[i][j])))
    }
}

/// A cell of a grid over the unit square and the place in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) col: usize,
    pub(crate) row: usize,
    pub(crate) x: f32,
    pub(crate) y: f32,
}

impl Spot {
    /// Where `u` lies among `nx` x `ny` nodes, at least two each way; NaN lies in the first cell.
    #[inline(always)]
    pub(crate) fn new(u: [f32; 2], nx: usize, ny: usize) -> Self {
        let (col, x) = split(u[0], nx);
        let (row, y) = split(u[1], ny);
        Self { col, row, x, y }
    }
}

#[inline(always)]
fn split(u: f32, n: usize) -> (usize, f32) {
    let position = u.clamp(0.0, 1.0) * (n - 1) as f32;
    let whole = (position as u32 as usize).min(n - 2);
    (whole, position - whole as f32)
}

/// The numbers of [`Warp`], symbol by symbol, in single precision.
#[derive(Clone, Debug)]
pub(crate) struct LaneWarp {
    nx: usize,
    ny: usize,
    /// Density at each node, and the mass along its row up to it.
    nodes: Vec<[f32; 2]>,
    /// Mass of each row, and the mass of all rows up to it.
    rows: Vec<[f32; 2]>,
}

/// What inversion and sampling share at one height of a row of cells.
struct Row {
    /// Masses of the lines below and above.
    ends: [f32; 2],
    /// Mass of the rows below.
    below: f32,
}

impl LaneWarp {
    pub(crate) fn new(warp: &Warp) -> Self {
        let (nx, ny) = warp.size();
        let nodes: Vec<_> = warp
            .nodes()
            .map(|(density, along)| [density, along as f32])
            .collect();
        let rows = (nodes.chunks_exact(nx).zip(warp.rows_below()))
            .map(|(row, below)| [row[nx - 1][1], *below as f32])
            .collect();
        Self {
            nx,
            ny,
            nodes,
            rows,
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.rows[..])
    }

    #[inline(always)]
    fn cells(&self) -> f32 {
        ((self.nx - 1) * (self.ny - 1)) as f32
    }

    /// Two neighbouring nodes of a row, blended.
    #[inline(always)]
    fn pair(&self, s: &Between, row: usize, col: usize) -> [[f32; 2]; 2] {
        let at = |slice: usize| {
            let start = (slice * self.ny + row) * self.nx + col;
            let nodes = &self.nodes[start..start + 2];
            [nodes[0], nodes[1]]
        };
        s.mix2(at(s.lower), at(s.upper))
    }

    #[inline(always)]
    fn row(&self, s: &Between, row: usize) -> Row {
        let at = |slice: usize| {
            let start = slice * self.ny + row;
            let rows = &self.rows[start..start + 2];
            [rows[0], rows[1]]
        };
        let [low, high] = s.mix2(at(s.lower), at(s.upper));
        Row {
            ends: [low[0], high[0]],
            below: low[1],
        }
    }

    #[inline(always)]
    fn below(&self, s: &Between, row: usize) -> f32 {
        let at = |slice: usize| self.rows[slice * self.ny + row][1];
        s.mix(at(s.lower), at(s.upper))
    }

    #[inline(always)]
    fn along(&self, s: &Between, row: usize, col: usize, y: f32) -> f32 {
        let at = |row: usize| {
            let node = |slice: usize| self.nodes[(slice * self.ny + row) * self.nx + col][1];
            s.mix(node(s.lower), node(s.upper))
        };
        let (low, high) = (at(row), at(row + 1));
        low + y * (high - low)
    }

    /// [`Warp::pdf`].
    #[inline(always)]
    pub(crate) fn pdf(&self, u: [f32; 2], s: &Between) -> f32 {
        let at = Spot::new(u, self.nx, self.ny);
        let (low, high) = (
            self.pair(s, at.row, at.col),
            self.pair(s, at.row + 1, at.col),
        );
        let line = |p: [[f32; 2]; 2]| p[0][0] + at.x * (p[1][0] - p[0][0]);
        (line(low) + at.y * (line(high) - line(low))) * self.cells()
    }

    /// [`Warp::invert`].
    #[inline(always)]
    pub(crate) fn invert(&self, p: [f32; 2], s: &Between) -> ([f32; 2], f32) {
        let at = Spot::new(p, self.nx, self.ny);
        let (low, high) = (
            self.pair(s, at.row, at.col),
            self.pair(s, at.row + 1, at.col),
        );
        let rise = |i: usize, j: usize| low[i][j] + at.y * (high[i][j] - low[i][j]);
        let (c0, c1) = (rise(0, 0), rise(1, 0));
        let row = self.row(s, at.row);
        let [r0, r1] = row.ends;
        let along = rise(0, 1) + at.x * (c0 + 0.5 * at.x * (c1 - c0));
        let mass = r0 + at.y * (r1 - r0);
        let below = row.below + at.y * (r0 + 0.5 * at.y * (r1 - r0));
        let u = if mass > 0.0 { along / mass } else { p[0] };
        ([u, below], (c0 + at.x * (c1 - c0)) * self.cells())
    }

    /// [`Warp::sample`].
    #[inline(always)]
    pub(crate) fn sample(&self, u: [f32; 2], s: &Between) -> ([f32; 2], f32) {
        let row = interval(self.ny, |row| self.below(s, row) <= u[1]);
        let line = self.row(s, row);
        let [r0, r1] = line.ends;
        let y = invert_linear(u[1] - line.below, r0, r1);
        let target = u[0] * (r0 + y * (r1 - r0));
        let col = interval(self.nx, |col| self.along(s, row, col, y) <= target);
        let (low, high) = (self.pair(s, row, col), self.pair(s, row + 1, col));
        let rise = |i: usize, j: usize| low[i][j] + y * (high[i][j] - low[i][j]);
        let (c0, c1) = (rise(0, 0), rise(1, 0));
        let x = invert_linear(target - rise(0, 1), c0, c1);
        let point = [
            (col as f32 + x) / (self.nx - 1) as f32,
            (row as f32 + y) / (self.ny - 1) as f32,
        ];
        (point, (c0 + x * (c1 - c0)) * self.cells())
    }
}

/// The last of `0..n - 1` for which `below` holds (0 if none does); nothing branches on the outcome.
#[inline(always)]
fn interval(n: usize, below: impl Fn(usize) -> bool) -> usize {
    let (mut first, mut len) = (0, n - 1);
    while len > 1 {
        let half = len / 2;
        first = if below(first + half) {
            first + half
        } else {
            first
        };
        len -= half;
    }
    first
}

/// t in [0, 1] with a t + (b - a) t^2 / 2 = mass, in the form that does not cancel.
#[inline(always)]
fn invert_linear(mass: f32, a: f32, b: f32) -> f32 {
    let root = (a * a + 2.0 * (b - a) * mass).max(0.0).sqrt();
    let sum = a + root;
    let t = 2.0 * mass / if sum > 0.0 { sum } else { 1.0 };
    t.clamp(0.0, 1.0)
}
