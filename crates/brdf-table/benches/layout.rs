//! Which storage of the nodes reads fastest: the measurement behind the layout in `docs/tables.md`.
//!
//! Same random cubes for every layout, table of MERL's size, three channels, packets of 16 look-ups.

use brdf::LANES;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use half::f16;
use std::hint::black_box;

const DIMS: [usize; 3] = [91, 91, 182];
const NODES: usize = DIMS[0] * DIMS[1] * DIMS[2];
const PACKETS: usize = 4096;

type Cube = ([u32; 3], [f32; 3]);

fn cubes() -> Vec<[Cube; LANES]> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut below = move |n: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let u = (state >> 40) as f32 / (1_u64 << 24) as f32 * (n - 1) as f32;
        (u as u32, u.fract())
    };
    let mut cube = || {
        let [h, d, p] = DIMS.map(&mut below);
        ([h.0, d.0, p.0], [h.1, d.1, p.1])
    };
    (0..PACKETS)
        .map(|_| std::array::from_fn(|_| cube()))
        .collect()
}

/// Sums the eight corners; `read` gives the channels of the node at `[h, d, p]`.
#[inline(always)]
fn gather(cubes: &[Cube; LANES], read: impl Fn(u32, u32, u32) -> [f32; 3]) -> [[f32; LANES]; 3] {
    let mut out = [[0.0; LANES]; 3];
    for (k, &([h, d, p], [t_h, t_d, t_p])) in cubes.iter().enumerate() {
        let rows = [
            (h, d, (1.0 - t_h) * (1.0 - t_d)),
            (h, d + 1, (1.0 - t_h) * t_d),
            (h + 1, d, t_h * (1.0 - t_d)),
            (h + 1, d + 1, t_h * t_d),
        ];
        let mut sum = [0.0; 3];
        for (h, d, weight) in rows {
            let (low, high) = (read(h, d, p), read(h, d, p + 1));
            for c in 0..3 {
                sum[c] += weight * (low[c] + t_p * (high[c] - low[c]));
            }
        }
        for c in 0..3 {
            out[c][k] = sum[c];
        }
    }
    out
}

fn linear(h: u32, d: u32, p: u32) -> usize {
    (h as usize * DIMS[1] + d as usize) * DIMS[2] + p as usize
}

/// Bricks of 2 x 2 x 2 nodes.
fn bricks(h: u32, d: u32, p: u32) -> usize {
    let brick = ((h >> 1) as usize * DIMS[1].div_ceil(2) + (d >> 1) as usize) * DIMS[2].div_ceil(2)
        + (p >> 1) as usize;
    brick * 8 + ((h & 1) << 2 | (d & 1) << 1 | p & 1) as usize
}

fn layouts(c: &mut Criterion) {
    let cubes = cubes();
    let bricked = DIMS.map(|n| n.div_ceil(2)).iter().product::<usize>() * 8;
    let value = |k: usize| (k % 1000) as f32 * 0.01;
    let interleaved: Vec<[f32; 3]> = (0..NODES).map(|k| [value(k); 3]).collect();
    let padded: Vec<[f32; 4]> = (0..NODES).map(|k| [value(k); 4]).collect();
    let planes: [Vec<f32>; 3] = std::array::from_fn(|_| (0..NODES).map(value).collect());
    let halves: Vec<[f16; 3]> = (0..NODES).map(|k| [f16::from_f32(value(k)); 3]).collect();
    let halves4: Vec<[f16; 4]> = (0..NODES).map(|k| [f16::from_f32(value(k)); 4]).collect();
    let f32_bricks: Vec<[f32; 3]> = (0..bricked).map(|k| [value(k); 3]).collect();
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
    run("f32x3", &|q| {
        gather(q, |h, d, p| interleaved[linear(h, d, p)])
    });
    run("f32x4", &|q| {
        gather(q, |h, d, p| {
            let [r, g, b, _] = padded[linear(h, d, p)];
            [r, g, b]
        })
    });
    run("planar", &|q| {
        gather(q, |h, d, p| {
            let k = linear(h, d, p);
            [planes[0][k], planes[1][k], planes[2][k]]
        })
    });
    run("f16x3", &|q| {
        gather(q, |h, d, p| halves[linear(h, d, p)].map(f16::to_f32))
    });
    run("f16x4", &|q| {
        gather(q, |h, d, p| {
            let [r, g, b, _] = halves4[linear(h, d, p)];
            [r, g, b].map(f16::to_f32)
        })
    });
    run("f32x3-bricks", &|q| {
        gather(q, |h, d, p| f32_bricks[bricks(h, d, p)])
    });
    group.finish();
}

criterion_group!(benches, layouts);
criterion_main!(benches);
