//! Shapes in scenes of any size and place: distances, points, rays that leave, shared edges.

use crate::case::{Case, Effort};
use crate::real::Real;
use crate::reference::Vector;
use crate::scenes::{anywhere, ball, floor, of, placed, unit_sphere};
use crate::tally::Tally;
use glam::{DVec3, Vec3};
use sampling::Rng;
use tracer::{Mesh, Scene, Shape};

/// Scale and shift: sizes from 1e-6 to 1e6, and a million sizes away.
const PLACES: [(f64, f64); 7] = [
    (1.0, 0.0),
    (1e-6, 0.0),
    (1e6, 0.0),
    (1e-3, 0.7),
    (1.0, 1e3),
    (1.0, 1e6),
    (1e3, 1e6),
];

/// The direction scenes are shifted along.
const AWAY: DVec3 = DVec3::new(1.0, -0.37, 0.81);

/// By the names of the tracer's variants; a test compares them with the source.
pub(super) fn cases() -> Vec<Case> {
    let roundings = "roundings of f32 relative to the coordinates that enter: 8 times 6e-8";
    let mut all = vec![
        Case::new("shape/Sphere/distance", 1e-6, roundings, |e, t| {
            each_place(t, |scale, shift, t| sphere(scale, shift, e, t));
        }),
        Case::new("shape/Quad/distance", 1e-6, roundings, |e, t| {
            each_place(t, |scale, shift, t| plane(floor(1.0), scale, shift, e, t));
        }),
        Case::new("shape/Mesh/distance", 1e-6, roundings, |e, t| {
            each_place(t, |scale, shift, t| {
                plane(Shape::Mesh(two_triangles()), scale, shift, e, t);
            });
        }),
        Case::new(
            "shape/Mesh/triangles of aspect 1e6",
            0.0,
            "every ray aimed at the inside is met",
            slivers,
        ),
        Case::new(
            "shape/Mesh/watertight edges and corners",
            0.0,
            "no ray passes between triangles that share an edge",
            watertight,
        ),
    ];
    let solids = [
        ("Sphere", unit_sphere as fn() -> Shape),
        ("Quad", || floor(1.0)),
        ("Mesh", || Shape::Mesh(ball(12))),
    ];
    all.extend(solids.map(|(name, shape)| {
        Case::new(
            format!("shape/{name}/rays that leave"),
            0.0,
            "no ray that leaves a convex body meets it again",
            move |e, t| each_place(t, |scale, shift, t| leaves(shape(), scale, shift, e, t)),
        )
    }));
    all
}

fn each_place(tally: &mut Tally, mut f: impl FnMut(f64, DVec3, &mut Tally)) {
    for (scale, shift) in PLACES {
        f(scale, AWAY * shift, tally);
    }
}

fn scene(shape: Shape, scale: f64, shift: DVec3, tally: &mut Tally) -> Option<Scene<1>> {
    let scene = of(placed(shape, scale, shift));
    if scene.is_none() {
        tally.error(f64::INFINITY, || format!("no scene at {scale:e}, {shift}"));
    }
    scene
}

/// Origin and unit direction, rounded to f32, of a ray toward `target` from a distance.
fn ray(target: DVec3, scale: f64, rng: &mut Rng) -> (Vec3, Vec3) {
    let far = [3.0, 10.0, 100.0][rng.below(3)] * scale;
    let from = (target + anywhere(rng) * far).as_vec3();
    (from, (target - from.as_dvec3()).normalize().as_vec3())
}

fn sphere(scale: f64, shift: DVec3, effort: Effort, tally: &mut Tally) {
    let Some(scene) = scene(unit_sphere(), scale, shift, tally) else {
        return;
    };
    let (centre, radius) = (shift.as_vec3().as_dvec3(), f64::from(scale as f32));
    let mut rng = Rng::new(1);
    for _ in 0..effort.pick(20, 400) {
        let (o, d) = ray(shift + anywhere(&mut rng) * (0.9 * scale), scale, &mut rng);
        let (from, along) = (o.as_dvec3(), d.as_dvec3());
        let reference = sphere_distance(from - centre, along, radius);
        let place = || format!("scale {scale:e}, shift {shift}, o {o}, d {d}");
        match (scene.meet(o, d), reference) {
            (Some(at), Some(exact)) => {
                let size = centre.abs().max_element() + (from - centre).length() + radius;
                let error = (f64::from(at.distance) - exact).abs() / size;
                // a ray at a flat angle sees the rounding of its direction grow by 1/cos
                let cos = at.normal.as_dvec3().dot(along).abs().max(1e-3);
                tally.error(error * cos, place);
                let off = (at.point.as_dvec3() - centre).length() - radius;
                let beyond = (off.abs() - f64::from(at.error)).max(0.0);
                tally.error(beyond / size, || format!("off the surface, {}", place()));
            }
            (None, None) => tally.count += 1,
            // a million away a coordinate is known to a sixteenth: no ray can be aimed within its rounding
            _ => tally.count += 1,
        }
    }
}

/// The nearer positive root, by the quadratic formula.
fn sphere_distance(o: DVec3, d: DVec3, r: f64) -> Option<f64> {
    let (o, d) = (Vector::new(o), Vector::new(d));
    let (a, b, c) = (d.dot(&d), o.dot(&d), o.dot(&o) - Real::new(r).sqr());
    let discriminant = b.sqr() - &a * c;
    if !discriminant.is_positive() {
        return None;
    }
    let root = discriminant.sqrt();
    let (near, far) = ((-&b - &root) / &a, (-&b + &root) / &a);
    let t = if near.is_positive() { near } else { far };
    t.is_positive().then(|| t.to_f64())
}

