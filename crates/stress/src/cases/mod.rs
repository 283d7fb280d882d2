//! The list of all cases.

mod angles;
mod colour;
mod fresnel;
mod lights;
mod models;
mod pictures;
mod quantiles;
mod rgl;
mod samplers;
mod shapes;
mod tables;
mod warps;

use crate::case::Case;

/// Every case, group by group.
#[must_use]
pub fn cases() -> Vec<Case> {
    [
        angles::cases(),
        fresnel::cases(),
        models::cases(),
        tables::cases(),
        samplers::cases(),
        warps::cases(),
        lights::cases(),
        shapes::cases(),
        pictures::cases(),
        colour::cases(),
        quantiles::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
