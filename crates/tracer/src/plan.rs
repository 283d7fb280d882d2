//! What a render leaves out because its scene does not need it.

use crate::filter::PixelFilter;
use crate::mode::Mode;
use crate::scene::Scene;
use crate::settings::{Settings, Strategy};
use std::fmt;

/// Work that is not done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LeftOut {
    /// No triangles: no tree is built or walked.
    Triangles,
    /// No shading normals: no test whether light leaks through a surface.
    ShadingNormals,
    /// No environment: rays that leave the scene end at once.
    Environment,
    /// Vertices ask no light: no points on lights, no evaluations, no shadow rays.
    Lights,
    /// One light to ask: no choice, one dimension of the points less.
    LightChoice,
    /// Few lights: they are chosen by power, no tree is built or walked.
    LightTree,
    /// No roulette: no chance drawn, no path ended by it.
    Roulette,
    /// Even pixels: no table of filter quantiles.
    Filter,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = match self {
            Self::Triangles => "triangles: no tree is built or walked",
            Self::ShadingNormals => "shading normals: no test for leaking light",
            Self::Environment => "environment: rays that leave the scene end at once",
            Self::Lights => "asking lights: no evaluations for them, no shadow rays",
            Self::LightChoice => "choice of a light: one dimension of the points less",
            Self::LightTree => "light tree: with few lights each vertex chooses by power",
            Self::Roulette => "roulette: no path ends by chance",
            Self::Filter => "pixel filter: samples are even over the pixel",
        };
        write!(f, "{what} (with it {:.2} times the time)", self.cost())
    }
}

impl LeftOut {
    /// What the time of a path of the benchmark scene would be multiplied by, were it there: measured by
    /// `cargo xtask savings` (docs/performance.md).
    #[must_use]
    pub fn cost(self) -> f64 {
        match self {
            Self::Triangles => 1.16,
            Self::ShadingNormals | Self::Roulette => 1.0,
            Self::Environment => 1.14,
            Self::Lights => 1.45,
            Self::LightChoice => 1.83,
            Self::LightTree => 1.99,
            Self::Filter => 1.07,
        }
    }
}

impl<const N: usize, S: Mode<N>> Scene<N, S> {
    /// What [`crate::render`] does without for this scene and these settings.
    #[must_use]
    pub fn left_out(&self, settings: &Settings) -> Vec<LeftOut> {
        let lights = match settings.strategy {
            Strategy::LightOnly => &self.all_lights,
            Strategy::Mis | Strategy::Ris | Strategy::BsdfOnly => &self.lights,
        };
        let asked = settings.strategy != Strategy::BsdfOnly && lights.any();
        let all = [
            (LeftOut::Triangles, self.geometry.bvh.is_none()),
            (LeftOut::ShadingNormals, !self.smooth),
            (LeftOut::Environment, self.environment.is_none()),
            (LeftOut::Lights, !asked),
            (LeftOut::LightChoice, asked && !lights.several()),
            (LeftOut::LightTree, asked && !lights.by_tree()),
            (LeftOut::Roulette, settings.roulette.is_none()),
            (LeftOut::Filter, settings.filter == PixelFilter::Box),
        ];
        all.iter()
            .filter(|(_, out)| *out)
            .map(|(what, _)| *what)
            .collect()
    }
}