/// The square of [`floor`].
fn two_triangles() -> Mesh {
    Mesh {
        positions: vec![
            Vec3::new(-1.0, 0.0, 1.0),
            Vec3::new(1.0, 0.0, 1.0),
            Vec3::new(1.0, 0.0, -1.0),
            Vec3::new(-1.0, 0.0, -1.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: None,
    }
}

fn plane(shape: Shape, scale: f64, shift: DVec3, effort: Effort, tally: &mut Tally) {
    let Some(scene) = scene(shape, scale, shift, tally) else {
        return;
    };
    let height = f64::from(shift.y as f32);
    let mut rng = Rng::new(2);
    for _ in 0..effort.pick(20, 400) {
        let [x, z] = [rng.uniform(), rng.uniform()].map(|u| 1.6 * u - 0.8);
        let (o, d) = ray(shift + DVec3::new(x, 0.0, z) * scale, scale, &mut rng);
        let Some(at) = scene.meet(o, d) else {
            tally.count += 1;
            continue;
        };
        let place = || format!("scale {scale:e}, shift {shift}, o {o}, d {d}");
        let exact = (height - f64::from(o.y)) / f64::from(d.y);
        let size = shift.abs().max_element() + o.as_dvec3().distance(shift) + scale;
        let cos = f64::from(d.y).abs();
        tally.error((f64::from(at.distance) - exact).abs() * cos / size, place);
        let off = (f64::from(at.point.y) - height).abs();
        let beyond = (off - f64::from(at.error)).max(0.0);
        tally.error(beyond / size, || format!("off the surface, {}", place()));
    }
}

fn leaves(shape: Shape, scale: f64, shift: DVec3, effort: Effort, tally: &mut Tally) {
    let Some(scene) = scene(shape, scale, shift, tally) else {
        return;
    };
    let mut rng = Rng::new(3);
    for _ in 0..effort.pick(20, 300) {
        let inside = anywhere(&mut rng) * DVec3::new(0.6, 0.0, 0.6);
        let (o, d) = ray(shift + inside * scale, scale, &mut rng);
        let Some(at) = scene.meet(o, d) else {
            continue;
        };
        for _ in 0..4 {
            let w = anywhere(&mut rng);
            // from straight up to 1e-6 rad above the surface, on the side that was met
            let up = -at.normal * at.normal.dot(d).signum();
            let w = (w - up.as_dvec3() * w.dot(up.as_dvec3())).normalize_or(DVec3::X);
            let lift = [1.0, 0.1, 1e-3, 1e-6][rng.below(4)];
            let w = (w + up.as_dvec3() * lift).normalize().as_vec3();
            let again = scene.meet_next(&at, w).is_some() && w.dot(up) > 0.0;
            tally.error(if again { 1.0 } else { 0.0 }, || {
                format!("scale {scale:e}, shift {shift}, at {}, w {w}", at.point)
            });
        }
    }
}

fn slivers(effort: Effort, tally: &mut Tally) {
    let mut rng = Rng::new(4);
    for thin in [1e-2_f32, 1e-4, 1e-6] {
        let mesh = Mesh {
            positions: vec![
                Vec3::new(-1.0, 0.0, 0.0),
                Vec3::new(1.0, 0.0, 0.0),
                Vec3::new(0.0, 0.0, -2.0 * thin),
            ],
            triangles: vec![[0, 1, 2]],
            normals: None,
        };
        let Some(scene) = scene(Shape::Mesh(mesh), 1.0, DVec3::ZERO, tally) else {
            return;
        };
        for _ in 0..effort.pick(50, 2_000) {
            let x = 0.8 * rng.uniform() - 0.4;
            // straight down at its middle: both ends of the ray have the same x and z, which are exact
            let o = Vec3::new(x as f32, 1.0, -0.5 * thin);
            let met = scene.meet(o, -Vec3::Y).is_some();
            tally.error(if met { 0.0 } else { 1.0 }, || {
                format!("thin {thin:e}, o {o}")
            });
        }
    }
}

/// Rays from inside of a closed ball at corners and at points of edges, also of one squeezed to 1e-6.
fn watertight(effort: Effort, tally: &mut Tally) {
    for squeeze in [1.0_f32, 1e-3, 1e-6] {
        let mut mesh = ball(effort.pick(6, 24) as u32);
        for p in &mut mesh.positions {
            p.y *= squeeze;
        }
        let edges: Vec<[Vec3; 2]> = mesh
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|e| e.map(|i| mesh.positions[i as usize]))
            .collect();
        for (scale, shift) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 0.3)] {
            let shift = AWAY * shift;
            let Some(scene) = scene(Shape::Mesh(mesh.clone()), scale, shift, tally) else {
                return;
            };
            let o = shift.as_vec3();
            // a centre that rounding has moved out of a ball squeezed flat would prove nothing
            if shift != DVec3::ZERO && squeeze < 1e-3 {
                continue;
            }
            for [a, b] in &edges {
                for t in [0.0, 0.3, 0.5] {
                    let target = (*a + (*b - *a) * t).as_dvec3() * scale + shift;
                    let d = (target - o.as_dvec3()).normalize().as_vec3();
                    let met = scene.meet(o, d).is_some();
                    tally.error(if met { 0.0 } else { 1.0 }, || {
                        format!("squeezed {squeeze:e}, scale {scale:e}, shift {shift}, d {d}")
                    });
                }
            }
        }
    }
}
