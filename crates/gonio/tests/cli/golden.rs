//! Golden renders: means of blocks of pixels, stored with their variances and compared statistically, never bit by bit.
//!
//! `GONIO_BLESS=1` writes them anew; the test renders with another seed than the stored pictures had.

use crate::program::{Bench, repository};
use scene_io::image::{Picture, read_exr};
use serde::{Deserialize, Serialize};

const SCENES: [&str; 4] = ["default", "benchmark", "white-furnace", "closed-form"];
const SIZE: [usize; 2] = [48, 36];
/// Pixels a side of a block.
const BLOCK: usize = 12;
const SPP: u32 = 256;

#[derive(Serialize, Deserialize)]
struct Golden {
    width: usize,
    height: usize,
    /// Pixels a side of a block; blocks are stored row after row.
    block: usize,
    spp: u32,
    seed: u32,
    blocks: Vec<Block>,
}

/// Linear sRGB radiance of a block.
#[derive(Serialize, Deserialize)]
struct Block {
    mean: [f64; 3],
    /// Of the mean.
    variance: [f64; 3],
}

fn render(name: &str, seed: u32, spp: u32) -> Picture {
    let bench = Bench::new();
    let scene = repository(&format!("scenes/{name}/scene.ron"));
    let [w, h] = SIZE;
    bench.text(&format!(
        "render {scene} --size {w}x{h} --spp {spp} --seed {seed} -o a.exr"
    ));
    read_exr(&bench.path("a.exr")).unwrap()
}

fn blocks(picture: &Picture) -> Vec<Block> {
    let variance = picture.variance.as_ref().unwrap();
    let columns = SIZE[0] / BLOCK;
    let of = |block: usize| {
        let (mut mean, mut var) = ([0.0; 3], [0.0; 3]);
        let n = (BLOCK * BLOCK) as f64;
        for k in 0..BLOCK * BLOCK {
            let row = block / columns * BLOCK + k / BLOCK;
            let pixel = row * SIZE[0] + block % columns * BLOCK + k % BLOCK;
            for c in 0..3 {
                mean[c] += f64::from(picture.pixels[pixel][c]) / n;
                // pixels are sampled independently of each other
                var[c] += f64::from(variance[pixel][c]) / (n * n);
            }
        }
        Block {
            mean,
            variance: var,
        }
    };
    (0..columns * SIZE[1] / BLOCK).map(of).collect()
}

/// p-values that each block and channel has the same mean in both pictures.
fn p_values(a: &[Block], b: &[Block]) -> Vec<f64> {
    let pairs = a.iter().zip(b);
    pairs
        .flat_map(|(a, b)| {
            (0..3).map(|c| {
                // pixels are stored in f32
                let rounding = 1e-6 * b.mean[c].abs();
                let error = (a.variance[c] + b.variance[c] + rounding * rounding).sqrt();
                testkit::z_test(a.mean[c], error, b.mean[c]).p_value
            })
        })
        .collect()
}

#[test]
fn slow_golden_renders() {
    for name in SCENES {
        let path = repository(&format!("scenes/{name}/golden.json"));
        if std::env::var_os("GONIO_BLESS").is_some() {
            let seed = 1;
            let golden = Golden {
                width: SIZE[0],
                height: SIZE[1],
                block: BLOCK,
                spp: 4 * SPP,
                seed,
                blocks: blocks(&render(name, seed, 4 * SPP)),
            };
            let text = serde_json::to_string_pretty(&golden).unwrap();
            scene_io::write::bytes(path.as_ref(), format!("{text}\n").as_bytes()).unwrap();
            println!("wrote {path}");
        }
        let text = scene_io::load::text(path.as_ref(), 1 << 20).unwrap();
        let golden: Golden = serde_json::from_str(&text).unwrap();
        assert_eq!(
            [golden.width, golden.height, golden.block],
            [SIZE[0], SIZE[1], BLOCK],
            "{name}"
        );
        let now = blocks(&render(name, golden.seed + 1, SPP));
        let p = p_values(&now, &golden.blocks);
        assert_eq!(p.len(), now.len() * 3, "{name}: blocks");
        // one in ten thousand over all scenes, blocks and channels
        let level = testkit::sidak(1e-4, SCENES.len());
        if let Some(k) = testkit::significant(&p, level) {
            let (block, c) = (k / 3, k % 3);
            panic!(
                "{name}: block {block}, channel {c}: {} now, {} stored (p = {:e}); if the change is wanted: GONIO_BLESS=1",
                now[block].mean[c], golden.blocks[block].mean[c], p[k]
            );
        }
    }
}

/// The comparison finds a picture that is three percent brighter.
#[test]
fn slow_golden_comparison_sees_three_percent() {
    let a = blocks(&render("benchmark", 3, SPP));
    let mut b = blocks(&render("benchmark", 4, 4 * SPP));
    assert_eq!(
        testkit::significant(&p_values(&a, &b), 1e-4),
        None,
        "the same scene"
    );
    for block in &mut b {
        block.mean = block.mean.map(|v| 1.03 * v);
    }
    assert!(
        testkit::significant(&p_values(&a, &b), 1e-4).is_some(),
        "three percent brighter"
    );
}
