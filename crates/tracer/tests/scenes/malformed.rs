//! Descriptions that can't be rendered say why.

use crate::common::{ball, camera, constant, empty, floor, grey, quad, sphere};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use spectrum::Samples;
use tracer::{Description, Environment, EnvironmentImage, Object, PointLight, Scene, Shape};

fn message(change: impl FnOnce(&mut Description<1>)) -> String {
    let mut d = empty(camera([0.0, 0.0, 5.0], [0.0; 3], 40.0), vec![grey(0.5)]);
    d.objects.push(Object::new(floor(0.0, 1.0), 0));
    d.environment = constant(1.0);
    change(&mut d);
    Scene::new(d).map_or_else(|e| e.to_string(), |_| "accepted".into())
}

fn object(shape: Shape) -> String {
    message(|d| d.objects.push(Object::new(shape, 0)))
}

#[test]
fn cameras() {
    let say = |eye, target, fov| message(|d| d.camera = camera(eye, target, fov));
    assert!(say([0.0; 3], [0.0; 3], 40.0).contains("eye and target must differ"));
    assert!(say([0.0; 3], [0.01, 1.0, 0.02], 40.0).contains("up must not lie"));
    assert!(say([0.0; 3], [1.0; 3], 180.0).contains("(0, 180)"));
    assert!(say([f64::NAN; 3], [1.0; 3], 40.0).contains("finite"));
}

#[test]
fn objects() {
    assert!(message(|d| d.objects[0].material = 3).contains("object 0: material 3 of 1"));
    assert!(message(|d| d.objects[0].emission = Some(Samples([f32::NAN]))).contains("emission"));
    assert!(
        message(|d| d.objects[0].transform = DAffine3::from_scale(DVec3::NAN))
            .contains("transform")
    );
    assert!(object(sphere([0.0; 3], -1.0)).contains("object 1: radius must be positive"));
    assert!(object(sphere([0.0; 3], 1e300)).contains("finite in single precision"));
    assert!(object(quad([0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0])).contains("span an area"));
    let stretched = message(|d| {
        let mut o = Object::new(sphere([0.0; 3], 1.0), 0);
        o.transform = DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0));
        d.objects.push(o);
    });
    assert!(stretched.contains("uniform scale"), "{stretched}");
}

#[test]
fn meshes() {
    let with = |change: fn(&mut tracer::Mesh)| {
        let mut mesh = ball(8, true);
        change(&mut mesh);
        object(Shape::Mesh(mesh))
    };
    assert!(with(|m| m.triangles.push([0, 1, 999])).contains("index 999 of 40 positions"));
    assert!(with(|m| m.positions[3] = Vec3::NAN).contains("positions must be finite"));
    assert!(with(|m| m.normals = Some(vec![Vec3::Z])).contains("1 normals for 40 positions"));
    assert_eq!(
        with(|m| m.normals = Some(vec![Vec3::NAN; 40])),
        "accepted",
        "shaded by the plane instead"
    );
}

#[test]
fn lights() {
    let sun = |direction| {
        message(|d| {
            d.lights.push(PointLight::Directional {
                direction,
                irradiance: Samples([1.0]),
            });
        })
    };
    assert!(sun(DVec3::ZERO).contains("light 0: direction must be finite and not zero"));
    let image = |width, pixels| {
        message(|d| {
            d.environment = Some(Environment::Image(EnvironmentImage {
                width,
                height: 1,
                pixels,
                to_world: DMat3::IDENTITY,
            }));
        })
    };
    assert!(image(2, vec![Samples([1.0])]).contains("width x height"));
    assert!(image(0, vec![]).contains("width x height"));
    assert!(image(1, vec![Samples([f32::INFINITY])]).contains("finite"));
    assert_eq!(
        image(1, vec![Samples([0.0])]),
        "accepted",
        "a dark picture is none"
    );
}
