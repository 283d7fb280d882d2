//! What a caller describes, and the scene that is rendered.

use crate::build::Builder;
use crate::bvh::Bvh;
use crate::camera::Camera;
use crate::geometry::{Geometry, TriangleInfo};
use crate::light::{Emitter, Environment, LightSelection, Lights, PointLight};
use crate::mode::{Fixed, Mode};
use crate::path::NONE;
use crate::shape::Shape;
use brdf::Material;
use glam::DAffine3;

/// A shape in the world with its surface.
#[derive(Clone, Debug)]
pub struct Object<const N: usize, S: Mode<N> = Fixed> {
    /// What it is.
    pub shape: Shape,
    /// From the shape's coordinates to the world's.
    pub transform: DAffine3,
    /// Index into [`Description::materials`].
    pub material: usize,
    /// Radiance its front sends out.
    pub emission: Option<S::Emission>,
    /// Whether the back is black; otherwise both sides reflect alike.
    pub one_sided: bool,
}

impl<const N: usize, S: Mode<N>> Object<N, S> {
    /// A shape where it stands, with a material, not shining, reflecting on both sides.
    #[must_use]
    pub fn new(shape: Shape, material: usize) -> Self {
        Self {
            shape,
            transform: DAffine3::IDENTITY,
            material,
            emission: None,
            one_sided: false,
        }
    }
}

/// Everything a picture is made of.
///
/// Materials are asked in a local frame whose z is the normal on the viewer's side. Its x and y depend on the normal
/// alone: reflectances that are not isotropic are turned with it.
pub struct Description<const N: usize, S: Mode<N> = Fixed> {
    /// Who looks.
    pub camera: Camera,
    /// Surfaces, referred to by index.
    pub materials: Vec<Box<dyn Material<N, S::Tag>>>,
    /// Shapes.
    pub objects: Vec<Object<N, S>>,
    /// Lights without extent.
    pub lights: Vec<PointLight<S::Emission>>,
    /// What is seen where nothing is; `None` is black.
    pub environment: Option<Environment<S::Emission>>,
    /// How vertices choose among lights.
    pub selection: LightSelection,
}

impl<const N: usize, S: Mode<N>> std::fmt::Debug for Description<N, S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Description")
            .field("camera", &self.camera)
            .field("materials", &self.materials.len())
            .field("objects", &self.objects.len())
            .field("lights", &self.lights)
            .finish_non_exhaustive()
    }
}

/// Primitives a scene may have: two bits of an index tell sides apart, and three the lanes of a leaf that may hold a
/// single triangle.
pub(crate) const MAX_PRIMITIVES: u32 = u32::MAX >> 5;

/// Why a description makes no scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The camera can't look that way.
    #[error("camera: {0}")]
    Camera(&'static str),
    /// An object is not usable.
    #[error("object {object}: {reason}")]
    Object {
        /// Its index.
        object: usize,
        /// What was expected.
        reason: String,
    },
    /// A light is not usable.
    #[error("light {light}: {reason}")]
    Light {
        /// Its index.
        light: usize,
        /// What was expected.
        reason: &'static str,
    },
    /// The environment is not usable.
    #[error("environment: {0}")]
    Environment(&'static str),
    /// More primitives than can be counted.
    #[error("more than {} primitives", MAX_PRIMITIVES)]
    TooMany,
}

/// What the renderer needs to know of an object once its shape is in [`Geometry`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub(crate) material: u32,
    /// Index into the lights, or [`crate::path::NONE`].
    pub(crate) light: u32,
    pub(crate) one_sided: bool,
}

/// A scene ready to be rendered.
pub struct Scene<const N: usize, S: Mode<N> = Fixed> {
    pub(crate) mode: S,
    pub(crate) camera: Camera,
    pub(crate) materials: Vec<Box<dyn Material<N, S::Tag>>>,
    pub(crate) geometry: Geometry,
    pub(crate) surfaces: Vec<Surface>,
    /// For [`crate::Strategy::Mis`].
    pub(crate) lights: Lights<S::Emission>,
    /// For [`crate::Strategy::LightOnly`], where a constant environment is asked as well.
    pub(crate) all_lights: Lights<S::Emission>,
    /// Index of the environment among the lights.
    pub(crate) environment: Option<u32>,
    /// Whether any triangle is shaded with a normal of its own.
    pub(crate) smooth: bool,
    pub(crate) left_out: usize,
}

/// What a scene takes beside its materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneBytes {
    /// Tree, leaves, objects and corner normals of triangles.
    pub triangles: usize,
    /// A picture around the scene with its sampling tables.
    pub environment: usize,
    /// What triangles took while the scene was built: gone since.
    pub building: usize,
}

/// Bytes a triangle at the most while a scene is built, measured (docs/performance.md): the mesh as it was read, corners,
/// normals, boxes, the binary tree and its builder's copies.
const BUILDING: usize = 366;

impl<const N: usize, S: Mode<N>> std::fmt::Debug for Scene<N, S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Scene")
            .field("camera", &self.camera)
            .field("materials", &self.materials.len())
            .field("triangles", &self.triangles())
            .finish_non_exhaustive()
    }
}

impl<const N: usize> Scene<N> {
    /// A scene whose paths all carry the same channels; see [`Self::with_mode`].
    ///
    /// # Errors
    /// As [`Self::with_mode`].
    pub fn new(description: Description<N>) -> Result<Self, SceneError> {
        Self::with_mode(Fixed, description)
    }
}

impl<const N: usize, S: Mode<N>> Scene<N, S> {
    /// Checks a description, moves every shape into the world and builds trees and tables.
    ///
    /// # Errors
    /// Says which part of the description can't be used and why.
    pub fn with_mode(mode: S, description: Description<N, S>) -> Result<Self, SceneError> {
        Builder::new(description)?.finish(mode)
    }

    /// Triangles that are rendered.
    #[must_use]
    pub fn triangles(&self) -> usize {
        let taken = |t: &&TriangleInfo| t.object != NONE;
        self.geometry.triangles.iter().filter(taken).count()
    }

    /// Bytes of the tree over triangles with what they are and their normals, and of pictures that light the scene.
    #[must_use]
    pub fn bytes(&self) -> SceneBytes {
        let geometry = &self.geometry;
        let pictures = self.lights.lights.iter().map(|l| match &l.emitter {
            Emitter::Image(light) => light.bytes(),
            _ => 0,
        });
        SceneBytes {
            triangles: geometry.bvh.as_ref().map_or(0, Bvh::bytes)
                + size_of_val(&geometry.triangles[..])
                + size_of_val(&geometry.normals[..]),
            environment: pictures.sum(),
            building: BUILDING * self.triangles(),
        }
    }

    /// Triangles that were left out since they have no area.
    #[must_use]
    pub fn degenerate_triangles(&self) -> usize {
        self.left_out
    }
}
