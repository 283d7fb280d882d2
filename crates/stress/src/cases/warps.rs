//! Closed-form maps and tabulated densities: end points of u, spikes, narrow cones and lobes.

use crate::case::{Case, Effort};
use crate::real::Real;
use crate::reference::Vector;
use crate::tally::Tally;
use glam::{DVec2, DVec3};
use sampling::{AliasTable, Piecewise1, Piecewise2, warp};

/// Where distribution functions end: the largest f32 and f64 below 1, and the inside.
pub(super) const US: [f64; 8] = [
    0.0,
    1e-300,
    1e-12,
    0.25,
    0.5,
    0.999,
    1.0 - 1.0 / 16_777_216.0,
    1.0 - f64::EPSILON / 2.0,
];

/// A direction map with its density and inverse, for a width.
type Lobe = (
    &'static str,
    fn(DVec2, f64) -> DVec3,
    fn(DVec3, f64) -> f64,
    fn(DVec3, f64) -> DVec2,
    fn(&Vector, f64) -> Real,
    &'static [f64],
);

/// D cos of the half vector, as printed, and its widths.
const LOBES: &[Lobe] = &[
    (
        "warp/ggx half vector",
        warp::ggx_half,
        warp::ggx_half_pdf,
        warp::ggx_half_inverse,
        |h, a| {
            let z2 = (&h.z / h.length()).sqr();
            let a2 = Real::new(a).sqr();
            let denominator = (&a2 - 1.0) * &z2 + 1.0;
            a2 * z2.sqrt() / (Real::pi() * denominator.sqr())
        },
        &[1e-4, 1e-2, 0.3, 1.0],
    ),
    (
        "warp/beckmann half vector",
        warp::beckmann_half,
        warp::beckmann_half_pdf,
        warp::beckmann_half_inverse,
        |h, a| {
            let z2 = (&h.z / h.length()).sqr();
            let a2 = Real::new(a).sqr();
            let e = (-((1.0 - &z2) / &z2 / &a2)).exp();
            e / (Real::pi() * a2 * z2.pow(1.5))
        },
        &[1e-4, 1e-2, 0.3, 1.0],
    ),
    (
        "warp/blinn half vector",
        warp::blinn_half,
        warp::blinn_half_pdf,
        warp::blinn_half_inverse,
        |h, n| {
            let z = &h.z / h.length();
            (n + 2.0) / (2.0 * Real::pi()) * z.pow(n + 1.0)
        },
        &[0.0, 1.0, 1e3, 1e6],
    ),
    (
        "warp/cone",
        warp::cone,
        |_, depth| warp::cone_pdf(depth),
        warp::cone_inverse,
        |_, depth| 1.0 / (2.0 * Real::pi() * depth),
        // angles of 1e-7 and 1e-4 rad, 80 degrees, the sphere
        &[5e-15, 5e-9, 0.826, 2.0],
    ),
];

pub(super) fn cases() -> Vec<Case> {
    let mut all: Vec<_> = LOBES
        .iter()
        .map(|lobe| {
            Case::new(
                lobe.0,
                1e-8,
                "the power n = 1e6 of a cosine, and u near 1, whose tail an f64 direction knows to 1e-8",
                move |_, tally| follow(lobe, tally),
            )
        })
        .collect();
    all.extend([
        Case::new(
            "warp/1 - cos of a cone",
            1e-15,
            "roundings of f64",
            |_, tally| {
                for angle in [1e-12, 1e-9, 1e-4, 1e-2, 0.5, 1.396, 3.0] {
                    let value = warp::one_minus_cos(angle);
                    let exact = (1.0 - Real::new(angle).cos()).to_f64();
                    tally.value(value, exact, 0.0, || format!("angle {angle:e}"));
                    let sine = angle.sin();
                    if angle < 1.5 {
                        let value = warp::one_minus_cos_of_sin(sine);
                        let exact = (1.0 - (1.0 - Real::new(sine).sqr()).sqrt()).to_f64();
                        tally.value(value, exact, 0.0, || format!("sine {sine:e}"));
                    }
                }
            },
        ),
        Case::new(
            "density/one dimension, u to 1 - 2^-53",
            1e-9,
            "u comes back from x, whose rounding the height of a spike of 1e6 cells grows to 1e-10",
            one_dimension,
        ),
        Case::new(
            "density/two dimensions, u to 1 - 2^-53",
            1e-7,
            "the density of a sample is that at its point, which a spike's flank knows to 1e-8",
            two_dimensions,
        ),
        Case::new(
            "density/alias table",
            1e-10,
            "sums of 1e5 weights from 1e-300 to 1e300, one after the other",
            alias,
        ),
    ]);
    all
}

