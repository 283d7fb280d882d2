//! Lights that are no shapes, on their way into a scene.

use crate::build::Builder;
use crate::light::{Emitter, Environment, ImageLight, Light, PointLight};
use crate::mode::{Emission, Mode};
use crate::path::NONE;
use crate::scene::SceneError;
use glam::DVec3;
use std::f64::consts::PI;

impl<const N: usize, S: Mode<N>> Builder<N, S> {
    /// Adds the lights without extent.
    pub(crate) fn point_lights(&mut self) -> Result<(), SceneError> {
        for (index, light) in self.description.lights.iter().enumerate() {
            let wrong = |reason| SceneError::Light {
                light: index,
                reason,
            };
            let (emitter, strength, power) = match light {
                PointLight::Point {
                    position,
                    intensity,
                } => {
                    let position = position.as_vec3();
                    if !position.is_finite() {
                        return Err(wrong("position must be finite"));
                    }
                    let power = 4.0 * PI * intensity.brightness();
                    (Emitter::Point(position), intensity, power)
                }
                PointLight::Directional {
                    direction,
                    irradiance,
                } => {
                    let toward = -direction.normalize_or_zero();
                    if toward == DVec3::ZERO {
                        return Err(wrong("direction must be finite and not zero"));
                    }
                    let radius = self.radius();
                    let power = PI * radius * radius * irradiance.brightness();
                    (Emitter::Directional(toward.as_vec3()), irradiance, power)
                }
            };
            if !strength.is_finite() {
                return Err(wrong("strength must be finite"));
            }
            self.powers.push(Some(power));
            self.lights.push(Light {
                emitter,
                strength: strength.clone(),
                prim: NONE,
            });
        }
        Ok(())
    }

    /// Adds the environment as the last light; its index.
    pub(crate) fn environment(&mut self) -> Result<Option<u32>, SceneError> {
        let (emitter, strength, power) = match self.description.environment.take() {
            None => return Ok(None),
            Some(Environment::Constant(radiance)) => {
                if !radiance.is_finite() {
                    return Err(SceneError::Environment("radiance must be finite"));
                }
                (Emitter::Constant, radiance, None)
            }
            Some(Environment::Image(image)) => {
                let count = image.width as usize * image.height as usize;
                if count == 0 || count != image.pixels.len() {
                    return Err(SceneError::Environment(
                        "pixels must be width x height, not none",
                    ));
                }
                if !image.pixels.iter().all(Emission::is_finite) {
                    return Err(SceneError::Environment("radiance must be finite"));
                }
                let total: f64 = image.pixels.iter().map(Emission::brightness).sum();
                let first = image.pixels[0].clone();
                match ImageLight::new(image) {
                    None => return Ok(None),
                    Some(light) => {
                        let power = self.environment_power(total / count as f64);
                        (Emitter::Image(light), first, Some(power))
                    }
                }
            }
        };
        let index = self.lights.len() as u32;
        self.powers.push(power);
        self.lights.push(Light {
            emitter,
            strength,
            prim: NONE,
        });
        Ok(Some(index))
    }

    /// What reaches the scene's bounding sphere.
    pub(crate) fn environment_power(&self, radiance: f64) -> f64 {
        let radius = self.radius();
        4.0 * PI * PI * radius * radius * radiance
    }
}
