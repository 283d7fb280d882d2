//! What the tests run over: every example of every model.

use brdf::direction;
use brdf_models::{MODELS, ModelInfo, ParsedModel, parse_model};
use glam::{DVec2, DVec3};
use testkit::Rng;

/// Viewer elevations that exercise the pole, the middle and grazing, degrees.
pub(crate) const VIEWERS_DEG: [f64; 4] = [0.0, 35.0, 70.0, 88.0];

/// A viewer off the axes, so that nothing hides in a symmetry.
pub(crate) fn viewer(theta_deg: f64) -> DVec3 {
    direction(theta_deg.to_radians(), 0.7)
}

/// Every example of every model, parsed.
pub(crate) fn all() -> impl Iterator<Item = ParsedModel<3>> {
    MODELS.iter().flat_map(examples)
}

/// The examples of one model, parsed.
pub(crate) fn examples(info: &'static ModelInfo) -> impl Iterator<Item = ParsedModel<3>> {
    info.examples
        .iter()
        .map(|text| parse_model(&format!("{}:{text}", info.name)).expect("examples are valid"))
}

/// The next two random numbers.
pub(crate) fn pair(rng: &mut Rng) -> DVec2 {
    DVec2::new(rng.uniform(), rng.uniform())
}

/// A direction above the horizon, uniform in solid angle or close to the horizon.
pub(crate) fn random_direction(rng: &mut Rng) -> DVec3 {
    let z = rng.uniform();
    // every fourth one within a degree or so of the horizon
    let z = if rng.uniform() < 0.25 { 0.02 * z } else { z };
    let phi = std::f64::consts::TAU * rng.uniform();
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * phi.cos(), r * phi.sin(), z)
}
