//! What a scene file may say: the RON schema, documented for users in docs/scenes.md.
//!
//! These structs belong to files alone; nothing below this crate knows them.

use super::checked::{
    Colour, Coordinate, Degrees, Depth, FieldOfView, Kelvin, Point, Positive, Radiometric,
    SampleCount, Segments, Side, Wavelength, Weight,
};
use super::colour::ColourChoice;
use super::names::{
    BeyondName, GamutName, GapName, InterpolationName, NegativeName, PointsName, SamplerName,
    SpectrumName,
};
use super::unique_map::UniqueMap;
use serde::Deserialize;
use std::path::PathBuf;

/// One scene file, before it is laid over its base.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename = "Scene", deny_unknown_fields, default)]
pub(crate) struct SceneDoc {
    pub about: Option<String>,
    pub base: Option<PathBuf>,
    pub camera: CameraDoc,
    pub film: FilmDoc,
    pub render: RenderDoc,
    pub main_material: Option<String>,
    pub materials: UniqueMap<MaterialSpec>,
    pub shapes: Option<Vec<ShapeSpec>>,
    pub lights: Option<Vec<LightSpec>>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename = "Camera", deny_unknown_fields, default)]
pub(crate) struct CameraDoc {
    pub position: Option<Point>,
    pub target: Option<Point>,
    pub up: Option<Point>,
    pub fov_y_deg: Option<FieldOfView>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename = "Film", deny_unknown_fields, default)]
pub(crate) struct FilmDoc {
    pub width: Option<Side>,
    pub height: Option<Side>,
    pub filter: Option<FilterSpec>,
    pub exposure: Option<ExposureSpec>,
    pub gamut: Option<GamutName>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename = "Render", deny_unknown_fields, default)]
pub(crate) struct RenderDoc {
    pub spp: Option<SampleCount>,
    pub depth: Option<Depth>,
    pub roulette: Option<Depth>,
    pub seed: Option<u64>,
    pub spectrum: Option<SpectrumName>,
    pub range_nm: Option<(Wavelength, Wavelength)>,
    pub edges_nm: Option<Vec<Wavelength>>,
    pub sampler: Option<SamplerName>,
    pub points: Option<PointsName>,
}

/// How samples spread over neighbouring pixels.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename = "Filter", deny_unknown_fields)]
pub enum FilterSpec {
    /// Every sample counts for its own pixel.
    Box,
    /// A truncated Gaussian, lengths in pixels.
    Gaussian {
        /// Standard deviation.
        sigma: Positive,
        /// Half-width at which it is cut.
        radius: Positive,
    },
}

/// How scene-linear radiance becomes the brightness of a PNG; EXR files are never touched.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename = "Exposure", deny_unknown_fields)]
pub enum ExposureSpec {
    /// The 90th percentile of the lit pixels' luminance becomes 0.8.
    Auto,
    /// Radiance is multiplied by this.
    Scale(Positive),
}

/// One material.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "Material", deny_unknown_fields)]
pub enum MaterialSpec {
    /// A measured file of any known format.
    File(FileMaterial),
    /// An analytic model, evaluated exactly.
    Model(ModelMaterial),
    /// An analytic model measured on the fly onto the MERL grid, then treated like a file.
    Measured(ModelMaterial),
    /// A weighted sum of other materials.
    Mix(MixMaterial),
    /// An ideal diffuse reflector.
    Lambert {
        /// Albedo per channel, at most 1; a factor on `spectrum`, where that is given.
        reflectance: Colour,
        /// (nm, albedo) in ascending order, linear in between and flat beyond.
        #[serde(default)]
        spectrum: Option<Vec<(Wavelength, Radiometric)>>,
    },
}

/// A measured file and how it is to be read.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "File", deny_unknown_fields)]
pub struct FileMaterial {
    /// Looked for beside the scene, then in the data folders.
    pub path: PathBuf,
    /// Between measured directions.
    #[serde(default)]
    pub interpolation: Option<InterpolationName>,
    /// What negative values mean.
    #[serde(default)]
    pub negatives: Option<NegativeName>,
    /// What answers in the hole around the incident direction (scattered measurements).
    #[serde(default)]
    pub gap: Option<GapName>,
    /// What answers beyond the most grazing rows (scattered measurements).
    #[serde(default)]
    pub beyond: Option<BeyondName>,
    /// Factor per linear sRGB channel, applied last.
    #[serde(default)]
    pub scale: Option<[Weight; 3]>,
    /// What its numbers mean, where the file is not to be believed.
    #[serde(default)]
    pub colour: ColourChoice,
    /// Overrides `render.sampler`.
    #[serde(default)]
    pub sampler: Option<SamplerName>,
    /// The folder of the scene file that said so.
    #[serde(skip)]
    pub home: PathBuf,
}

/// A model in the notation of the command line, `ggx:alpha=0.1`.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "Model", deny_unknown_fields)]
pub struct ModelMaterial {
    /// Name and parameters.
    pub model: String,
    /// Between cells, if measured onto a grid.
    #[serde(default)]
    pub interpolation: Option<InterpolationName>,
    /// Factor per linear sRGB channel.
    #[serde(default)]
    pub scale: Option<[Weight; 3]>,
    /// Overrides `render.sampler`.
    #[serde(default)]
    pub sampler: Option<SamplerName>,
}

