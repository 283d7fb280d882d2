//! Scene files: RON text in, a checked description out. docs/scenes.md is the user's page.

mod check;
mod checked;
mod names;
mod parse;
mod resolve;
mod schema;
mod unique_map;

pub use checked::{
    Colour, Coordinate, Degrees, Depth, FieldOfView, MAX_COORDINATE, MAX_RADIANCE, Point, Positive,
    Radiometric, SampleCount, Segments, Side, Weight, plain,
};
pub use names::{BeyondName, GapName, InterpolationName, NegativeName, PointsName, SamplerName};
pub use resolve::{CameraSpec, FilmSpec, RenderSpec, SceneFile};
pub use schema::{
    ExposureSpec, FileMaterial, FilterSpec, FormSpec, LightSpec, MaterialSpec, MixMaterial,
    ModelMaterial, ShapeSpec, TransformSpec,
};
