//! Paths a second on the benchmark scene, rays a second on a mesh.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench reports to whoever runs it"
)]

use brdf::{Brdf, DirectionSample, DirectionSampler, LANES, Lanes3, Paired, SampleLanes};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{DAffine3, DVec2, DVec3, Vec3};
use spectrum::Samples;
use std::f32::consts::PI;
use std::num::NonZeroUsize;
use std::time::Duration;
use tracer::{
    Camera, Description, Film, LightSelection, Mesh, Object, Scene, Settings, Shape, Strategy,
    render,
};

/// albedo / pi.
struct Lambert(f32);

impl Brdf<3> for Lambert {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        let up = wi.z > 0.0 && wo.z > 0.0;
        [if up { f64::from(self.0 / PI) } else { 0.0 }; 3]
    }
    #[inline]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; 3] {
        let f = self.0 / PI;
        let one = std::array::from_fn(|k| {
            if wi.z[k] > 0.0 && wo.z[k] > 0.0 {
                f
            } else {
                0.0
            }
        });
        [one; 3]
    }
}

struct Cosine;

/// Concentric map by a rational approximation of sine and cosine over a quarter circle.
#[inline(always)]
fn disk(u: f32, v: f32) -> (f32, f32) {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let wide = x.abs() > y.abs();
    let r = if wide { x } else { y };
    let a = (PI / 4.0) * if wide { y / x } else { x / y };
    let a = if r == 0.0 { 0.0 } else { a };
    let z = a * a;
    let s = a * (1.0 - z * (1.0 / 6.0 - z * (1.0 / 120.0 - z / 5040.0)));
    let c = 1.0 - z * (0.5 - z * (1.0 / 24.0 - z * (1.0 / 720.0 - z / 40320.0)));
    if wide { (r * c, r * s) } else { (r * s, r * c) }
}

impl DirectionSampler for Cosine {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let (x, y) = disk(u.x as f32, u.y as f32);
        let z = f64::from((1.0 - x * x - y * y).max(1e-12).sqrt());
        let wi = DVec3::new(f64::from(x), f64::from(y), z);
        (wo.z > 0.0).then_some(DirectionSample {
            wi,
            pdf: z / f64::from(PI),
        })
    }
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wo.z > 0.0 {
            wi.z.max(0.0) / f64::from(PI)
        } else {
            0.0
        }
    }
    #[inline]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        let mut out = SampleLanes {
            wi: Lanes3::ZERO,
            pdf: [0.0; LANES],
        };
        for k in 0..LANES {
            let (x, y) = disk(u[0][k], u[1][k]);
            let z = (1.0 - x * x - y * y).max(1e-12).sqrt();
            (out.wi.x[k], out.wi.y[k], out.wi.z[k]) = (x, y, z);
            out.pdf[k] = if wo.z[k] > 0.0 { z / PI } else { 0.0 };
        }
        out
    }
    #[inline]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        std::array::from_fn(|k| {
            if wo.z[k] > 0.0 {
                wi.z[k].max(0.0) / PI
            } else {
                0.0
            }
        })
    }
}

fn grey(albedo: f32) -> Box<Paired<Lambert, Cosine>> {
    Box::new(Paired {
        brdf: Lambert(albedo),
        sampler: Cosine,
    })
}

/// Sphere (or what stands for it) over a ground under an area light.
fn benchmark(middle: Shape, transform: DAffine3) -> Scene<3> {
    let light = Object {
        emission: Some(Samples([10.0; 3])),
        ..Object::new(
            Shape::Quad {
                corner: DVec3::new(-1.0, 4.0, 0.0),
                edge_u: DVec3::new(2.0, 0.0, 0.0),
                edge_v: DVec3::new(0.0, 0.0, 2.0),
            },
            0,
        )
    };
    let ground = Object::new(
        Shape::Quad {
            corner: DVec3::new(-10.0, 0.0, 10.0),
            edge_u: DVec3::new(20.0, 0.0, 0.0),
            edge_v: DVec3::new(0.0, 0.0, -20.0),
        },
        0,
    );
    let middle = Object {
        transform,
        ..Object::new(middle, 1)
    };
    Scene::new(Description {
        camera: Camera {
            eye: DVec3::new(0.0, 2.2, 6.5),
            target: DVec3::new(0.0, 1.0, 0.0),
            up: DVec3::Y,
            vertical_fov_deg: 35.0,
        },
        materials: vec![grey(0.5), grey(0.7)],
        objects: vec![middle, ground, light],
        lights: vec![],
        environment: None,
        selection: LightSelection::Auto,
    })
    .unwrap()
}

