//! Node values of least variance: a few multiplicative updates, then Newton steps by conjugate gradients.
//!
//! Under sum C w + L = 1 per slice the optimum has -dF/dC = mu_k w wherever C is above its floor. The
//! multiplicative update C <- C (-dF/dC / (mu_k w))^e converges for e <= 1/2 [Yu2010] from anywhere, but
//! slowly (3/4 is faster, and what follows does not mind); Newton's step for F + sum_k mu_k (mass_k - 1) with mu_k = sum C (-dF/dC), on the nodes above the
//! floor, needs a matrix as well conditioned as the mass matrix of hat functions: ten products solve it.

use super::problem::{Pass, Problem, Unknowns};
use super::shape::Shape;

/// Lowest node value as a fraction of the slice's mean.
const FLOOR: f64 = 1e-4;
/// Lowest weight of the cosine lobe: support, whatever the nodes hold.
const LOBE_FLOOR: f64 = 1e-3;
/// Longest relative move of an unknown in one Newton step, down and up.
const TRUST: [f64; 2] = [-0.75, 2.0];
/// Newton steps are not shortened below this.
const SHORTEST: f64 = 0.05;

/// How long to search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Effort {
    pub(crate) multiplicative: usize,
    pub(crate) newton: usize,
    pub(crate) gradients: usize,
}

/// The best unknowns found, every slice of mass 1, and F there.
pub(crate) fn optimise(problem: &Problem, effort: Effort) -> (Unknowns, f64) {
    let shape = problem.shape;
    let mut x = problem.start(0.7);
    fill_untouched(problem, &mut x);
    normalise(shape, &mut x);
    let mut at = Point {
        pass: problem.gradient(&x),
        x,
    };
    for _ in 0..effort.multiplicative {
        at = multiplied(problem, &at);
    }
    for _ in 0..effort.newton {
        // far from the optimum Newton's direction may lead nowhere: a few cheap steps, then it is asked again
        at = match newton(problem, &at, effort.gradients) {
            Some(next) => next,
            None => multiplied(problem, &multiplied(problem, &at)),
        };
    }
    (at.x, at.pass.value)
}

/// Unknowns, every slice of mass 1, and F and its gradient there.
struct Point {
    x: Unknowns,
    pass: Pass,
}

/// The next point by the multiplicative update.
fn multiplied(problem: &Problem, at: &Point) -> Point {
    let (shape, mut x) = (problem.shape, at.x.clone());
    let mu = multipliers(shape, &x, &at.pass.out);
    for_each(shape, &mut x, |k, w, index| {
        let r = index.of(&at.pass.out) / (mu[k] * w);
        // to the power 3/4, by roots: the same on every machine
        let root = r.max(0.0).sqrt();
        move |value: &mut f64| *value *= root * root.sqrt()
    });
    normalise(shape, &mut x);
    let pass = problem.gradient(&x);
    Point { x, pass }
}

/// The next point by Newton's step, shortened until it is no worse; `None` if it has to be very short.
fn newton(problem: &Problem, at: &Point, gradients: usize) -> Option<Point> {
    let step = newton_direction(problem, &at.x, &at.pass.out, gradients);
    let mut length = 1.0;
    while length > SHORTEST {
        let mut x = at.x.clone();
        for_each(problem.shape, &mut x, |_, _, index| {
            let d = length * index.of(&step);
            move |value: &mut f64| *value += d.clamp(TRUST[0] * *value, TRUST[1] * *value)
        });
        normalise(problem.shape, &mut x);
        let pass = problem.gradient(&x);
        if pass.value <= at.pass.value {
            return Some(Point { x, pass });
        }
        length *= 0.35;
    }
    None
}

/// One unknown: a node or a lobe.
#[derive(Clone, Copy)]
enum Index {
    Node(usize),
    Lobe(usize),
}

impl Index {
    fn of(self, x: &Unknowns) -> f64 {
        match self {
            Self::Node(n) => x.nodes[n],
            Self::Lobe(k) => x.lobe[k],
        }
    }
}

/// Applies `f(slice, mass of the unknown, index)` to every unknown.
fn for_each<G: FnOnce(&mut f64)>(
    shape: Shape,
    x: &mut Unknowns,
    f: impl Fn(usize, f64, Index) -> G,
) {
    for k in 0..shape.slices() {
        f(k, 1.0, Index::Lobe(k))(&mut x.lobe[k]);
        for i in 0..shape.n_a {
            for j in 0..shape.n_b {
                let n = k * shape.slice() + i * shape.n_b + j;
                f(k, shape.hat_mass(i, j), Index::Node(n))(&mut x.nodes[n]);
            }
        }
    }
}

