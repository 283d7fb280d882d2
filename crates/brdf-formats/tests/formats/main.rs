//! Tests of the public interface: real files, broken files, round trips, and the registry.
#![expect(clippy::unwrap_used, reason = "a failed helper fails its test")]
#![expect(clippy::float_cmp, reason = "files are read and written exactly")]

mod fixtures;
mod malformed;
mod malformed_merl;
mod malformed_tensor;
mod malformed_text;
mod memory;
mod real_files;
mod registry;
mod round_trip;
