//! One family against one set of data: lobes over all pairs, the best weights for a shape, normal equations.
//!
//! Rows are summed in blocks of a fixed size that are added in order, so that results do not depend on the number of
//! threads; neither rows nor Jacobian of millions of cells are ever held at once.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::family::{Family, Lobes};
use crate::metric::{Metric, Sums};
use crate::nnls::{nnls, solve_on};
use crate::samples::Samples;

/// Pairs a block: large enough to be worth a thread, small enough to stay in its cache.
const BLOCK: usize = 1024;

/// Gauss-Newton steps for the weights of a metric that is not linear; convergence is quadratic near the optimum, and
/// the outer iteration starts from the weights of the last shape.
const WEIGHT_STEPS: usize = 12;

/// A family, a metric and data.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'a> {
    pub(crate) family: &'a dyn Family,
    pub(crate) metric: Metric,
    pub(crate) samples: &'a Samples,
}

/// The weights of every channel, channel by channel.
pub(crate) type Weights = Vec<Vec<f64>>;

/// Factors of the lobes and their derivatives by the weights.
type Factors = (Vec<f64>, DMatrix<f64>);

/// A shape with its best weights.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// The iteration's variables.
    pub(crate) u: Vec<f64>,
    pub(crate) weights: Weights,
    /// Sum of weighted squared residuals.
    pub(crate) cost: f64,
}

/// J^T J and J^T r of one point, unknowns in the order: shape, weights of channel 0, 1, ...
#[derive(Clone, Debug)]
pub(crate) struct Normal {
    pub(crate) jtj: DMatrix<f64>,
    pub(crate) jtr: DVector<f64>,
}

impl Normal {
    fn zeros(n: usize) -> Self {
        Self {
            jtj: DMatrix::zeros(n, n),
            jtr: DVector::zeros(n),
        }
    }
}

/// The rows of the weighted Jacobian that belong to one pair of directions, a channel each.
pub(crate) struct PairRows {
    /// Derivatives by the shape, then by the weights of the channel itself, times the root of the pair's weight.
    pub(crate) rows: Vec<Vec<f64>>,
    /// Residuals, likewise.
    pub(crate) residuals: Vec<f64>,
    shapes: usize,
    weights: usize,
}

impl PairRows {
    fn new(shapes: usize, weights: usize, channels: usize) -> Self {
        Self {
            rows: vec![vec![0.0; shapes + weights]; channels],
            residuals: vec![0.0; channels],
            shapes,
            weights,
        }
    }

    /// Which unknown entry `i` of the row of a channel belongs to.
    #[inline]
    pub(crate) fn unknown(&self, channel: usize, i: usize) -> usize {
        if i < self.shapes {
            i
        } else {
            i + channel * self.weights
        }
    }

    /// J^T r into `g`, for these residuals.
    #[inline]
    pub(crate) fn pull(&self, residuals: &[f64], g: &mut DVector<f64>) {
        g.fill(0.0);
        for (c, (row, r)) in self.rows.iter().zip(residuals).enumerate() {
            for (i, value) in row.iter().enumerate() {
                g[self.unknown(c, i)] += value * r;
            }
        }
    }
}

/// Gram matrix and right side of one channel, linearised.
struct Gram {
    gram: DMatrix<f64>,
    rhs: DVector<f64>,
}

impl<'a> Problem<'a> {
    pub(crate) fn shape_at(&self, u: &[f64]) -> Vec<f64> {
        (self.family.shape().iter().zip(u))
            .map(|(p, u)| p.scale.to_parameter(*u).clamp(p.range.0, p.range.1))
            .collect()
    }

    /// Ranges of the variables.
    pub(crate) fn bounds(&self) -> Vec<(f64, f64)> {
        (self.family.shape().iter())
            .map(|p| {
                (
                    p.scale.to_variable(p.range.0),
                    p.scale.to_variable(p.range.1),
                )
            })
            .collect()
    }

