//! Scene files: RON text in, a checked description out. docs/scenes.md is the user's page.

mod check;
mod checked;
mod colour;
mod names;
mod parse;
mod resolve;
mod schema;
mod unique_map;

pub use checked::{
    Colour, Coordinate, Degrees, Depth, FieldOfView, Kelvin, MAX_COORDINATE, MAX_RADIANCE, Point,
    Positive, Radiometric, SampleCount, Segments, Side, Wavelength, Weight, plain,
};
pub use colour::{ColourChoice, FileScale, Primaries, White};
pub use names::{
    BeyondName, GamutName, GapName, InterpolationName, NegativeName, PointsName, SamplerName,
    SpectrumName,
};
pub use resolve::{CameraSpec, FilmSpec, RenderSpec, SceneFile};
pub use schema::{
    ExposureSpec, FileMaterial, FilterSpec, FormSpec, LightSpec, LightSpectrum, MaterialSpec,
    MixMaterial, ModelMaterial, ShapeSpec, TransformSpec,
};
