//! Lights from 1e-4 to 80 degrees: solid angles against 160 bits, samples against densities.

use crate::case::{Case, Effort};
use crate::real::Real;
use crate::reference::Vector;
use crate::scenes::{constant, empty, of, placed, shining, unit_sphere};
use crate::tally::Tally;
use glam::{DMat3, DVec3, Vec3};
use spectrum::Samples;
use tracer::{Environment, EnvironmentImage, Mesh, Object, PointLight, Scene, Shape};

/// Half angles under which a light is seen, degrees.
const HALF_ANGLES: [f64; 9] = [1e-4, 1e-3, 1e-2, 0.27, 2.0, 10.0, 30.0, 60.0, 80.0];

/// Where the light is: nothing special about it.
const CENTRE: DVec3 = DVec3::new(0.3, 1.1, -0.7);

/// Emitters by the names of the tracer's variants; a test compares them with the source.
pub(super) fn cases() -> Vec<Case> {
    let angle = "the centre and radius in f32, squared, and 1 - cos by sin^2/(1 + cos)";
    vec![
        Case::new("light/Sphere/solid angle", 1e-4, angle, |_, t| {
            each_angle(t, |deg, t| {
                let r = deg.to_radians().sin();
                let (scene, p) = (seen(unit_sphere(), r), -DVec3::X);
                let exact = 2.0 * Real::pi() * (1.0 - (1.0 - Real::new(r).sqr()).sqrt());
                solid_angle(scene, p, exact.to_f64(), 1, t, &format!("{deg} deg"));
            });
        }),
        Case::new(
            "light/Rect/solid angle, both sides of the switch",
            3e-3,
            "f32 leaves the sum of four angles 3e-7 absolute: 1e-4 of 0.005 sr, below which the area is sampled; midpoints of 64 x 64 strata",
            |effort, t| {
                // half widths on both sides of 0.005 sr at unit distance: 0.0353
                let near = [0.034, 0.035, 0.0354, 0.036].map(|w: f64| w.atan().to_degrees());
                each_angle_of(HALF_ANGLES.into_iter().chain(near), t, |deg, t| {
                    let w = deg.to_radians().tan();
                    for aspect in [1.0, 0.01] {
                        rectangle(w, w * aspect, effort, t);
                    }
                });
            },
        ),
        Case::new(
            "light/Triangles/solid angle",
            3e-2,
            "midpoints of 256 x 256 strata of the area: at 80 degrees 1/r^3 varies 200-fold over the light",
            |_, t| {
                each_angle(t, |deg, t| {
                    let w = deg.to_radians().tan();
                    let corners = [[-w, -w], [w, -w], [-w, w]].map(|[x, y]| DVec3::new(x, y, 0.0));
                    let scene = seen(Shape::Mesh(triangle(w)), 1.0);
                    let exact = triangle_angle(corners, DVec3::Z);
                    solid_angle(scene, DVec3::Z, exact, 256, t, &format!("{deg} deg"));
                });
            },
        ),
        Case::new("light/Sphere/samples", 2e-3, SAMPLES, |_, t| {
            each_angle(t, |deg, t| {
                samples(
                    seen(unit_sphere(), deg.to_radians().sin()),
                    -DVec3::X,
                    t,
                    deg,
                );
            });
        }),
        Case::new("light/Rect/samples", 2e-3, SAMPLES, |_, t| {
            each_angle(t, |deg, t| {
                let w = deg.to_radians().tan();
                samples(seen(rect(w, w), 1.0), DVec3::Z, t, deg);
            });
        }),
        Case::new("light/Triangles/samples", 2e-3, SAMPLES, |_, t| {
            each_angle(t, |deg, t| {
                let w = deg.to_radians().tan();
                samples(seen(Shape::Mesh(triangle(w)), 1.0), DVec3::Z, t, deg);
            });
        }),
        Case::new(
            "light/Sphere, Rect and Triangles/scenes of 1e-6 to 1e6",
            2e-3,
            "the density is that of the scene of size 1; shifted by 1000 sizes, coordinates keep 6e-8 of a thousand",
            |_, t| sizes(t),
        ),
        Case::new(
            "light/Constant and Image/samples",
            2e-3,
            "an image of one bright pixel among 64 x 32, at the pole and at the horizon",
            |_, t| far_away(t),
        ),
        Case::new(
            "light/Point and Directional/direction",
            1e-6,
            "f32 positions and a normalisation; from 1e-15 to 1e15 away",
            |_, t| points(t),
        ),
    ]
}

