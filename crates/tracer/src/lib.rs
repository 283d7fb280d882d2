//! Camera, shapes, lights, BVH, integrator and film; sees only the contract of crate `brdf`.

mod batch;
mod build;
mod bvh;
mod camera;
mod estimate;
mod film;
mod filter;
mod geometry;
mod kernel;
mod light;
mod math;
mod path;
mod plan;
mod render;
mod scene;
mod settings;
mod shape;
mod stats;
mod vertex;

pub use camera::Camera;
pub use estimate::Estimate;
pub use film::{Film, RestoreError, Tile};
pub use filter::PixelFilter;
pub use light::{Environment, EnvironmentImage, PointLight};
pub use plan::LeftOut;
pub use render::{Progress, RenderError, render};
pub use sampling::PointSet;
pub use scene::{Description, Object, Scene, SceneError};
pub use settings::{Settings, Strategy};
pub use shape::{Mesh, Shape};
pub use stats::{Stages, Stats};
