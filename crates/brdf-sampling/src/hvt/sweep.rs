//! One pass over the points of a viewer, as wide as the machine allows.
//!
//! Nodes and points of a row of cells match lane by lane ([`View`]), so everything is sums of rows; none is taken in another
//! order for another instruction set.

use super::options::MAX_B;
use super::view::{POINTS, View};
use pulp::{Simd, WithSimd};

/// What is done with s, P and Q at a point: the part gathered at nodes and lobe, and the part of the value.
pub(crate) trait Kernel: Sync {
    /// Whether there is a Q.
    const SECOND: bool = false;
    /// Whether hats and D enter as their squares.
    const SQUARED: bool = false;
    fn at(s: f32, p: f32, q: f32) -> [f32; 2];
}

/// -dF/dC and F.
pub(crate) struct Gradient;

impl Kernel for Gradient {
    #[inline(always)]
    fn at(s: f32, p: f32, _: f32) -> [f32; 2] {
        let value = s / p;
        [value / p, value]
    }
}

/// The Hessian times the direction of Q.
pub(crate) struct Hessian;

impl Kernel for Hessian {
    const SECOND: bool = true;
    #[inline(always)]
    fn at(s: f32, p: f32, q: f32) -> [f32; 2] {
        [2.0 * s * q / (p * p * p), 0.0]
    }
}

/// The diagonal of the Hessian.
pub(crate) struct Diagonal;

impl Kernel for Diagonal {
    const SQUARED: bool = true;
    #[inline(always)]
    fn at(s: f32, p: f32, _: f32) -> [f32; 2] {
        [2.0 * s / (p * p * p), 0.0]
    }
}

/// Node values of one viewer, one more than there are, and the weight of its lobe.
pub(crate) struct Blended {
    pub(crate) nodes: Vec<f32>,
    pub(crate) lobe: f32,
}

/// What a viewer found.
pub(crate) struct Found {
    /// Gathered at the nodes, and one number more.
    pub(crate) nodes: Vec<f32>,
    pub(crate) lobe: f64,
    pub(crate) value: f64,
}

impl Found {
    fn zero(nodes: usize) -> Self {
        Self {
            nodes: vec![0.0; nodes],
            lobe: 0.0,
            value: 0.0,
        }
    }
}

/// Calls the kernel at every point, P from `x` and Q from `q`, and gathers what it returns.
pub(crate) fn sweep<K: Kernel>(view: &View, n_b: usize, x: &Blended, q: &Blended) -> Found {
    let kernel = std::marker::PhantomData::<K>;
    brdf::arch().dispatch(Sweep {
        view,
        n_b,
        x,
        q,
        kernel,
    })
}

struct Sweep<'a, K> {
    view: &'a View,
    n_b: usize,
    x: &'a Blended,
    q: &'a Blended,
    kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel> WithSimd for Sweep<'_, K> {
    type Output = Found;

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) -> Found {
        match self.n_b {
            8 => self.rows::<8>(),
            16 => self.rows::<16>(),
            24 => self.rows::<24>(),
            _ => self.rows::<MAX_B>(),
        }
    }
}

impl<K: Kernel> Sweep<'_, K> {
    #[inline(always)]
    fn rows<const B: usize>(&self) -> Found {
        let mut found = Found::zero(self.x.nodes.len());
        let rows = (self.x.nodes.len() - 1) / B;
        for i in 0..rows - 1 {
            let c = corners::<B>(&self.x.nodes, i);
            let c2 = if K::SECOND {
                corners::<B>(&self.q.nodes, i)
            } else {
                c
            };
            let mut sums = [[0.0; B]; 4];
            let (mut lobe, mut value) = ([0.0; B], [0.0; B]);
            for p in 0..POINTS {
                let at = (i * POINTS + p) * B;
                let (s, d) = (row::<B>(&self.view.s, at), row::<B>(&self.view.d, at));
                let hat = self.view.hats[p];
                let weight = if K::SQUARED {
                    [
                        hat[0] * hat[0],
                        hat[1] * hat[1],
                        hat[2] * hat[2],
                        hat[3] * hat[3],
                    ]
                } else {
                    hat
                };
                for j in 0..B {
                    let along = |c: &[&[f32; B]; 4], lobe: f32| {
                        (c[0][j] * hat[0] + c[1][j] * hat[1])
                            + (c[2][j] * hat[2] + c[3][j] * hat[3])
                            + lobe * d[j]
                    };
                    let at_x = along(&c, self.x.lobe);
                    let at_q = if K::SECOND {
                        along(&c2, self.q.lobe)
                    } else {
                        0.0
                    };
                    let [g, part] = K::at(s[j], at_x, at_q);
                    value[j] += part;
                    lobe[j] += if K::SQUARED {
                        g * d[j] * d[j]
                    } else {
                        g * d[j]
                    };
                    sums[0][j] += g * weight[0];
                    sums[1][j] += g * weight[1];
                    sums[2][j] += g * weight[2];
                    sums[3][j] += g * weight[3];
                }
            }
            found.lobe += total(&lobe);
            found.value += total(&value);
            spread(&sums, &mut found.nodes, i);
        }
        found
    }
}

/// Hat-weighted sums of `values` and of the weights alone, at the nodes.
pub(crate) fn gather(view: &View, n_b: usize, values: &[f32]) -> [Vec<f32>; 2] {
    let rows = values.len() / (n_b * POINTS) + 1;
    let mut out = [vec![0.0; rows * n_b + 1], vec![0.0; rows * n_b + 1]];
    for (row, list) in values.chunks_exact(n_b).enumerate() {
        let (node, hat) = (row / POINTS * n_b, view.hats[row % POINTS]);
        for (j, value) in list[..n_b - 1].iter().enumerate() {
            for (w, offset) in hat.into_iter().zip([0, 1, n_b, n_b + 1]) {
                out[0][node + j + offset] += w * value;
                out[1][node + j + offset] += w;
            }
        }
    }
    out
}

/// The values at the corners of all cells of row `i`.
#[inline(always)]
fn corners<const B: usize>(nodes: &[f32], i: usize) -> [&[f32; B]; 4] {
    let at = i * B;
    [
        row(nodes, at),
        row(nodes, at + 1),
        row(nodes, at + B),
        row(nodes, at + B + 1),
    ]
}

#[inline(always)]
fn row<const B: usize>(list: &[f32], at: usize) -> &[f32; B] {
    list[at..].first_chunk().unwrap_or(&[0.0; B])
}

/// Adds sums over the cells of row `i` to the nodes at their corners.
#[inline(always)]
fn spread<const B: usize>(sums: &[[f32; B]; 4], nodes: &mut [f32], i: usize) {
    for (sum, offset) in sums.iter().zip([0, 1, B, B + 1]) {
        for (node, s) in nodes[i * B + offset..][..B].iter_mut().zip(sum) {
            *node += s;
        }
    }
}

/// The sum of a row, in one order for all machines.
#[inline(always)]
fn total<const B: usize>(row: &[f32; B]) -> f64 {
    let mut eights = [0.0; 8];
    for part in row.chunks_exact(8) {
        for k in 0..8 {
            eights[k] += f64::from(part[k]);
        }
    }
    eights.iter().sum()
}
