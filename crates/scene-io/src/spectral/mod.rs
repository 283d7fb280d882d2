//! Rendering in more channels than three, or in wavelengths that differ from path to path.
//!
//! - [`Channels`]: what the channels of a render mean; from reflectances and lights to channels and back to colour.
//! - [`AnyScene`], [`AnyFilm`]: a scene and its film in whichever mode was asked for.
//! - [`study`], [`difference`]: one scene in every mode, and how far apart the colours are.
//! - `palette`: how the parts of a scene file become what the renderer of a mode holds.
//! - `surface`: any material in its own bands.

mod any;
mod channels;
mod difference;
mod hero;
mod light;
mod palette;
mod sheet;
mod study;
mod surface;

pub use any::{AnyFilm, AnyScene};
pub(crate) use any::{build, lights as scene_lights};
pub use channels::Channels;
pub use difference::{ColourDifference, Look, difference};
pub(crate) use light::{check as check_light, reflectance};
pub(crate) use palette::{FromScene, Palette, RgbPalette};
pub use sheet::write_sheet;
pub use study::{ModeResult, Study, finest, study};