fn follow((_, map, pdf, inverse, exact, widths): &Lobe, tally: &mut Tally) {
    for &width in *widths {
        for (x, y) in US.into_iter().flat_map(|x| US.map(|y| (x, y))) {
            let u = DVec2::new(x, y);
            let w = map(u, width);
            let place = || format!("width {width:e}, u {u}, w {w}");
            tally.error((w.length() - 1.0).abs(), || format!("length, {}", place()));
            // a half vector that u = 1 - 2^-53 sends to the horizon has no place left in f64
            if w.z.abs() > 1e-6 || width >= 2.0 {
                let reference = exact(&Vector::new(w), width).to_f64();
                tally.value(pdf(w, width), reference, 1e-60, place);
                let back = inverse(w, width);
                tally.error((back.x - u.x).abs(), || format!("u from w, {}", place()));
            }
        }
    }
}

/// Weights that are hard on a distribution function.
pub(super) fn weights(n: usize) -> Vec<(&'static str, Vec<f64>)> {
    let spike = |k: usize, base: f64| {
        let mut all = vec![base; n];
        all[k] = 1.0;
        all
    };
    vec![
        ("spike at the start", spike(0, 0.0)),
        ("spike in the middle", spike(n / 2, 0.0)),
        ("spike at the end", spike(n - 1, 0.0)),
        ("spike over 1e-30", spike(n / 2, 1e-30)),
        ("all 1e-300", vec![1e-300; n]),
        ("all subnormal", vec![1e-310; n]),
        ("all 1e300/n", vec![1e300 / n as f64; n]),
        (
            "powers of ten",
            (-150..=150)
                .cycle()
                .map(|k| 10_f64.powi(k))
                .take(n)
                .collect(),
        ),
    ]
}

fn one_dimension(effort: Effort, tally: &mut Tally) {
    let n = effort.pick(1_000, 1_000_000);
    for (name, values) in weights(n) {
        for (kind, table) in [
            ("constant", Piecewise1::constant(&values)),
            ("linear", Piecewise1::linear(&values)),
        ] {
            let Ok(table) = table else {
                tally.error(f64::INFINITY, || format!("{kind}, {name}: refused"));
                continue;
            };
            for u in US {
                let (x, pdf) = table.sample(u);
                let place = || format!("{kind}, {name}, u {u:e}, x {x:e}");
                tally.sound(pdf, place);
                tally.error(if (0.0..1.0).contains(&x) { 0.0 } else { 1.0 }, place);
                tally.error((table.invert(x) - u).abs(), place);
            }
        }
    }
    let refused = Piecewise1::constant(&vec![0.0; n]).is_err();
    tally.error(if refused { 0.0 } else { 1.0 }, || {
        "all zero is refused".into()
    });
}

fn two_dimensions(effort: Effort, tally: &mut Tally) {
    let side = effort.pick(30, 500);
    for (name, values) in weights(side * side) {
        for (kind, table) in [
            ("constant", Piecewise2::constant(side, &values)),
            ("bilinear", Piecewise2::bilinear(side, &values)),
        ] {
            let Ok(table) = table else {
                tally.error(f64::INFINITY, || format!("{kind}, {name}: refused"));
                continue;
            };
            for (x, y) in US.into_iter().flat_map(|x| US.map(|y| (x, y))) {
                let (at, pdf) = table.sample(DVec2::new(x, y));
                let place = || format!("{kind}, {name}, u {x:e} {y:e}, at {at}");
                tally.sound(pdf, place);
                let inside = at.cmpge(DVec2::ZERO).all() && at.cmplt(DVec2::ONE).all();
                tally.error(if inside { 0.0 } else { 1.0 }, place);
                // at the edge of a cell either side may answer
                let edge = (at * side as f64).fract().min_element() < 1e-6;
                if !edge && pdf > 1e-3 {
                    tally.value(table.pdf(at), pdf, 0.0, place);
                }
            }
        }
    }
}

fn alias(effort: Effort, tally: &mut Tally) {
    for (name, values) in weights(effort.pick(1_000, 100_000)) {
        let Ok(table) = AliasTable::new(&values) else {
            tally.error(f64::INFINITY, || format!("{name}: refused"));
            continue;
        };
        let most = values.iter().fold(0.0_f64, |a, &b| a.max(b));
        let sum: f64 = values.iter().map(|v| v / most).sum();
        for u in US {
            let (k, probability, rest) = table.sample(u);
            let place = || format!("{name}, u {u:e}, index {k}");
            tally.value(probability, values[k] / most / sum, 0.0, place);
            tally.error(if (0.0..1.0).contains(&rest) { 0.0 } else { 1.0 }, place);
        }
    }
}
