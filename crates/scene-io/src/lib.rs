//! The only library that touches files: scenes, meshes, BRDF files, EXR and PNG, caches.
//!
//! Reads are bounded and refuse what is not a regular file ([`load`]); writes are atomic ([`write`]);
//! every error is one line that names the file, the place in it, what was expected and what was found.
//!
//! No process-wide state, no environment variables: folders to search and to cache in are arguments.

pub mod image;
pub mod load;
pub mod mesh;
pub mod scene;
pub mod sealed;
pub mod write;

mod compare;
mod data_dirs;
mod error;

pub use compare::{Metrics, ZStatistics, compare};
pub use data_dirs::DataDirs;
pub use error::{Error, ErrorKind};
pub use scene::SceneFile;