    pub(crate) fn unknowns(&self) -> usize {
        self.family.shape().len() + self.family.weights().len() * self.samples.channels()
    }

    /// Weight, cosine of the light and values of every pair of a block.
    fn rows(&self, block: usize) -> impl Iterator<Item = (f64, f64, &'a [f64])> {
        let samples = self.samples;
        let (from, to) = (block * BLOCK, ((block + 1) * BLOCK).min(samples.len()));
        let values = &samples.values()[from * samples.channels()..to * samples.channels()];
        let metric = self.metric;
        (samples.pairs()[from..to].iter())
            .zip(values.chunks_exact(samples.channels()))
            .map(move |(p, y)| (p.weight * metric.measure(p.wi.z, p.wo.z), p.wi.z, y))
    }

    fn blocks(&self) -> usize {
        self.samples.len().div_ceil(BLOCK)
    }

    /// `lobes` at the pairs of a block, lobes of a pair together.
    fn eval_block(&self, lobes: &dyn Lobes, block: usize, out: &mut Vec<f64>) {
        let k = self.family.lobe_count();
        let (from, to) = (block * BLOCK, ((block + 1) * BLOCK).min(self.samples.len()));
        out.resize((to - from) * k, 0.0);
        for (pair, out) in self.samples.pairs()[from..to]
            .iter()
            .zip(out.chunks_exact_mut(k))
        {
            lobes.eval(pair.wi, pair.wo, out);
        }
    }

    /// `f` over all blocks, results in the order of blocks.
    fn each_block<T: Send>(&self, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
        (0..self.blocks()).into_par_iter().map(f).collect()
    }

    /// The best weights for the shape at `u`, and their cost. `start` is where the iteration of a metric that is not
    /// linear begins.
    pub(crate) fn solve(&self, u: &[f64], start: Option<&Weights>) -> Point {
        let lobes = self.family.lobes(&self.shape_at(u));
        let table = self.each_block(|block| {
            let mut out = Vec::new();
            self.eval_block(&*lobes, block, &mut out);
            out
        });
        let mut weights = match start {
            Some(weights) => weights.clone(),
            None => self.first_weights(&table),
        };
        let linear = self.metric.is_linear() && self.family.is_linear();
        // one step from anywhere ends at the optimum of a linear problem
        let mut cost = if linear {
            f64::INFINITY
        } else {
            self.cost(&table, &weights)
        };
        for _ in 0..if linear { 1 } else { WEIGHT_STEPS } {
            let Some((better, lower)) = self.improve(&table, &weights, cost) else {
                break;
            };
            let done = cost - lower <= 1e-13 * cost;
            (weights, cost) = (better, lower);
            if done {
                break;
            }
        }
        Point {
            u: u.to_vec(),
            weights,
            cost,
        }
    }

    /// Weights of the data's own size, equal in all lobes: the start where there is none better.
    fn first_weights(&self, table: &[Vec<f64>]) -> Weights {
        let k = self.family.lobe_count();
        let channels = self.samples.channels();
        let (mut lobe_sum, mut sums) = (0.0, vec![0.0; channels]);
        for (block, lobes) in table.iter().enumerate() {
            for ((w, _, y), lobes) in self.rows(block).zip(lobes.chunks_exact(k)) {
                lobe_sum += w * lobes.iter().sum::<f64>();
                sums.iter_mut()
                    .zip(y)
                    .for_each(|(s, y)| *s += w * y.max(0.0));
            }
        }
        let scale = if lobe_sum > 0.0 {
            lobe_sum.recip()
        } else {
            1.0
        };
        let n = self.family.weights().len();
        sums.iter().map(|s| vec![s * scale; n]).collect()
    }