/// A bumpy sphere of 2 x 256 x 128 triangles.
fn bumpy() -> Mesh {
    let (columns, rows) = (256_u32, 128_u32);
    let mut mesh = Mesh::default();
    for y in 0..=rows {
        for x in 0..columns {
            let (theta, phi) = (
                PI * y as f32 / rows as f32,
                2.0 * PI * x as f32 / columns as f32,
            );
            let r = 1.0 + 0.02 * (20.0 * phi).sin() * (20.0 * theta).sin();
            let p = Vec3::new(
                theta.sin() * phi.cos(),
                theta.cos(),
                -theta.sin() * phi.sin(),
            );
            mesh.positions.push(p * r);
        }
    }
    for y in 0..rows {
        for x in 0..columns {
            let (a, b) = (y * columns + x, y * columns + (x + 1) % columns);
            mesh.triangles.push([a, a + columns, b]);
            mesh.triangles.push([b, a + columns, b + columns]);
        }
    }
    mesh
}

fn run(c: &mut Criterion, name: &str, scene: &Scene<3>) {
    let settings = Settings {
        spp: 16,
        ..Settings::default()
    };
    let paths = 640 * 480 * u64::from(settings.spp);
    let mut film = Film::new(640, 480, 8);
    let stats = render(scene, &settings, &mut film, &()).unwrap();
    let rays = |n: u64| n as f64 / paths as f64;
    println!(
        "{name}: {:.2} closest, {:.2} shadow rays, {:.2} vertices a path, mean {:?}",
        rays(stats.closest_rays),
        rays(stats.shadow_rays),
        rays(stats.vertices),
        film.mean().iter().map(|p| p[0]).sum::<f64>() / (640.0 * 480.0),
    );
    for (stage, time) in stats.stages.rows() {
        println!(
            "  {stage:9} {:7.1} ns a path",
            time.as_secs_f64() * 1e9 / paths as f64
        );
    }
    let mut group = c.benchmark_group("tracer/render");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(8));
    group.throughput(Throughput::Elements(paths));
    group.bench_function(name, |b| {
        b.iter(|| {
            let mut film = Film::<3>::new(640, 480, 8);
            render(scene, &settings, &mut film, &()).unwrap();
            film
        });
    });
    group.finish();
}

fn scenes(c: &mut Criterion) {
    let sphere = Shape::Sphere {
        center: DVec3::Y,
        radius: 1.0,
    };
    run(c, "benchmark", &benchmark(sphere, DAffine3::IDENTITY));
    let up = DAffine3::from_translation(DVec3::Y);
    run(c, "benchmark_mesh", &benchmark(Shape::Mesh(bumpy()), up));
}

/// Nearest hits alone, by the timer of that stage, one thread: seen from outside, all rays from one point, and in a
/// closed mesh that scatters evenly, four of five rays without any order.
fn rays(c: &mut Criterion) {
    let mut group = c.benchmark_group("tracer/closest_65k_triangles");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(4));
    let outside = DVec3::new(0.0, 0.5, 2.6);
    for (name, eye, max_depth) in [("primary", outside, 0), ("incoherent", DVec3::ZERO, 4)] {
        let scene = Scene::new(Description {
            camera: Camera {
                eye,
                target: DVec3::new(0.0, 0.0, -0.1),
                up: DVec3::Y,
                vertical_fov_deg: 45.0,
            },
            materials: vec![grey(0.9)],
            objects: vec![Object::new(Shape::Mesh(bumpy()), 0)],
            lights: vec![],
            environment: None,
            selection: LightSelection::Auto,
        })
        .unwrap();
        let settings = Settings {
            spp: 4,
            max_depth,
            strategy: Strategy::BsdfOnly,
            threads: Some(NonZeroUsize::MIN),
            ..Settings::default()
        };
        let trace = || render(&scene, &settings, &mut Film::new(320, 240, 4), &()).unwrap();
        group.throughput(Throughput::Elements(trace().closest_rays));
        group.bench_function(name, |b| {
            b.iter_custom(|n| (0..n).map(|_| trace().stages.closest).sum());
        });
    }
    group.finish();
}

criterion_group!(benches, rays, scenes);
criterion_main!(benches);
