//! Files in and out, good and bad.

#![expect(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]
#![expect(clippy::float_cmp, reason = "files keep every bit")]

mod colour_conformance;
mod file_colour;
mod files;
mod malformed_files;
mod malformed_scenes;
mod measured;
mod pictures;
mod real_files;
mod rendered;
mod scenes;
mod spectral;