    /// One Gauss-Newton step of the weights, halved until it lowers the cost; `None` if it does not.
    fn improve(&self, table: &[Vec<f64>], weights: &Weights, cost: f64) -> Option<(Weights, f64)> {
        let target: Weights = (self.grams(table, weights).iter().zip(weights))
            .map(|(g, old)| self.solve_gram(g, old))
            .collect();
        let mut t = 1.0;
        for _ in 0..30 {
            let trial: Weights = (weights.iter().zip(&target))
                .map(|(a, b)| a.iter().zip(b).map(|(a, b)| a + t * (b - a)).collect())
                .collect();
            let lower = self.cost(table, &trial);
            if lower < cost {
                return Some((trial, lower));
            }
            t *= 0.5;
        }
        None
    }

    fn solve_gram(&self, g: &Gram, old: &[f64]) -> Vec<f64> {
        let signed = self.family.weights().iter().all(|w| w.signed);
        let x = if signed {
            let all: Vec<usize> = (0..g.rhs.len()).collect();
            solve_on(&g.gram, &g.rhs, &all)
        } else {
            Some(nnls(&g.gram, &g.rhs))
        };
        x.map_or_else(|| old.to_vec(), |x| x.iter().copied().collect())
    }

    /// The linearised problem in the weights of every channel: residual r + r' (m(w) - m), m(w) by its Jacobian.
    fn grams(&self, table: &[Vec<f64>], weights: &Weights) -> Vec<Gram> {
        let (k, n) = (self.family.lobe_count(), self.family.weights().len());
        let channels: Vec<Factors> = weights
            .iter()
            .map(|w| coefficients(self.family, w))
            .collect();
        let blocks = self.each_block(|block| {
            let mut sums = vec![(vec![0.0; n * n], vec![0.0; n]); channels.len()];
            let mut row = vec![0.0; n];
            for ((w, ci, y), lobes) in self.rows(block).zip(table[block].chunks_exact(k)) {
                for (c, (coefficients, by_weight)) in channels.iter().enumerate() {
                    let m: f64 = dot(coefficients, lobes);
                    let (r, slope) = self.metric.residual(y[c], m, ci);
                    let mut at_old = 0.0;
                    for j in 0..n {
                        row[j] = slope * dot(by_weight.column(j).as_slice(), lobes);
                        at_old += row[j] * weights[c][j];
                    }
                    let target = at_old - r;
                    let (gram, rhs) = &mut sums[c];
                    for i in 0..n {
                        rhs[i] += w * row[i] * target;
                        for j in 0..=i {
                            gram[i * n + j] += w * row[i] * row[j];
                        }
                    }
                }
            }
            sums
        });
        (0..channels.len())
            .map(|c| {
                let mut gram = DMatrix::zeros(n, n);
                let mut rhs = DVector::zeros(n);
                for block in &blocks {
                    for i in 0..n {
                        rhs[i] += block[c].1[i];
                        (0..=i).for_each(|j| gram[(i, j)] += block[c].0[i * n + j]);
                    }
                }
                gram.fill_upper_triangle_with_lower_triangle();
                Gram { gram, rhs }
            })
            .collect()
    }

    fn cost(&self, table: &[Vec<f64>], weights: &Weights) -> f64 {
        let k = self.family.lobe_count();
        let channels: Vec<Vec<f64>> = weights
            .iter()
            .map(|w| coefficients(self.family, w).0)
            .collect();
        let sums = self.each_block(|block| {
            let mut sum = 0.0;
            for ((w, ci, y), lobes) in self.rows(block).zip(table[block].chunks_exact(k)) {
                for (c, coefficients) in channels.iter().enumerate() {
                    let r = self.metric.residual(y[c], dot(coefficients, lobes), ci).0;
                    sum += w * r * r;
                }
            }
            sum
        });
        sums.iter().sum()
    }

