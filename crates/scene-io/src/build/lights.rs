//! Lights of a scene that are not surfaces.

use super::Places;
use crate::error::Error;
use crate::image::read_exr;
use crate::scene::{LightSpec, SceneFile, plain};
use crate::spectral::Palette;
use glam::{DMat3, DVec3};
use tracer::{Environment, EnvironmentImage, Mode, PointLight};

type Lights<E> = (Vec<PointLight<E>>, Option<Environment<E>>);

pub(super) fn lights<const N: usize, P: Palette<N>>(
    file: &SceneFile,
    places: &Places,
    palette: &P,
) -> Result<Lights<<P::Mode as Mode<N>>::Emission>, Error> {
    let mut points = Vec::new();
    let mut environment = None;
    for (k, light) in file.lights.iter().enumerate() {
        let in_light = |e: Error| e.in_field(&format!("lights[{k}]"));
        match light {
            LightSpec::Point {
                position,
                intensity,
                spectrum,
            } => points.push(PointLight::Point {
                position: DVec3::from(plain(*position)),
                intensity: palette
                    .light(*intensity, spectrum.as_ref())
                    .map_err(in_light)?,
            }),
            LightSpec::Directional {
                direction,
                irradiance,
                spectrum,
            } => points.push(PointLight::Directional {
                direction: DVec3::from(plain(*direction)),
                irradiance: palette
                    .light(*irradiance, spectrum.as_ref())
                    .map_err(in_light)?,
            }),
            LightSpec::Constant { radiance, spectrum } => {
                let radiance = palette.light(*radiance, spectrum.as_ref());
                environment = Some(Environment::Constant(radiance.map_err(in_light)?));
            }
            LightSpec::Image { .. } => {
                let image = image(light, places, palette).map_err(in_light)?;
                environment = image.map(Environment::Image);
            }
        }
    }
    Ok((points, environment))
}

fn image<const N: usize, P: Palette<N>>(
    light: &LightSpec,
    places: &Places,
    palette: &P,
) -> Result<Option<EnvironmentImage<<P::Mode as Mode<N>>::Emission>>, Error> {
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
    let radiance = |p: &[f32; 3]| p.map(|v| if v > 0.0 { v * factor } else { 0.0 });
    let pixels: Vec<[f32; 3]> = picture.pixels.iter().map(radiance).collect();
    let finite = |p: &[f32; 3]| p.iter().all(|v| v.is_finite());
    if let Some(k) = pixels.iter().position(|p| !finite(p)) {
        let (x, y) = (k % picture.width, k / picture.width);
        let message =
            format!("expected finite radiance, found an infinite one at pixel ({x}, {y})");
        return Err(Error::invalid(message).in_file(&path));
    }
    let side = |n: usize| u32::try_from(n).map_err(|_| Error::invalid("image too large"));
    Ok(Some(EnvironmentImage {
        width: side(picture.width)?,
        height: side(picture.height)?,
        pixels: pixels.into_iter().map(|p| palette.pixel(p)).collect(),
        to_world: DMat3::from_rotation_y(turn_deg.map_or(0.0, |t| t.0.to_radians())),
    }))
}
