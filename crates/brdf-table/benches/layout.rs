//! Which storage of the nodes reads fastest: the measurement behind the layout in `docs/tables.md`.
//!
//! The same cubes for every layout, table of MERL's size, three channels, packets of 16 look-ups.

use brdf::{HalfDiff, LANES};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use half::f16;
use std::f64::consts::{FRAC_2_PI, PI};
use std::hint::black_box;

const ROW: usize = 182;
const NODES: usize = 91 * 91 * ROW;
const PACKETS: usize = 4096;

/// Lowest corner of a cube of eight nodes, and the place in it.
type Cube = (usize, [f32; 3]);

/// Cubes as pairs of independent directions, uniform over the hemisphere, need them.
fn cubes() -> Vec<[Cube; LANES]> {
    let mut rng = testkit::Rng::new(1);
    let mut above = || {
        brdf::direction(
            (1.0 - rng.uniform()).acos(),
            std::f64::consts::TAU * rng.uniform(),
        )
    };
    let mut cube = || {
        let at = HalfDiff::new(above(), above());
        let positions = [
            90.0 * (at.theta_h * FRAC_2_PI).sqrt(),
            90.0 * at.theta_d * FRAC_2_PI,
            180.0 * at.phi_d.rem_euclid(PI) / PI,
        ];
        let [h, d, p] = positions.map(|x| (x as usize).min(179));
        (
            h * ROW * 91 + d * ROW + p,
            positions.map(|x| x.fract() as f32),
        )
    };
    (0..PACKETS)
        .map(|_| std::array::from_fn(|_| cube()))
        .collect()
}

/// Reads the corners of all lanes, then sums their `M` channels.
#[inline(always)]
fn gather<T: Copy + Default, const M: usize>(
    nodes: &[T],
    cubes: &[Cube; LANES],
    widen: impl Fn(T) -> [f32; M],
) -> [[f32; LANES]; M] {
    let mut corners = [[[T::default(); 2]; 4]; LANES];
    for (corners, (base, _)) in corners.iter_mut().zip(cubes) {
        let starts = [*base, base + ROW, base + ROW * 91, base + ROW * 92];
        for (pair, start) in corners.iter_mut().zip(starts) {
            pair.copy_from_slice(&nodes[start..start + 2]);
        }
    }
    let mut out = [[0.0; LANES]; M];
    for k in 0..LANES {
        let [t_h, t_d, t_p] = cubes[k].1;
        let weights = [
            (1.0 - t_h) * (1.0 - t_d),
            (1.0 - t_h) * t_d,
            t_h * (1.0 - t_d),
            t_h * t_d,
        ];
        for (pair, weight) in corners[k].iter().zip(weights) {
            let (low, high) = (widen(pair[0]), widen(pair[1]));
            for c in 0..M {
                out[c][k] += weight * (low[c] + t_p * (high[c] - low[c]));
            }
        }
    }
    out
}

/// Half to single precision by shifts and one multiplication: no hardware conversion, no infinities.
fn widen(h: f16) -> f32 {
    let bits = u32::from(h.to_bits());
    let magnitude = f32::from_bits((bits & 0x7FFF) << 13) * f32::from_bits(0x7780_0000);
    f32::from_bits(magnitude.to_bits() | (bits & 0x8000) << 16)
}

fn layouts(c: &mut Criterion) {
    let cubes = cubes();
    let value = |k: usize| (k % 1000) as f32 * 0.01;
    let all = |k: usize| f16::from_f32(value(k));
    let f32x3: Vec<[f32; 3]> = (0..NODES).map(|k| [value(k); 3]).collect();
    let f32x4: Vec<[f32; 4]> = (0..NODES).map(|k| [value(k); 4]).collect();
    let planes: [Vec<f32>; 3] = std::array::from_fn(|_| (0..NODES).map(value).collect());
    let f16x3: Vec<[f16; 3]> = (0..NODES).map(|k| [all(k); 3]).collect();
    let f16x4: Vec<[f16; 4]> = (0..NODES).map(|k| [all(k); 4]).collect();
    let mut group = c.benchmark_group("brdf-table/layout");
    group.throughput(Throughput::Elements((PACKETS * LANES) as u64));
    let mut run = |name: &str, read: &dyn Fn(&[Cube; LANES]) -> [[f32; LANES]; 3]| {
        group.bench_function(name, |b| {
            b.iter(|| {
                for packet in &cubes {
                    black_box(read(packet));
                }
            });
        });
    };
    run("f32x3", &|q| gather(&f32x3, q, |v| v));
    run("f32x4", &|q| gather(&f32x4, q, |[r, g, b, _]| [r, g, b]));
    run("planar", &|q| {
        let [r, g, b] = &planes;
        let [[r], [g], [b]] = [r, g, b].map(|plane| gather(plane, q, |v| [v]));
        [r, g, b]
    });
    run("f16x3", &|q| gather(&f16x3, q, |v| v.map(widen)));
    run("f16x4", &|q| {
        gather(&f16x4, q, |[r, g, b, _]| [r, g, b].map(widen))
    });
    group.finish();
}

criterion_group!(benches, layouts);
criterion_main!(benches);
