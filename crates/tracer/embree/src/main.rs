//! `cargo run --release --features embree --manifest-path crates/tracer/embree/Cargo.toml [TRIANGLES...]`: nearest hits a
//! second on one thread, ours and Embree's, in turn.
//!
//! The meshes are bumpy spheres inside a bumpy sphere. *Primary* rays leave one point in the order of an image,
//! *diffuse* ones leave what those met, in the same order, *shuffled* ones are the same without any order.

#[cfg(feature = "embree")]
mod embree;

use brdf::{EvalPacket, Material, SamplePacket};
use glam::{DVec3, Vec3};
use std::time::Instant;
use tracer::{Camera, Description, LightSelection, Mesh, Object, Ray, Scene, Shape};

/// Nothing is shaded here.
struct Black;

impl Material<1> for Black {
    fn eval(&self, _: &mut [EvalPacket<1>]) {}
    fn sample(&self, _: &mut [SamplePacket<1>]) {}
}

fn main() {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![10_000, 1_000_000] } else { sizes };
    for size in sizes {
        compare(size);
    }
}

fn compare(size: usize) {
    let (positions, triangles) = spheres(size);
    println!("{} triangles", triangles.len());
    let clock = Instant::now();
    let ours = scene(&positions, &triangles);
    println!("  built in {:.2} s", clock.elapsed().as_secs_f64());
    #[cfg(feature = "embree")]
    let theirs = [false, true].map(|robust| {
        let clock = Instant::now();
        let scene = embree::Scene::new(&positions, &triangles, robust);
        println!("  Embree (robust: {robust}) in {:.2} s", clock.elapsed().as_secs_f64());
        scene
    });
    let primary = primary();
    let mut hits = vec![None; primary.len()];
    ours.nearest(&primary, &mut hits);
    let diffuse: Vec<Ray> = (primary.iter().zip(&hits))
        .enumerate()
        .filter_map(|(i, (ray, hit))| Some(bounce(i as u64, ray, hit.as_ref()?.t)))
        .collect();
    let mut shuffled = diffuse.clone();
    for i in (1..shuffled.len()).rev() {
        shuffled.swap(i, (hash(i as u64) % (i as u64 + 1)) as usize);
    }
    for (name, rays) in [("primary", primary), ("diffuse", diffuse), ("shuffled", shuffled)] {
        let mut hits = vec![None; rays.len()];
        let mut mine = Vec::new();
        #[cfg(feature = "embree")]
        let mut others = [Vec::new(), Vec::new()];
        for _ in 0..7 {
            let clock = Instant::now();
            ours.nearest(&rays, &mut hits);
            mine.push(rate(rays.len(), clock));
            #[cfg(feature = "embree")]
            for (scene, rates) in theirs.iter().zip(&mut others) {
                let clock = Instant::now();
                let mut differ = 0_usize;
                for (ray, hit) in rays.iter().zip(&hits) {
                    let t = scene.nearest(ray.o, ray.d).map_or(f32::INFINITY, |h| h.0);
                    let ours = hit.map_or(f32::INFINITY, |h| h.t);
                    differ += usize::from((t - ours).abs() > 1e-3 * t.min(ours).max(1e-2));
                }
                rates.push(rate(rays.len(), clock));
                assert!(differ * 1000 < rays.len(), "{name}: {differ} hits differ");
            }
        }
        print!("  {name:9} {:6.2} M rays/s", median(&mut mine));
        #[cfg(feature = "embree")]
        for (which, rates) in ["fast", "robust"].iter().zip(&mut others) {
            let theirs = median(rates);
            print!("   Embree {which} {theirs:6.2}, ratio {:.2}", median(&mut mine) / theirs);
        }
        println!();
    }
}

fn rate(rays: usize, clock: Instant) -> f64 {
    rays as f64 * 1e-6 / clock.elapsed().as_secs_f64()
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn scene(positions: &[Vec3], triangles: &[[u32; 3]]) -> Scene<1> {
    let mesh = Mesh {
        positions: positions.to_vec(),
        normals: None,
        triangles: triangles.to_vec(),
    };
    Scene::new(Description {
        camera: Camera {
            eye: DVec3::ZERO,
            target: DVec3::NEG_Z,
            up: DVec3::Y,
            vertical_fov_deg: 45.0,
        },
        materials: vec![Box::new(Black)],
        objects: vec![Object::new(Shape::Mesh(mesh), 0)],
        lights: vec![],
        environment: None,
        selection: LightSelection::Auto,
    })
    .expect("a mesh makes a scene")
}

/// A sphere of radius 4 around 26 of radius 0.5, all with bumps; half of the triangles are the large one's.
fn spheres(size: usize) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    sphere(size / 2, (Vec3::ZERO, 4.0), (&mut positions, &mut triangles));
    for i in 0..27_u8 {
        if i != 13 {
            let at = Vec3::new(f32::from(i % 3), f32::from(i / 3 % 3), f32::from(i / 9)) - 1.0;
            sphere(size / 52, (1.7 * at, 0.5), (&mut positions, &mut triangles));
        }
    }
    (positions, triangles)
}

fn sphere(
    size: usize,
    (center, radius): (Vec3, f32),
    (positions, triangles): (&mut Vec<Vec3>, &mut Vec<[u32; 3]>),
) {
    let rows = ((size as f64 / 4.0).sqrt() as u32).max(4);
    let columns = 2 * rows;
    let first = positions.len() as u32;
    for y in 0..=rows {
        for x in 0..columns {
            let theta = std::f32::consts::PI * y as f32 / rows as f32;
            let phi = 2.0 * std::f32::consts::PI * x as f32 / columns as f32;
            let r = radius * (1.0 + 0.03 * (20.0 * phi).sin() * (20.0 * theta).sin());
            positions.push(
                center
                    + r * Vec3::new(
                        theta.sin() * phi.cos(),
                        theta.cos(),
                        -theta.sin() * phi.sin(),
                    ),
            );
        }
    }
    for y in 0..rows {
        for x in 0..columns {
            let (a, b) = (first + y * columns + x, first + y * columns + (x + 1) % columns);
            triangles.push([a, a + columns, b]);
            triangles.push([b, a + columns, b + columns]);
        }
    }
}

/// An image of 640 x 480 from inside the large sphere.
fn primary() -> Vec<Ray> {
    let mut rays = Vec::new();
    for y in 0..480_u16 {
        for x in 0..640_u16 {
            let d = Vec3::new(
                f32::from(x) / 320.0 - 1.0,
                0.75 - f32::from(y) / 320.0,
                -0.8,
            );
            rays.push(Ray {
                o: Vec3::new(0.85, 0.85, 3.3),
                d: d.normalize(),
                t_max: f32::INFINITY,
            });
        }
    }
    rays
}

/// An even direction of the half space that the ray came from, from a little before its hit.
fn bounce(i: u64, ray: &Ray, t: f32) -> Ray {
    let number = |k: u64| (hash(2 * i + k) >> 40) as f32 / 16_777_216.0;
    let z = 2.0 * number(0) - 1.0;
    let (s, phi) = ((1.0 - z * z).sqrt(), 2.0 * std::f32::consts::PI * number(1));
    let d = Vec3::new(s * phi.cos(), s * phi.sin(), z);
    Ray {
        o: ray.o + ray.d * (t * 0.9995),
        d: if d.dot(ray.d) > 0.0 { -d } else { d },
        t_max: f32::INFINITY,
    }
}

/// The finaliser of SplitMix64.
fn hash(i: u64) -> u64 {
    let mut x = i.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
