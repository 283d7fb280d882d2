//! Camera, shapes, lights, BVH, integrator and film; sees only the contract of crate `brdf`.
//!
//! A [`Description`] (camera, materials, objects, lights, environment) becomes a [`Scene`]; [`render`] adds samples of
//! it to a [`Film`]; [`Film::estimate`] gives the picture and the error it knows of itself.
//!
//! Goals: path tracing with next-event estimation and multiple importance sampling, over streams of paths, so that
//! materials are asked for hundreds of directions by one call; the same bits for the same seed, whatever the threads
//! and interruptions; scenes of any size, from a millionth to a million.
//! Channels: fixed ones, whatever they mean, or hero wavelengths that differ from path to path ([`Mode`]).
//! Simplifications: surfaces reflect and do not transmit; emitters shine on their front; environments are constant over
//! a pixel of their picture; analytic shapes are tested one after the other, which serves some tens of them.
//! Not here: files, formats, colour spaces, particular reflectances. Space is the caller's: lengths have no unit, y is
//! up for environments alone.

mod batch;
mod build;
mod build_lights;
mod bvh;
mod camera;
mod cast;
mod choose;
mod estimate;
mod film;
mod filter;
mod geometry;
mod interval;
mod kernel;
mod light;
mod math;
mod mode;
mod path;
mod plan;
mod probe;
mod render;
mod ris;
mod scene;
mod settings;
mod shape;
mod stats;
mod stopping;
mod vertex;
mod workspace;

pub use camera::Camera;
pub use cast::{Ray, RayHit};
pub use choose::{Trial, choose_strategy};
pub use estimate::{Estimate, Moments};
pub use film::{Film, RestoreError, Tile};
pub use filter::PixelFilter;
pub use light::{Environment, EnvironmentImage, LightSelection, MANY, PointLight};
pub use mode::{Develop, Emission, Fixed, Hero, HeroEmission, Mode};
pub use plan::LeftOut;
pub use probe::{Meeting, TowardLight};
pub use render::{Progress, RenderError, render};
pub use sampling::PointSet;
pub use scene::{Description, Object, Scene, SceneBytes, SceneError};
pub use settings::{Settings, Shard, Strategy};
pub use shape::{Mesh, Shape};
pub use stats::{Stages, Stats};
pub use stopping::{Choice, Target, next_spp};