    /// Normal equations at a point.
    pub(crate) fn normal(&self, point: &Point) -> Normal {
        let (p, n) = (self.family.shape().len(), self.family.weights().len());
        let (q, channels) = (p + n, self.samples.channels());
        // J^T J by rows and J^T r of one channel after the other
        let each = |sums: &mut Vec<f64>, pair: &PairRows| {
            let of_channels = sums.chunks_exact_mut(q * (q + 1));
            for ((row, r), sums) in pair.rows.iter().zip(&pair.residuals).zip(of_channels) {
                let (squares, right) = sums.split_at_mut(q * q);
                for ((u, squares), right) in row.iter().zip(squares.chunks_exact_mut(q)).zip(right)
                {
                    *right += u * r;
                    squares.iter_mut().zip(row).for_each(|(s, v)| *s += u * v);
                }
            }
        };
        let empty = || vec![0.0; channels * q * (q + 1)];
        let unknown = |c: usize, i: usize| if i < p { i } else { i + c * n };
        let mut sum = Normal::zeros(self.unknowns());
        for block in self.by_pair(point, empty, each) {
            for (c, sums) in block.chunks_exact(q * (q + 1)).enumerate() {
                for i in 0..q {
                    sum.jtr[unknown(c, i)] += sums[q * q + i];
                    for j in 0..q {
                        sum.jtj[(unknown(c, i), unknown(c, j))] += sums[i * q + j];
                    }
                }
            }
        }
        sum
    }

    /// Shows the Jacobian and the residuals at a point, pair by pair, to `each`; what it makes of every block, in order.
    /// Derivatives by shape are forward differences of the lobes.
    pub(crate) fn by_pair<T: Send>(
        &self,
        point: &Point,
        empty: impl Fn() -> T + Sync + Send,
        each: impl Fn(&mut T, &PairRows) + Sync + Send,
    ) -> Vec<T> {
        let p = self.family.shape().len();
        let steps = self.steps(&point.u);
        let base = self.family.lobes(&self.shape_at(&point.u));
        let moved: Vec<Box<dyn Lobes>> = (0..p)
            .map(|j| {
                let mut u = point.u.clone();
                u[j] += steps[j];
                self.family.lobes(&self.shape_at(&u))
            })
            .collect();
        let channels: Vec<Factors> = point
            .weights
            .iter()
            .map(|w| coefficients(self.family, w))
            .collect();
        self.each_block(|block| {
            let mut tables = vec![Vec::new(); p + 1];
            self.eval_block(&*base, block, &mut tables[p]);
            for (moved, table) in moved.iter().zip(&mut tables) {
                self.eval_block(&**moved, block, table);
            }
            let mut out = empty();
            self.pairs_of(block, &tables, (&steps, &channels), |pair| {
                each(&mut out, pair);
            });
            out
        })
    }

    fn pairs_of(
        &self,
        block: usize,
        tables: &[Vec<f64>],
        (steps, channels): (&[f64], &[Factors]),
        mut each: impl FnMut(&PairRows),
    ) {
        let (k, n, p) = (
            self.family.lobe_count(),
            self.family.weights().len(),
            steps.len(),
        );
        let mut pair = PairRows::new(p, n, channels.len());
        for (s, (w, ci, y)) in self.rows(block).enumerate() {
            let at = |t: usize| &tables[t][s * k..(s + 1) * k];
            let (lobes, root) = (at(p), w.sqrt());
            for (c, (coefficients, by_weight)) in channels.iter().enumerate() {
                let m = dot(coefficients, lobes);
                let (r, slope) = self.metric.residual(y[c], m, ci);
                let row = &mut pair.rows[c];
                for j in 0..p {
                    row[j] = root * slope * (dot(coefficients, at(j)) - m) / steps[j];
                }
                for j in 0..n {
                    row[p + j] = root * slope * dot(by_weight.column(j).as_slice(), lobes);
                }
                pair.residuals[c] = root * r;
            }
            each(&pair);
        }
    }

