//! Rays that start on a surface leave it, and geometry without area does no harm.

use crate::common::{ball, camera, constant, empty, floor, grey, picture, placed, shining, sphere};
use glam::{DAffine3, DVec3, Vec3};
use tracer::{Mesh, Object, Scene, Settings, Shape};

fn settings() -> Settings {
    Settings {
        spp: 16,
        ..Settings::default()
    }
}

/// Every pixel sees a convex body of albedo 1 in a furnace: each path must leave it at its first bounce.
fn leaves(object: Object<1>, eye: DVec3, target: DVec3, what: &str) {
    let mut d = empty(
        camera(eye.to_array(), target.to_array(), 5.0),
        vec![grey(1.0)],
    );
    d.objects.push(object);
    d.environment = constant(1.0);
    let settings = Settings {
        max_depth: 1,
        ..settings()
    };
    let film = picture(d, [16, 16], &settings);
    for [value] in film.mean() {
        assert!((value - 1.0).abs() < 1e-5, "{what}: {value}");
    }
}

#[test]
fn no_ray_meets_the_surface_it_leaves() {
    for (offset, radius) in [
        (0.0, 1.0),
        (1000.0, 1.0),
        (0.0, 1e-6),
        (-77.0, 0.01),
        (3.0, 1e6),
    ] {
        let at = DVec3::new(offset, 0.5 * offset, -offset);
        let eye = at + DVec3::new(0.3, 0.9, 0.4) * (5.0 * radius);
        let moved = DAffine3::from_translation(at) * DAffine3::from_scale(DVec3::splat(radius));
        let what = format!("radius {radius} at {offset}");
        leaves(placed(sphere([0.0; 3], 1.0), moved), eye, at, &what);
        leaves(placed(floor(0.0, 1.0), moved), eye, at, &what);
        leaves(placed(Shape::Mesh(ball(32, false)), moved), eye, at, &what);
    }
}

#[test]
fn no_light_leaks_out_of_a_closed_ball() {
    // the camera and a light sit inside of a sphere (or a ball of triangles); outside everything shines brightly
    for shape in [
        sphere([0.0; 3], 1.0),
        Shape::Mesh(ball(32, false)),
        Shape::Mesh(ball(32, true)),
    ] {
        let mut d = empty(
            camera([0.1, 0.2, 0.0], [0.0, 0.0, 1.0], 90.0),
            vec![grey(0.5)],
        );
        d.objects.push(Object::new(shape, 0));
        d.objects.push(shining(sphere([0.0, -0.5, 0.0], 0.1), 1.0));
        d.environment = constant(1e6);
        let film = picture(d, [16, 16], &settings());
        for [value] in film.mean() {
            assert!(value > 0.0 && value < 10.0, "{value}");
        }
    }
}

#[test]
fn touching_shapes_do_not_shade_each_other_wrongly() {
    // a sphere that stands on the floor in a furnace of albedo 1: all paths come out, up to the depth limit
    let mut d = empty(
        camera([0.0, 1.0, 6.0], [0.0, 0.3, 0.0], 20.0),
        vec![grey(1.0)],
    );
    d.objects.push(Object::new(sphere([0.0, 1.0, 0.0], 1.0), 0));
    d.objects.push(Object::new(floor(0.0, 10.0), 0));
    d.environment = constant(1.0);
    let settings = Settings {
        max_depth: 200,
        ..settings()
    };
    for [value] in picture(d, [16, 16], &settings).mean() {
        assert!((value - 1.0).abs() < 1e-4, "{value}");
    }
}

#[test]
fn triangles_without_area_are_left_out() {
    let mut mesh = ball(16, false);
    let proper = mesh.triangles.len();
    let p = mesh.positions.len() as u32;
    mesh.positions
        .extend([Vec3::X * 1.2, Vec3::X * 1.3, Vec3::X * 1.4]);
    mesh.triangles
        .extend([[p, p + 1, p + 2], [p, p, p], [0, 1, 1]]);
    // the ball itself has a row of them at each pole
    let at_poles = 2 * 16;
    // and a thousand in the same place
    mesh.triangles.extend(vec![[20, 40, 60]; 1000]);
    let mut d = empty(
        camera([0.0, 0.0, 5.0], [0.0, 0.0, 0.0], 40.0),
        vec![grey(0.5)],
    );
    d.objects.push(Object::new(Shape::Mesh(mesh), 0));
    d.environment = constant(1.0);
    let scene = Scene::new(empty_like(&d)).unwrap();
    assert_eq!(scene.degenerate_triangles(), at_poles + 3);
    assert_eq!(scene.triangles(), proper - at_poles + 1000);
    let film = picture(d, [16, 16], &settings());
    assert!(
        film.mean().iter().all(|[v]| v.is_finite() && *v >= 0.0),
        "finite everywhere"
    );
}

/// The same scene again: descriptions hold boxes and can't be cloned.
fn empty_like(d: &tracer::Description<1>) -> tracer::Description<1> {
    let mut copy = empty(d.camera, vec![grey(0.5)]);
    copy.objects = d.objects.clone();
    copy.environment = d.environment.clone();
    copy
}

#[test]
fn an_empty_scene_is_its_environment() {
    let mut d = empty(camera([0.0; 3], [0.0, 0.0, 1.0], 40.0), vec![]);
    d.objects.push(Object::new(Shape::Mesh(Mesh::default()), 0));
    d.materials.push(grey(0.5));
    d.environment = constant(2.0);
    let film = picture(d, [3, 2], &settings());
    assert!(film.mean().iter().all(|[v]| (v - 2.0).abs() < 1e-9), "sky");
    let estimate = film.estimate(0.95);
    assert!(estimate.rel_rmse.abs() == 0.0, "known without error");
}
