//! From a file or a model to what a renderer holds.
//!
//! [`load_measured`] gives a file's reflectance in its own channels; [`surface`](Surface) brings any material to
//! linear sRGB, on a grid where that is faster; [`Surface::material`] chooses the concrete pair of reflectance and
//! sampler, so that everything below the one virtual call of a packet stream is compiled for that pair.

mod colour;
mod identity;
mod loaded;
mod measured_file;
mod measured_model;
mod native;
mod options;
mod pair;
mod scattered;
mod surface;

pub use colour::{ColourMeaning, Source};
pub use identity::Identity;
pub use loaded::{Detail, LoadedMeasured};
pub(crate) use measured_file::measured_from_bytes;
pub use measured_file::{identify, is_measured, load_measured};
pub use options::MaterialOptions;
pub use pair::SamplerReport;
pub(crate) use pair::{Visitor, luminance};
pub use surface::Surface;
pub(crate) use surface::SurfaceForm;

use crate::cache::Cache;
use crate::error::Error;
use brdf::Material;

/// The material of a measured file in linear sRGB, and the sampler chosen for it.
///
/// # Errors
/// If the sampler asked for does not go with the file, or its channels cannot be converted.
pub fn material_rgb(
    loaded: &LoadedMeasured,
    options: &MaterialOptions,
    cache: &Cache,
) -> Result<(Box<dyn Material<3>>, SamplerReport), Error> {
    Surface::of_file(loaded, options, cache)?.material(options.sampler, cache)
}