    /// Steps of the forward differences: inside the range, 1e-6 of a variable of order one (rounding of the lobes,
    /// 1e-14, leaves 1e-8 of a derivative; its curvature 1e-6).
    fn steps(&self, u: &[f64]) -> Vec<f64> {
        (self.bounds().iter().zip(u))
            .map(|((_, high), u)| {
                let h = 1e-6 * u.abs().max(1.0);
                if u + h > *high { -h } else { h }
            })
            .collect()
    }

    /// What the reported error is made of.
    pub(crate) fn sums(&self, point: &Point) -> Sums {
        let k = self.family.lobe_count();
        let lobes = self.family.lobes(&self.shape_at(&point.u));
        let channels: Vec<Vec<f64>> = point
            .weights
            .iter()
            .map(|w| coefficients(self.family, w).0)
            .collect();
        let blocks = self.each_block(|block| {
            let mut table = Vec::new();
            self.eval_block(&*lobes, block, &mut table);
            let mut integrals = Integrals::new(channels.len());
            for ((w, ci, y), lobes) in self.rows(block).zip(table.chunks_exact(k)) {
                for (c, coefficients) in channels.iter().enumerate() {
                    integrals.add(self.metric, c, (w, ci), (y[c], dot(coefficients, lobes)));
                }
            }
            integrals
        });
        Integrals::total(&blocks)
    }
}

/// Sums over pairs of one block.
pub(crate) struct Integrals {
    weight: f64,
    squares: f64,
    /// y^2/m, m, y per channel.
    by_channel: Vec<[f64; 3]>,
}

impl Integrals {
    pub(crate) fn new(channels: usize) -> Self {
        Self {
            weight: 0.0,
            squares: 0.0,
            by_channel: vec![[0.0; 3]; channels],
        }
    }

    /// One value `y` of channel `c` and its model value `m`, at weight `w` and light cosine `ci`.
    pub(crate) fn add(
        &mut self,
        metric: Metric,
        c: usize,
        (w, ci): (f64, f64),
        (y, m): (f64, f64),
    ) {
        let r = metric.residual(y, m, ci).0;
        self.weight += w;
        self.squares += w * r * r;
        if metric == Metric::RelVar {
            // r = (y - m)/sqrt(m), hence y^2/m = r^2 + 2 y - m, with the floor of the residual
            let y = y.max(0.0);
            let sums = &mut self.by_channel[c];
            sums[0] += w * (r * r + 2.0 * y - m);
            sums[1] += w * m;
            sums[2] += w * y;
        }
    }

    pub(crate) fn total(blocks: &[Self]) -> Sums {
        let channels = blocks.first().map_or(0, |b| b.by_channel.len());
        let rel_var = (0..channels).map(|c| {
            let sum = |k: usize| blocks.iter().map(|b| b.by_channel[c][k]).sum::<f64>();
            sum(0) * sum(1) / (sum(2) * sum(2)) - 1.0
        });
        Sums {
            weight: blocks.iter().map(|b| b.weight).sum(),
            squares: blocks.iter().map(|b| b.squares).sum(),
            rel_var: rel_var.collect(),
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Factors of the lobes and their derivatives by the weights (lobes x weights).
fn coefficients(family: &dyn Family, weights: &[f64]) -> Factors {
    let (k, n) = (family.lobe_count(), weights.len());
    let mut at = vec![0.0; k];
    family.coefficients(weights, &mut at);
    if family.is_linear() {
        return (at, DMatrix::identity(k, n));
    }
    let mut by_weight = DMatrix::zeros(k, n);
    let mut moved = vec![0.0; k];
    for j in 0..n {
        let mut weights = weights.to_vec();
        let h = 1e-6 * weights[j].abs().max(1e-3);
        weights[j] += h;
        family.coefficients(&weights, &mut moved);
        (0..k).for_each(|i| by_weight[(i, j)] = (moved[i] - at[i]) / h);
    }
    (at, by_weight)
}
