//! Files in and out, good and bad.

mod files;
mod malformed_files;
mod malformed_scenes;
mod pictures;
mod rendered;
mod scenes;
