//! A floor and a ball under one light, in any channels.

#[path = "../shared/cosine.rs"]
mod cosine;

use brdf::{LANES, Lanes3, Material, Paired, Tag, TaggedBrdf};
use cosine::Cosine;
use glam::DVec3;
use std::f64::consts::PI;
use tracer::{
    Camera, Description, Develop, Film, LightSelection, Object, PointLight, Scene, Settings, Shape,
    render,
};

/// Albedo 0.6.
struct Lambert;

impl<const N: usize, T: Tag> TaggedBrdf<N, T> for Lambert {
    fn eval_tagged(&self, wi: &Lanes3, wo: &Lanes3, _: &[T; LANES]) -> [[f32; LANES]; N] {
        let one = |k: usize| {
            let up = wi.z[k] > 0.0 && wo.z[k] > 0.0;
            if up { (0.6 / PI) as f32 } else { 0.0 }
        };
        [std::array::from_fn(one); N]
    }
}

/// Renders it under a light of this intensity; the relative RMSE.
pub(crate) fn relative_error<const N: usize, const M: usize, S: Develop<N, M>>(
    mode: S,
    intensity: S::Emission,
) -> f64 {
    let material: Box<dyn Material<N, S::Tag>> = Box::new(Paired {
        brdf: Lambert,
        sampler: Cosine,
    });
    let floor = Shape::Quad {
        corner: DVec3::new(-12.0, 0.0, 12.0),
        edge_u: DVec3::X * 24.0,
        edge_v: DVec3::Z * -24.0,
    };
    let ball = Shape::Sphere {
        center: DVec3::Y,
        radius: 1.0,
    };
    let light = PointLight::Point {
        position: DVec3::new(3.0, 5.0, 4.0),
        intensity,
    };
    let description = Description {
        camera: Camera {
            eye: DVec3::new(9.0, 7.0, 0.5),
            target: DVec3::ZERO,
            up: DVec3::Y,
            vertical_fov_deg: 50.0,
        },
        materials: vec![material],
        objects: vec![Object::new(floor, 0), Object::new(ball, 0)],
        lights: vec![light],
        environment: None,
        selection: LightSelection::default(),
    };
    let scene = Scene::with_mode(mode, description).unwrap();
    let mut film = Film::new(160, 120, 8);
    render(&scene, &Settings::default(), &mut film, &()).unwrap();
    film.estimate(0.95).rel_rmse
}