/// mu_k = sum over slice k of C (-dF/dC) + L (-dF/dL); 1 for slices nothing depends on.
fn multipliers(shape: Shape, x: &Unknowns, gradient: &Unknowns) -> Vec<f64> {
    let n = shape.slice();
    (0..shape.slices())
        .map(|k| {
            let nodes = x.nodes[k * n..][..n]
                .iter()
                .zip(&gradient.nodes[k * n..][..n]);
            let sum = nodes.map(|(c, g)| c * g).sum::<f64>() + x.lobe[k] * gradient.lobe[k];
            if sum > 0.0 { sum } else { 1.0 }
        })
        .collect()
}

/// Floors, then mass 1 per slice.
pub(crate) fn normalise(shape: Shape, x: &mut Unknowns) {
    let n = shape.slice();
    for k in 0..shape.slices() {
        let nodes = &mut x.nodes[k * n..(k + 1) * n];
        let mass = shape.mass(nodes).max(f64::MIN_POSITIVE);
        for v in nodes.iter_mut() {
            *v = v.max(FLOOR * mass);
        }
        let total = shape.mass(nodes) + x.lobe[k];
        for v in nodes.iter_mut() {
            *v /= total;
        }
        x.lobe[k] /= total;
        if x.lobe[k] < LOBE_FLOOR {
            let keep = (1.0 - LOBE_FLOOR) / (1.0 - x.lobe[k]);
            nodes.iter_mut().for_each(|v| *v *= keep);
            x.lobe[k] = LOBE_FLOOR;
        }
    }
}

/// Slices the target says nothing about are the cosine.
fn fill_untouched(problem: &Problem, x: &mut Unknowns) {
    let n = problem.shape.slice();
    for (k, touched) in problem.touched().into_iter().enumerate() {
        let empty = x.nodes[k * n..(k + 1) * n].iter().all(|v| *v <= 0.0);
        if !touched || empty {
            x.nodes[k * n..(k + 1) * n].fill(1e-3);
            x.lobe[k] = 1.0;
        }
    }
}

/// Solves H d = -dF/dC - mu w on the free unknowns by conjugate gradients, preconditioned by the diagonal.
fn newton_direction(
    problem: &Problem,
    x: &Unknowns,
    gradient: &Unknowns,
    iterations: usize,
) -> Unknowns {
    let shape = problem.shape;
    let mu = multipliers(shape, x, gradient);
    let diagonal = problem.hessian_diagonal(x);
    let mut residual = gradient.clone();
    let mut free = Unknowns::zero(shape);
    for_each(shape, &mut residual, |k, w, _| {
        let push = mu[k] * w;
        move |value: &mut f64| *value -= push
    });
    for_each(shape, &mut free, |_, _, index| {
        let floor = match index {
            Index::Node(_) => 1.5 * FLOOR,
            Index::Lobe(_) => 1.01 * LOBE_FLOOR,
        };
        let is_free =
            index.of(&diagonal) > 0.0 && (index.of(x) > floor || index.of(&residual) > 0.0);
        move |value: &mut f64| *value = f64::from(u8::from(is_free))
    });
    multiply(&mut residual, &free);
    let precondition = |r: &Unknowns| {
        let mut z = r.clone();
        let divide = |(z, d): (&mut f64, &f64)| *z = if *d > 0.0 { *z / d } else { 0.0 };
        z.nodes.iter_mut().zip(&diagonal.nodes).for_each(divide);
        z.lobe.iter_mut().zip(&diagonal.lobe).for_each(divide);
        z
    };
    let mut d = Unknowns::zero(shape);
    let mut z = precondition(&residual);
    let mut p = z.clone();
    let mut rz = dot(&residual, &z);
    for _ in 0..iterations {
        let mut hp = problem.hessian(x, &p);
        multiply(&mut hp, &free);
        let curvature = dot(&p, &hp);
        if !(curvature > 0.0 && rz > 0.0) {
            break;
        }
        let alpha = rz / curvature;
        add(&mut d, alpha, &p);
        add(&mut residual, -alpha, &hp);
        z = precondition(&residual);
        let next = dot(&residual, &z);
        let beta = next / rz;
        rz = next;
        let old = std::mem::replace(&mut p, z.clone());
        add(&mut p, beta, &old);
    }
    d
}

fn dot(a: &Unknowns, b: &Unknowns) -> f64 {
    let pairs = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    pairs(&a.nodes, &b.nodes) + pairs(&a.lobe, &b.lobe)
}

fn add(a: &mut Unknowns, k: f64, b: &Unknowns) {
    let each = |(x, y): (&mut f64, &f64)| *x += k * y;
    a.nodes.iter_mut().zip(&b.nodes).for_each(each);
    a.lobe.iter_mut().zip(&b.lobe).for_each(each);
}

fn multiply(a: &mut Unknowns, b: &Unknowns) {
    let each = |(x, y): (&mut f64, &f64)| *x *= y;
    a.nodes.iter_mut().zip(&b.nodes).for_each(each);
    a.lobe.iter_mut().zip(&b.lobe).for_each(each);
}
