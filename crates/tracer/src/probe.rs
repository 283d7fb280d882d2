//! The questions a picture is made of, one at a time: what does a ray meet, where does light come from.
//!
//! For checks and for picking; [`crate::render`] asks them for thousands of paths at once, of the same code.

use crate::geometry::Geometry;
use crate::light::LightLanes;
use crate::math::splat3;
use crate::mode::Mode;
use crate::path::{HitLanes, NONE, RayLanes};
use crate::scene::Scene;
use brdf::{LANES, Tag};
use glam::Vec3;

/// Where a ray met a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Index into [`crate::Description::objects`].
    pub object: usize,
    /// Distance along the ray.
    pub distance: f32,
    /// The point, on the surface up to `error`.
    pub point: Vec3,
    /// Geometric normal of the front, unit.
    pub normal: Vec3,
    /// Bound on how far `point` lies off the surface; rays that leave start this far above it.
    pub error: f32,
    /// Which primitive, to be told to [`Scene::meet`] by a ray that leaves it.
    leaves: u32,
}

/// A direction toward a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TowardLight {
    /// Unit.
    pub wi: Vec3,
    /// To the point of the light; infinite for environments.
    pub distance: f32,
    /// Density per solid angle given this light; 0 = not seen from here.
    pub pdf: f32,
}

impl Meeting {
    /// Where a ray starts that leaves to the side of direction `d`, and what it leaves.
    fn start(&self, d: Vec3) -> (Vec3, u32) {
        let back = self.normal.dot(d) < 0.0;
        let side = if back { -self.normal } else { self.normal };
        (
            self.point + side * self.error,
            2 * self.leaves + u32::from(back),
        )
    }
}

impl<const N: usize, S: Mode<N>> Scene<N, S> {
    /// What the ray from `o` along the unit vector `d` meets first.
    #[must_use]
    pub fn meet(&self, o: Vec3, d: Vec3) -> Option<Meeting> {
        meet(&self.geometry, o, d, NONE)
    }

    /// What a ray along the unit vector `d` meets that leaves the surface at `from`, never that point itself.
    #[must_use]
    pub fn meet_next(&self, from: &Meeting, d: Vec3) -> Option<Meeting> {
        let (o, leaves) = from.start(d);
        meet(&self.geometry, o, d, leaves)
    }

    /// How many lights there are, environments included.
    #[must_use]
    pub fn lights(&self) -> usize {
        self.lights.lights.len()
    }

    /// The light that a vertex at `p` asks by a number in [0, 1), and the probability of this choice; `None` if no light
    /// is ever asked.
    #[must_use]
    pub fn choose_light(&self, p: Vec3, u: f32) -> Option<(usize, f32)> {
        self.lights.any().then(|| self.lights.choose(p, u))
    }

    /// The probability with which [`Self::choose_light`] takes light number `light` at `p`.
    #[must_use]
    pub fn light_probability(&self, light: usize, p: Vec3) -> f32 {
        if light < self.lights() {
            self.lights.probability(light, p)
        } else {
            0.0
        }
    }

    /// Whether [`Self::choose_light`] walks a tree.
    #[must_use]
    pub fn has_light_tree(&self) -> bool {
        self.lights.by_tree()
    }

    /// The direction that light number `light` gives the point `p` for two numbers in [0, 1); `None` if there is no such
    /// light.
    #[must_use]
    pub fn toward_light(&self, light: usize, p: Vec3, u: [f32; 2]) -> Option<TowardLight> {
        let light = self.lights.lights.get(light)?;
        let mut lanes = LightLanes::<N>::EMPTY;
        let tags = [S::Tag::FIRST; LANES];
        light.sample(
            &splat3(p),
            &u.map(|u| [u; LANES]),
            &tags,
            0..LANES,
            &mut lanes,
        );
        Some(TowardLight {
            wi: lanes.wi.get(0),
            distance: lanes.distance[0],
            pdf: lanes.pdf[0],
        })
    }

    /// Density with which [`Self::toward_light`] from `p` chooses the unit direction `d`; 0 if `d` does not meet that
    /// light first.
    #[must_use]
    pub fn light_pdf(&self, light: usize, p: Vec3, d: Vec3) -> f32 {
        let Some(chosen) = self.lights.lights.get(light) else {
            return 0.0;
        };
        let (index, distance, prim) = match self.meet(p, d) {
            Some(at) => (self.surfaces[at.object].light, at.distance, at.leaves),
            None => (self.environment.unwrap_or(NONE), f32::INFINITY, NONE),
        };
        if index as usize == light {
            let normal = || self.geometry.flat_normal(prim);
            chosen.pdf(p, d, distance, normal)
        } else {
            0.0
        }
    }
}

fn meet(geometry: &Geometry, o: Vec3, d: Vec3, leaves: u32) -> Option<Meeting> {
    let mut rays = RayLanes {
        o: splat3(o),
        d: splat3(d),
        ..RayLanes::EMPTY
    };
    rays.t_max[0] = f32::INFINITY;
    rays.from[0] = leaves;
    let mut hits = HitLanes::EMPTY;
    geometry.closest(&rays, &mut hits);
    let prim = hits.prim[0];
    if prim == NONE {
        return None;
    }
    let at = geometry.points(&[prim; LANES], &rays.o, &rays.d, &hits.t);
    Some(Meeting {
        object: geometry.object(prim) as usize,
        distance: hits.t[0],
        point: at.p.get(0),
        normal: at.normal.get(0),
        error: at.error[0],
        leaves: prim,
    })
}
