//! Scenes whose picture is known without rendering.

use crate::program::{Bench, repository};
use glam::DVec3;
use scene_io::image::{Picture, read_exr};

fn render(name: &str, options: &str) -> Picture {
    let bench = Bench::new();
    let scene = repository(&format!("scenes/{name}/scene.ron"));
    bench.text(&format!("render {scene} {options} -o a.exr"));
    read_exr(&bench.path("a.exr")).unwrap()
}

#[test]
fn white_furnace_gives_its_albedo() {
    let side = 48;
    let picture = render("white-furnace", &format!("--size {side}x{side} --spp 64"));
    let (mut inside, mut count) = (0.0, 0);
    for (k, pixel) in picture.pixels.iter().enumerate() {
        let from_centre = |n: usize| (n as f64 + 0.5) / side as f64 - 0.5;
        let radius = from_centre(k % side).hypot(from_centre(k / side));
        // the unit sphere, 5 away, fills tan(asin(1/5)) / (2 tan 13 deg) = 0.442 of the height on either side
        if radius < 0.40 {
            inside += pixel.iter().map(|v| f64::from(*v)).sum::<f64>() / 3.0;
            count += 1;
        } else if radius > 0.48 {
            let bits = pixel.map(f32::to_bits);
            assert_eq!(bits, [1_f32.to_bits(); 3], "the background is exactly 1");
        }
    }
    let albedo = inside / f64::from(count);
    assert!((albedo / 0.8 - 1.0).abs() < 1e-3, "{albedo}");
}

/// Blocks a side, and pixels a side of a block.
const BLOCKS: usize = 6;
const BLOCK: usize = 8;

/// Mean radiance of pixels by sampling each 16 times: what the closed form says; `None` where the lamp is near.
fn exact(block: usize) -> Option<f64> {
    let side = BLOCKS * BLOCK;
    let fine = 4;
    let half = 20_f64.to_radians().tan();
    let eye = DVec3::new(0.0, 8.0, 0.001);
    let forward = -eye.normalize();
    let right = forward.cross(DVec3::NEG_Z).normalize();
    let up = right.cross(forward);
    let mut sum = 0.0;
    for k in 0..(BLOCK * fine) * (BLOCK * fine) {
        let at = |block: usize, sub: usize| {
            let place = (block * BLOCK * fine + sub) as f64 + 0.5;
            2.0 * place / (side * fine) as f64 - 1.0
        };
        let x = at(block % BLOCKS, k % (BLOCK * fine));
        let y = at(block / BLOCKS, k / (BLOCK * fine));
        let ray = (forward + half * x * right - half * y * up).normalize();
        let to_lamp = DVec3::new(0.0, 2.0, 0.0) - eye;
        // a little more than its radius of 0.5
        if to_lamp.cross(ray).length() < 0.55 {
            return None;
        }
        let plane = eye - ray * (eye.y / ray.y);
        let distance = plane.x * plane.x + plane.z * plane.z + 4.0;
        sum += 0.5 * 4.0 * 0.25 * 2.0 / distance.powf(1.5);
    }
    Some(sum / ((BLOCK * fine) * (BLOCK * fine)) as f64)
}

#[test]
fn closed_form_is_met_within_its_error() {
    let side = BLOCKS * BLOCK;
    let picture = render(
        "closed-form",
        &format!("--size {side}x{side} --spp 64 --seed 5"),
    );
    let variance = picture.variance.as_ref().unwrap();
    let (mut error, mut spread, mut tested) = (0.0, 0.0, 0);
    let mut p_values = Vec::new();
    for block in 0..BLOCKS * BLOCKS {
        let Some(expected) = exact(block) else {
            continue;
        };
        let (mut mean, mut var) = (0.0, 0.0);
        for k in 0..BLOCK * BLOCK {
            let row = block / BLOCKS * BLOCK + k / BLOCK;
            let pixel = row * side + block % BLOCKS * BLOCK + k % BLOCK;
            mean += f64::from(picture.pixels[pixel][1]);
            var += f64::from(variance[pixel][1]);
        }
        let n = (BLOCK * BLOCK) as f64;
        let (mean, error_of_block) = (mean / n, var.sqrt() / n);
        error += mean - expected;
        spread += error_of_block * error_of_block;
        tested += 1;
        p_values.push(testkit::z_test(mean, error_of_block, expected).p_value);
    }
    assert!(tested > 20, "{tested} blocks");
    let z = error / spread.sqrt();
    assert!(z.abs() < 3.0, "{z} standard errors off");
    // the standard errors are small enough to find a mistake of half a percent
    assert!(spread.sqrt() / f64::from(tested) < 0.005 * 0.1, "{spread}");
    assert_eq!(testkit::significant(&p_values, 1e-3), None, "{p_values:?}");
}
