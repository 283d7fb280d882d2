//! The list of all cases.

mod angles;
mod colour;
mod fresnel;
mod lights;
mod maps;
mod models;
mod pictures;
mod quantiles;
mod rgl;
mod samplers;
mod shapes;
mod switches;
mod tables;
mod warps;

pub(crate) use pictures::SETTINGS;

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
        maps::cases(),
        lights::cases(),
        shapes::cases(),
        pictures::cases(),
        colour::cases(),
        quantiles::cases(),
        switches::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
