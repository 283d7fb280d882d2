//! Pictures on disk: EXR for numbers, PNG for eyes.

mod exr_read;
mod exr_write;
mod picture;
mod png;
mod spectral;
mod tone;

pub use exr_read::{read_exr, read_exr_bytes};
pub use exr_write::write_exr;
pub use picture::{Metadata, Picture};
pub use png::write_png;
pub use spectral::{SpectralPicture, read_spectral_exr, write_spectral_exr};
pub use tone::{ToneMap, to_srgb8};

/// Most pixels of an image that is read or written: 2^26.
pub const MAX_PIXELS: usize = 1 << 26;