/// A weighted sum.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "Mix", deny_unknown_fields)]
pub struct MixMaterial {
    /// Names of other materials and their weights.
    pub parts: Vec<(String, Weight)>,
    /// Overrides `render.sampler`.
    #[serde(default)]
    pub sampler: Option<SamplerName>,
}

/// One surface.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "Shape", deny_unknown_fields)]
pub struct ShapeSpec {
    /// Its form.
    pub form: FormSpec,
    /// Name of its material.
    pub material: String,
    /// Radiance it sends out on its front side: makes it a light (spheres and quads).
    #[serde(default)]
    pub emission: Option<Colour>,
    /// The spectrum of that light, `emission` being one number, its luminance; daylight if not said.
    #[serde(default)]
    pub emission_spectrum: Option<LightSpectrum>,
    /// Whether its back is black; otherwise both sides reflect alike.
    #[serde(default)]
    pub one_sided: bool,
    /// Steps applied in order.
    #[serde(default)]
    pub transform: Vec<TransformSpec>,
}

/// The form of a surface.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "Form", deny_unknown_fields)]
pub enum FormSpec {
    /// An exact sphere.
    Sphere {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: Positive,
    },
    /// A parallelogram; its front is where edge_u x edge_v points.
    Quad {
        /// One corner.
        corner: Point,
        /// To the next corner.
        edge_u: Point,
        /// To the other next corner.
        edge_v: Point,
    },
    /// A triangle mesh, OBJ or PLY.
    Mesh {
        /// Looked for beside the scene, then in the data folders.
        path: PathBuf,
        /// Ignore the file's normals and shade flat.
        #[serde(default)]
        flat: bool,
        /// The folder of the scene file that said so.
        #[serde(skip)]
        home: PathBuf,
    },
    /// A sphere as triangles: `segments` around, half as many from pole to pole.
    UvSphere {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: Positive,
        /// Triangles around the equator, two a quad.
        segments: Segments,
    },
    /// A smooth surface of revolution about the y axis as triangles.
    Lathe {
        /// (radius, height) from bottom to top, at most 1000; a smooth curve runs through them.
        profile: Vec<(Coordinate, Coordinate)>,
        /// Segments around.
        segments: Segments,
    },
}

/// One step of a transform.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename = "Transform", deny_unknown_fields)]
pub enum TransformSpec {
    /// Moves.
    Translate(Point),
    /// Turns about an axis through the origin, counter-clockwise when the axis points at the viewer.
    Rotate {
        /// Any length but 0.
        axis: Point,
        /// Angle.
        angle_deg: Degrees,
    },
    /// Scales about the origin.
    Scale([Positive; 3]),
}

/// The shape of a light's spectrum; how bright it is stands beside it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename = "Spectrum", deny_unknown_fields)]
pub enum LightSpectrum {
    /// One of CIE's, by name: A, C, D50, D65, E, F2, F11.
    Illuminant(String),
    /// A blackbody of this temperature, K.
    Blackbody(Kelvin),
    /// (nm, power) in ascending order, linear in between and nothing beyond.
    Table(Vec<(Wavelength, Radiometric)>),
}

/// One light that is not a surface.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "Light", deny_unknown_fields)]
pub enum LightSpec {
    /// The same radiant intensity in all directions.
    Point {
        /// Where.
        position: Point,
        /// W/sr per channel.
        intensity: Colour,
        /// Its spectrum, `intensity` being one number.
        #[serde(default)]
        spectrum: Option<LightSpectrum>,
    },
    /// Parallel light.
    Directional {
        /// The way the light travels.
        direction: Point,
        /// On a surface facing it, W/m^2 per channel.
        irradiance: Colour,
        /// Its spectrum, `irradiance` being one number.
        #[serde(default)]
        spectrum: Option<LightSpectrum>,
    },
    /// The same radiance from everywhere.
    Constant {
        /// Radiance.
        radiance: Colour,
        /// Its spectrum, `radiance` being one number.
        #[serde(default)]
        spectrum: Option<LightSpectrum>,
    },
    /// Radiance from a latitude-longitude EXR image.
    Image {
        /// Looked for beside the scene, then in the data folders.
        path: PathBuf,
        /// Factor on its values.
        #[serde(default)]
        scale: Option<Positive>,
        /// Turn about the y axis.
        #[serde(default)]
        turn_deg: Option<Degrees>,
        /// The folder of the scene file that said so.
        #[serde(skip)]
        home: PathBuf,
    },
}

impl LightSpec {
    /// Its colour, or how bright its spectrum shines; an image is taken for white.
    pub(crate) fn shine(&self) -> (Colour, Option<&LightSpectrum>) {
        match self {
            Self::Point {
                intensity: colour,
                spectrum,
                ..
            }
            | Self::Directional {
                irradiance: colour,
                spectrum,
                ..
            }
            | Self::Constant {
                radiance: colour,
                spectrum,
            } => (*colour, spectrum.as_ref()),
            Self::Image { .. } => (Colour([1.0; 3]), None),
        }
    }
}