/// Why samples and densities agree no better.
const SAMPLES: &str = "the density of a sample is that of its direction: distances and normals in f32; each sample meets its light";

fn each_angle(tally: &mut Tally, f: impl FnMut(f64, &mut Tally)) {
    each_angle_of(HALF_ANGLES.into_iter(), tally, f);
}

fn each_angle_of(
    angles: impl Iterator<Item = f64>,
    tally: &mut Tally,
    mut f: impl FnMut(f64, &mut Tally),
) {
    angles.for_each(|deg| f(deg, tally));
}

/// A scene of one light of this shape at [`CENTRE`].
fn seen(shape: Shape, scale: f64) -> Option<Scene<1>> {
    of(shining(placed(shape, scale, CENTRE), 1.0))
}

/// A rectangle about the origin, facing z.
fn rect(half_width: f64, half_height: f64) -> Shape {
    Shape::Quad {
        corner: DVec3::new(-half_width, -half_height, 0.0),
        edge_u: DVec3::new(2.0 * half_width, 0.0, 0.0),
        edge_v: DVec3::new(0.0, 2.0 * half_height, 0.0),
    }
}

/// Half of the square of half width `w` about the origin, facing z.
fn triangle(w: f64) -> Mesh {
    Mesh {
        positions: [[-w, -w], [w, -w], [-w, w]]
            .map(|[x, y]| DVec3::new(x, y, 0.0).as_vec3())
            .to_vec(),
        triangles: vec![[0, 1, 2]],
        normals: None,
    }
}

fn rectangle(w: f64, h: f64, effort: Effort, tally: &mut Tally) {
    let n = effort.pick(16, 64) as u32;
    for p in [DVec3::Z, DVec3::new(0.4 * w, 0.3 * h, 1.0)] {
        let [a, b, c, d] = [[-w, -h], [w, -h], [w, h], [-w, h]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let exact = triangle_angle([a, b, c], p) + triangle_angle([a, c, d], p);
        solid_angle(
            seen(rect(w, h), 1.0),
            p,
            exact,
            n,
            tally,
            &format!("{w} x {h}"),
        );
    }
}

/// Solid angle of a triangle from `p`, by the quotient of the triple product [VanOosterom1983].
fn triangle_angle(corners: [DVec3; 3], p: DVec3) -> f64 {
    let [a, b, c] = corners.map(|v| Vector::new(v).minus(&Vector::new(p)));
    let [la, lb, lc] = [&a, &b, &c].map(Vector::length);
    let over = &la * &lb * &lc + a.dot(&b) * &lc + a.dot(&c) * &lb + b.dot(&c) * &la;
    (2.0 * a.dot(&b.cross(&c)).abs().atan2(&over)).to_f64()
}

/// The mean of 1/pdf over the midpoints of n x n strata is the solid angle.
fn solid_angle(
    scene: Option<Scene<1>>,
    from: DVec3,
    exact: f64,
    n: u32,
    tally: &mut Tally,
    what: &str,
) {
    let Some(scene) = scene else {
        tally.error(f64::INFINITY, || format!("{what}: no scene"));
        return;
    };
    let p = (CENTRE + from).as_vec3();
    let mut sum = 0.0;
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let u = [i, j].map(|k| (k as f32 + 0.5) / n as f32);
        if let Some(s) = scene.toward_light(0, p, u) {
            sum += 1.0 / f64::from(s.pdf);
        }
    }
    tally.value(sum / f64::from(n * n), exact, 0.0, || what.to_owned());
}

/// The ends of u and the inside.
const US: [f32; 5] = [0.0, 1e-7, 0.4, 0.99, 1.0 - f32::EPSILON / 2.0];

