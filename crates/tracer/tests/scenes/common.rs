//! Materials and small scenes the tests share.

use brdf::{Brdf, DirectionSample, DirectionSampler, Material, Paired};
use glam::{DAffine3, DVec2, DVec3, Vec3};
use spectrum::Samples;
use std::f64::consts::PI;
use tracer::{
    Camera, Description, Environment, Film, LightSelection, Mesh, Object, Scene, Settings, Shape,
    render,
};

/// The same reflectance everywhere: albedo / pi.
pub(crate) struct Lambert(pub(crate) f64);

impl Brdf<1> for Lambert {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 1] {
        [if wi.z > 0.0 && wo.z > 0.0 {
            self.0 / PI
        } else {
            0.0
        }]
    }
}

/// A Lambert surface with a glossy lobe about the half vector.
pub(crate) struct Glossy;

impl Brdf<1> for Glossy {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 1] {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return [0.0];
        }
        [0.3 / PI + 0.8 * (wi + wo).normalize().z.powi(40)]
    }
}

/// A lobe of a few degrees about the half vector, nothing else.
pub(crate) struct Polished;

impl Brdf<1> for Polished {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 1] {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return [0.0];
        }
        [20.0 * (wi + wo).normalize().z.powi(400)]
    }
}

/// Directions in proportion to the cosine.
pub(crate) struct Cosine;

impl DirectionSampler for Cosine {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let (r, phi) = (u.x.sqrt(), 2.0 * PI * u.y);
        let wi = DVec3::new(r * phi.cos(), r * phi.sin(), (1.0 - u.x).max(0.0).sqrt());
        (wo.z > 0.0 && wi.z > 0.0).then_some(DirectionSample { wi, pdf: wi.z / PI })
    }
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z > 0.0 && wo.z > 0.0 {
            wi.z / PI
        } else {
            0.0
        }
    }
}

pub(crate) fn grey(albedo: f64) -> Box<dyn Material<1>> {
    Box::new(Paired {
        brdf: Lambert(albedo),
        sampler: Cosine,
    })
}

pub(crate) fn glossy() -> Box<dyn Material<1>> {
    Box::new(Paired {
        brdf: Glossy,
        sampler: Cosine,
    })
}

pub(crate) fn polished() -> Box<dyn Material<1>> {
    Box::new(Paired {
        brdf: Polished,
        sampler: Cosine,
    })
}

/// A scene of one camera and materials, to be filled.
pub(crate) fn empty(camera: Camera, materials: Vec<Box<dyn Material<1>>>) -> Description<1> {
    Description {
        camera,
        materials,
        objects: vec![],
        lights: vec![],
        environment: None,
        selection: LightSelection::Auto,
    }
}

pub(crate) fn camera(eye: [f64; 3], target: [f64; 3], fov: f64) -> Camera {
    Camera {
        eye: eye.into(),
        target: target.into(),
        up: DVec3::new(0.01, 1.0, 0.02),
        vertical_fov_deg: fov,
    }
}

pub(crate) fn sphere(center: [f64; 3], radius: f64) -> Shape {
    Shape::Sphere {
        center: center.into(),
        radius,
    }
}

pub(crate) fn quad(corner: [f64; 3], edge_u: [f64; 3], edge_v: [f64; 3]) -> Shape {
    Shape::Quad {
        corner: corner.into(),
        edge_u: edge_u.into(),
        edge_v: edge_v.into(),
    }
}

/// A horizontal square of half width `h` around (0, y, 0) facing up.
pub(crate) fn floor(y: f64, h: f64) -> Shape {
    quad([-h, y, h], [2.0 * h, 0.0, 0.0], [0.0, 0.0, -2.0 * h])
}

pub(crate) fn shining(shape: Shape, radiance: f32) -> Object<1> {
    Object {
        emission: Some(Samples([radiance])),
        ..Object::new(shape, 0)
    }
}

pub(crate) fn constant(radiance: f32) -> Option<Environment<Samples<1>>> {
    Some(Environment::Constant(Samples([radiance])))
}

/// A sphere around the origin of 2 x `columns` x `columns` / 2 triangles, some of them without area (at the poles).
pub(crate) fn ball(columns: u32, normals: bool) -> Mesh {
    let rows = columns / 2;
    let mut mesh = Mesh::default();
    for y in 0..=rows {
        for x in 0..columns {
            let theta = PI * f64::from(y) / f64::from(rows);
            let phi = 2.0 * PI * f64::from(x) / f64::from(columns);
            let p = DVec3::new(
                theta.sin() * phi.cos(),
                theta.cos(),
                -theta.sin() * phi.sin(),
            );
            let pole = y == 0 || y == rows;
            let p = if pole {
                DVec3::Y * theta.cos().signum()
            } else {
                p
            };
            mesh.positions.push(p.as_vec3());
        }
    }
    for y in 0..rows {
        for x in 0..columns {
            let (a, b) = (y * columns + x, y * columns + (x + 1) % columns);
            mesh.triangles.push([a, a + columns, b]);
            mesh.triangles.push([b, a + columns, b + columns]);
        }
    }
    mesh.normals = normals.then(|| mesh.positions.clone());
    mesh
}

/// Two triangles for a parallelogram.
pub(crate) fn two_triangles(corner: Vec3, u: Vec3, v: Vec3) -> Mesh {
    Mesh {
        positions: vec![corner, corner + u, corner + u + v, corner + v],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: None,
    }
}

/// `shape` placed by `transform` with material 0.
pub(crate) fn placed(shape: Shape, transform: DAffine3) -> Object<1> {
    Object {
        transform,
        ..Object::new(shape, 0)
    }
}

pub(crate) fn picture(description: Description<1>, size: [u32; 2], settings: &Settings) -> Film<1> {
    let scene = Scene::new(description).unwrap();
    let mut film = Film::new(size[0], size[1], 16);
    render(&scene, settings, &mut film, &()).unwrap();
    film
}

/// Mean of all pixels and its standard error, from the means of the replicates.
pub(crate) fn mean(film: &Film<1>) -> (f64, f64) {
    let replicates = film.replicates();
    let mut means = vec![0.0; replicates as usize];
    let mut counts = vec![0.0; replicates as usize];
    for tile in film.tiles() {
        for sums in tile.sums().chunks(replicates as usize) {
            for (r, sum) in (0..replicates).zip(sums) {
                means[r as usize] += sum[0];
                counts[r as usize] += f64::from(tile.samples_of(r));
            }
        }
    }
    let r = f64::from(replicates);
    let means: Vec<f64> = means.iter().zip(&counts).map(|(m, n)| m / n).collect();
    let mean = means.iter().sum::<f64>() / r;
    let variance = means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (r - 1.0) / r;
    (mean, variance.sqrt())
}

/// Renders a few pixels and compares their mean with `exact`.
///
/// With 15 degrees of freedom, 4.2 standard errors are passed by chance once in 1300 comparisons; the suite makes
/// about 40, with fixed seeds. The absolute part is the rounding of f32 along a path.
pub(crate) fn assert_radiance(
    description: Description<1>,
    settings: &Settings,
    exact: f64,
    what: &str,
) {
    let film = picture(description, [4, 4], settings);
    let (mean, error) = mean(&film);
    assert!(
        (mean - exact).abs() <= 4.2 * error + 3e-6 * exact.abs(),
        "{what}: {mean} +- {error}, exact {exact}"
    );
    // an error bar that is no test
    assert!(
        error < 0.02 * exact.abs() + 1e-9,
        "{what}: the error {error} of {exact} is too large to tell"
    );
}
