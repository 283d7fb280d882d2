//! Small scenes for lights and shapes.

use brdf::Material;
use brdf_models::parse_model_n;
use glam::{DAffine3, DVec3, Vec3};
use sampling::{Rng, warp};
use spectrum::Samples;
use tracer::{Camera, Description, Environment, LightSelection, Mesh, Object, Scene, Shape};

/// A Lambert surface; none only if the registry had no such model.
pub(crate) fn lambert(albedo: f64) -> Option<Box<dyn Material<1>>> {
    let model = parse_model_n::<1>(&format!("lambert:kd={albedo}")).ok()?;
    Some(model.built.material)
}

/// A scene of one camera and white surfaces.
pub(crate) fn empty(albedo: f64) -> Option<Description<1>> {
    Some(Description {
        camera: Camera {
            eye: DVec3::new(0.0, 3.0, 0.0),
            target: DVec3::ZERO,
            up: DVec3::X,
            vertical_fov_deg: 20.0,
        },
        materials: vec![lambert(albedo)?],
        objects: vec![],
        lights: vec![],
        environment: None,
        selection: LightSelection::Auto,
    })
}

/// A scene of one object.
pub(crate) fn of(object: Object<1>) -> Option<Scene<1>> {
    let mut description = empty(0.5)?;
    description.objects.push(object);
    Scene::new(description).ok()
}

/// `shape` moved, scaled first.
pub(crate) fn placed(shape: Shape, scale: f64, shift: DVec3) -> Object<1> {
    Object {
        transform: DAffine3::from_translation(shift) * DAffine3::from_scale(DVec3::splat(scale)),
        ..Object::new(shape, 0)
    }
}

pub(crate) fn shining(object: Object<1>, radiance: f32) -> Object<1> {
    Object {
        emission: Some(Samples([radiance])),
        ..object
    }
}

pub(crate) fn constant(radiance: f32) -> Option<Environment<Samples<1>>> {
    Some(Environment::Constant(Samples([radiance])))
}

/// The square [-h, h]^2 at y = 0, facing up.
pub(crate) fn floor(h: f64) -> Shape {
    Shape::Quad {
        corner: DVec3::new(-h, 0.0, h),
        edge_u: DVec3::new(2.0 * h, 0.0, 0.0),
        edge_v: DVec3::new(0.0, 0.0, -2.0 * h),
    }
}

pub(crate) fn unit_sphere() -> Shape {
    Shape::Sphere {
        center: DVec3::ZERO,
        radius: 1.0,
    }
}

/// A convex ball of 2 n (n - 1) triangles whose corners lie on the unit sphere.
pub(crate) fn ball(n: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let columns = 2 * n;
    mesh.positions.push(Vec3::Y);
    for row in 1..n {
        for column in 0..columns {
            let theta = std::f64::consts::PI * f64::from(row) / f64::from(n);
            let phi = std::f64::consts::TAU * f64::from(column) / f64::from(columns);
            let p = DVec3::new(
                theta.sin() * phi.cos(),
                theta.cos(),
                -theta.sin() * phi.sin(),
            );
            mesh.positions.push(p.as_vec3());
        }
    }
    mesh.positions.push(-Vec3::Y);
    let at = |row: u32, column: u32| 1 + (row - 1) * columns + column % columns;
    let south = mesh.positions.len() as u32 - 1;
    for c in 0..columns {
        mesh.triangles.push([0, at(1, c), at(1, c + 1)]);
        mesh.triangles.push([south, at(n - 1, c + 1), at(n - 1, c)]);
        for row in 1..n - 1 {
            let [a, b] = [at(row, c), at(row, c + 1)];
            let [d, e] = [at(row + 1, c), at(row + 1, c + 1)];
            mesh.triangles.extend([[a, d, b], [b, d, e]]);
        }
    }
    mesh
}

/// A direction even over the sphere.
pub(crate) fn anywhere(rng: &mut Rng) -> DVec3 {
    warp::uniform_sphere(rng.uniform2())
}
