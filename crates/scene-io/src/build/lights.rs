//! Lights of a scene that are not surfaces.

use super::Places;
use crate::error::Error;
use crate::image::read_exr;
use crate::scene::{Colour, LightSpec, SceneFile, plain};
use glam::{DMat3, DVec3};
use spectrum::Samples;
use tracer::{Environment, EnvironmentImage, PointLight};

type Lights = (Vec<PointLight<Samples<3>>>, Option<Environment<Samples<3>>>);

pub(super) fn lights(file: &SceneFile, places: &Places) -> Result<Lights, Error> {
    let mut points = Vec::new();
    let mut environment = None;
    for (k, light) in file.lights.iter().enumerate() {
        match light {
            LightSpec::Point {
                position,
                intensity,
            } => points.push(PointLight::Point {
                position: DVec3::from(plain(*position)),
                intensity: samples(*intensity),
            }),
            LightSpec::Directional {
                direction,
                irradiance,
            } => points.push(PointLight::Directional {
                direction: DVec3::from(plain(*direction)),
                irradiance: samples(*irradiance),
            }),
            LightSpec::Constant { radiance } => {
                environment = Some(Environment::Constant(samples(*radiance)));
            }
            LightSpec::Image { .. } => {
                let image =
                    image(light, places).map_err(|e| e.in_field(&format!("lights[{k}]")))?;
                environment = image.map(Environment::Image);
            }
        }
    }
    Ok((points, environment))
}

fn samples(c: Colour) -> Samples<3> {
    Samples(c.0.map(|v| v as f32))
}

fn image(
    light: &LightSpec,
    places: &Places,
) -> Result<Option<EnvironmentImage<Samples<3>>>, Error> {
    let LightSpec::Image {
        path,
        scale,
        turn_deg,
        home,
    } = light
    else {
        return Ok(None);
    };
    let path = places.data.find(path, home)?;
    let picture = read_exr(&path)?;
    let factor = scale.map_or(1.0, |s| s.0 as f32);
    // Negative or undefined radiance has no meaning for a light.
    let radiance = |p: &[f32; 3]| Samples(p.map(|v| if v > 0.0 { v * factor } else { 0.0 }));
    let pixels: Vec<Samples<3>> = picture.pixels.iter().map(radiance).collect();
    if let Some(k) = pixels.iter().position(|p| !p.is_finite()) {
        let (x, y) = (k % picture.width, k / picture.width);
        let message =
            format!("expected finite radiance, found an infinite one at pixel ({x}, {y})");
        return Err(Error::invalid(message).in_file(&path));
    }
    let side = |n: usize| u32::try_from(n).map_err(|_| Error::invalid("image too large"));
    Ok(Some(EnvironmentImage {
        width: side(picture.width)?,
        height: side(picture.height)?,
        pixels,
        to_world: DMat3::from_rotation_y(turn_deg.map_or(0.0, |t| t.0.to_radians())),
    }))
}
