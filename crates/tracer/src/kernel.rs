//! What stays the same for all batches of a render.

use crate::camera::Rays;
use crate::filter::Sampler;
use crate::light::Lights;
use crate::math::mix;
use crate::mode::Mode;
use crate::path::NONE;
use crate::scene::{Scene, Surface};
use crate::settings::{Settings, Strategy};
use sampling::Points;

/// Dimension pairs a vertex uses: material, point on the light, choice of the light.
const PER_VERTEX: u32 = 3;
/// The pair that places the sample in its pixel comes first.
const FIRST_VERTEX: u32 = 1;

/// Points on lights that [`Strategy::Ris`] chooses from. A power of two keeps them even.
pub(crate) const CANDIDATES: usize = 8;

/// The scene with everything that is chosen once per render.
pub(crate) struct Kernel<'a, const N: usize, S: Mode<N>> {
    pub(crate) scene: &'a Scene<N, S>,
    pub(crate) lights: &'a Lights<S::Emission>,
    pub(crate) camera: Rays,
    pub(crate) width: u32,
    /// Asked with a stream number, not a pixel: each replicate of a pixel is a stream, scrambled for itself.
    pub(crate) points: Points,
    pub(crate) replicates: u32,
    pub(crate) filter: Sampler,
    pub(crate) max_depth: u32,
    pub(crate) roulette: u32,
    seed: u64,
    /// The instruction set of this machine.
    pub(crate) arch: pulp::Arch,
    /// Whether vertices ask lights.
    pub(crate) ask_lights: bool,
    /// Whether light that a path meets after its first vertex counts.
    pub(crate) count_met: bool,
    /// Whether both are weighed against each other.
    pub(crate) weigh: bool,
    /// Points on lights a vertex looks at for its one shadow ray.
    pub(crate) candidates: usize,
    /// Where paths go that meet the front or the back (entries 2 i and 2 i + 1) of an analytic primitive, then of an object,
    /// or nothing (the last): a material, or as many as there are for the end; plus [`SHINES`] where light is met.
    pub(crate) sides: Vec<u32>,
}

/// Marks sides that shine.
pub(crate) const SHINES: u32 = 1 << 31;

impl<'a, const N: usize, S: Mode<N>> Kernel<'a, N, S> {
    pub(crate) fn new(
        scene: &'a Scene<N, S>,
        settings: &Settings,
        size: [u32; 2],
        replicates: u32,
    ) -> Self {
        let lights = match settings.strategy {
            Strategy::LightOnly => &scene.all_lights,
            Strategy::Mis | Strategy::Ris | Strategy::BsdfOnly => &scene.lights,
        };
        Self {
            scene,
            lights,
            camera: scene.camera.rays(size[0], size[1]),
            width: size[0],
            points: Points::new(settings.points, settings.seed),
            replicates,
            filter: settings.filter.sampler(),
            max_depth: settings.max_depth,
            roulette: settings.roulette.unwrap_or(u32::MAX),
            seed: mix(settings.seed),
            arch: brdf::arch(),
            ask_lights: settings.strategy != Strategy::BsdfOnly && lights.any(),
            count_met: settings.strategy != Strategy::LightOnly,
            weigh: matches!(settings.strategy, Strategy::Mis | Strategy::Ris),
            candidates: if settings.strategy == Strategy::Ris {
                CANDIDATES
            } else {
                1
            },
            sides: sides(scene),
        }
    }

    /// The entry of [`Self::sides`] for twice a primitive and its back, where the scene has triangles.
    #[inline(always)]
    pub(crate) fn side(&self, side: u64) -> u64 {
        let geometry = &self.scene.geometry;
        let analytic = 2 * geometry.objects.len() as u64;
        if side < analytic {
            return side;
        }
        let triangle = (geometry.triangles).get(((side - analytic) / 2) as usize);
        triangle.map_or(u64::MAX, |t| analytic + 2 * u64::from(t.object) + side % 2)
    }

    /// Dimension pair of use `part` at the vertex number `depth`.
    #[inline(always)]
    pub(crate) fn dimension(depth: u32, part: u32) -> u32 {
        FIRST_VERTEX + PER_VERTEX * depth + part
    }

    /// What tells this path apart from others. The single dimension 0 is used by nothing else.
    #[inline(always)]
    pub(crate) fn tag(&self, stream: u32, index: u32) -> S::Tag {
        let u = if S::DRAWS {
            self.points.get1(stream, index, 0)
        } else {
            0.0
        };
        self.scene.mode.tag(u)
    }

    /// A number in [0, 1) for the roulette, apart from the points that must stay even.
    #[inline]
    pub(crate) fn chance(&self, stream: u32, index: u32, depth: u32) -> f32 {
        let key =
            ((u64::from(stream) << 32) | u64::from(index)) ^ mix(self.seed ^ u64::from(depth));
        (mix(key) >> 40) as f32 * (1.0 / 16_777_216.0)
    }
}

fn sides<const N: usize, S: Mode<N>>(scene: &Scene<N, S>) -> Vec<u32> {
    let end = scene.materials.len() as u32;
    let shine = |light: bool| if light { SHINES } else { 0 };
    let of = |s: &Surface| {
        let back = if s.one_sided { end } else { s.material };
        [s.material | shine(s.light != NONE), back]
    };
    let analytic = scene.geometry.objects.iter();
    let analytic = analytic.flat_map(|object| of(&scene.surfaces[*object as usize]));
    let nothing = end | shine(scene.environment.is_some());
    (analytic.chain(scene.surfaces.iter().flat_map(of)))
        .chain([nothing])
        .collect()
}
