//! The only library that touches files: scenes, meshes, BRDF files, EXR and PNG, caches.
//!
//! Reads are bounded and refuse what is not a regular file ([`load`]); writes are atomic ([`write`]);
//! every error is one line that names the file, the place in it, what was expected and what was found.
//!
//! - [`SceneFile`] -> [`build_scene`] -> [`BuiltScene`]: RON scenes to what the tracer renders.
//! - [`material`]: measured files and models to materials.
//! - [`spectral`]: scenes and films in other channels than linear sRGB.
//! - [`image`], [`compare`]: EXR and PNG, and how far two pictures are apart.
//! - [`rows`]: error against run time, as a render goes on.
//! - [`converge`]: error against run time of several ways to render a scene.
//! - [`survey`]: how noisy, how fast and how right a sampler of a material is.
//! - [`checkpoint`], [`Cache`]: what gonio keeps for itself.
//!
//! No process-wide state, no environment variables: folders to search and to cache in are arguments.

pub mod checkpoint;
pub mod converge;
pub mod convert;
pub mod image;
pub mod load;
pub mod material;
pub mod mesh;
pub mod rows;
pub mod scene;
pub mod sealed;
pub mod spectral;
pub mod survey;
pub mod write;

mod build;
mod cache;
mod compare;
mod data_dirs;
mod error;
mod fingerprint;
mod overrides;

pub use build::{BuiltScene, MaterialReport, Places, build_any_scene, build_scene};
pub use cache::Cache;
pub use compare::{Metrics, ZStatistics, compare};
pub use data_dirs::DataDirs;
pub use error::{Error, ErrorKind};
pub use fingerprint::fingerprint;
pub use overrides::Overrides;
pub use scene::SceneFile;

/// The scene rendered when none is named: needs no file.
pub const DEFAULT_SCENE: &str = include_str!("../../../scenes/default/scene.ron");