/// Samples of light 0: finite, unit, their density that of their direction, and inside of the light.
fn samples(scene: Option<Scene<1>>, from: DVec3, tally: &mut Tally, deg: f64) {
    let Some(scene) = scene else {
        tally.error(f64::INFINITY, || format!("{deg} deg: no scene"));
        return;
    };
    let p = (CENTRE + from).as_vec3();
    for u in US.into_iter().flat_map(|a| US.map(|b| [a, b])) {
        let Some(s) = scene.toward_light(0, p, u) else {
            tally.error(f64::INFINITY, || "no such light".into());
            return;
        };
        let place = || format!("{deg} deg, u {u:?}, wi {}", s.wi);
        tally.sound(f64::from(s.pdf), || format!("pdf, {}", place()));
        tally.error(f64::from((s.wi.length() - 1.0).abs()), || {
            format!("length, {}", place())
        });
        // on the very rim rounding decides whether the light is met
        let inside = u.iter().all(|u| (0.01..0.985).contains(u));
        let pdf = scene.light_pdf(0, p, s.wi);
        if inside || pdf > 0.0 {
            tally.value(f64::from(s.pdf), f64::from(pdf), 0.0, || {
                format!("pdf again, {}", place())
            });
        }
    }
}

fn sizes(tally: &mut Tally) {
    let shapes = [
        ("Sphere", unit_sphere()),
        ("Rect", rect(0.3, 0.2)),
        ("Triangles", Shape::Mesh(triangle(0.3))),
    ];
    for (name, shape) in shapes {
        let density = |scale: f64, shift: f64, u: [f32; 2]| {
            let centre = CENTRE * scale + DVec3::new(1.0, -0.37, 0.81) * shift;
            let scene = of(shining(placed(shape.clone(), scale, centre), 1.0))?;
            let p = centre + DVec3::new(1.3, -0.4, 2.0) * scale;
            scene
                .toward_light(0, p.as_vec3(), u)
                .map(|s| f64::from(s.pdf))
        };
        for u in [[0.2, 0.7], [0.5, 0.5], [0.9, 0.1]] {
            let exact = density(1.0, 0.0, u).unwrap_or(f64::NAN);
            for (scale, shift) in [
                (1e-6, 0.0),
                (1e-3, 0.0),
                (1e3, 0.0),
                (1e6, 0.0),
                (1.0, 1e3),
                (1e3, 1e6),
            ] {
                let value = density(scale, shift, u).unwrap_or(f64::NAN);
                tally.value(value, exact, 0.0, || {
                    format!("{name}, scale {scale:e}, shift {shift:e}, u {u:?}")
                });
            }
        }
    }
}

fn far_away(tally: &mut Tally) {
    let mut environments = vec![(constant(1.0), "constant")];
    for (at, what) in [
        (0, "bright at the pole"),
        (16 * 64 + 63, "bright at the horizon"),
    ] {
        let mut pixels = vec![Samples([0.0_f32]); 64 * 32];
        pixels[at] = Samples([1e6]);
        let image = EnvironmentImage {
            width: 64,
            height: 32,
            pixels,
            to_world: DMat3::IDENTITY,
        };
        environments.push((Some(Environment::Image(image)), what));
    }
    for (environment, what) in environments {
        let scene = empty(0.5).and_then(|mut d| {
            d.environment = environment;
            Scene::new(d).ok()
        });
        let Some(scene) = scene else {
            tally.error(f64::INFINITY, || format!("{what}: no scene"));
            continue;
        };
        // a constant environment is left to the material, with no probability of its own
        if what != "constant" {
            samples(Some(scene), DVec3::ZERO, tally, 0.0);
        } else if let Some(s) = scene.toward_light(0, Vec3::ZERO, [0.3, 0.6]) {
            tally.error(f64::from((s.wi.length() - 1.0).abs()), || what.to_owned());
        }
    }
}

fn points(tally: &mut Tally) {
    for away in [1e-15, 1e-6, 1.0, 1e6, 1e15] {
        let to = DVec3::new(0.48, 0.6, -0.64);
        let lights = [
            PointLight::Point {
                position: to * away,
                intensity: Samples([1.0]),
            },
            PointLight::Directional {
                direction: -to * away,
                irradiance: Samples([1.0]),
            },
        ];
        for light in lights {
            let place = || format!("{light:?}");
            let scene = empty(0.5).and_then(|mut d| {
                d.objects.push(Object::new(rect(1.0, 1.0), 0));
                d.lights.push(light);
                Scene::new(d).ok()
            });
            match scene.and_then(|s| s.toward_light(0, Vec3::ZERO, [0.5, 0.5])) {
                Some(s) => {
                    tally.error(s.wi.as_dvec3().distance(to), place);
                    tally.value(f64::from(s.pdf), 1.0, 0.0, place);
                }
                None => tally.error(f64::INFINITY, place),
            }
        }
    }
}
