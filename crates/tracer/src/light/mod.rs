//! What shines, how a direction toward it is chosen, and with which density.

mod bound;
mod environment;
mod rect;
mod selection;
mod sphere;
mod tree;
mod triangles;

pub(crate) use environment::ImageLight;
pub use environment::{Environment, EnvironmentImage};
pub(crate) use rect::RectLight;
pub(crate) use selection::Lights;
pub use selection::{LightSelection, MANY};
pub(crate) use sphere::SphereLight;
pub(crate) use triangles::TriangleLight;

use crate::math::{F, U, sin_cos};
use crate::mode::Emission;
use crate::path::NONE;
use brdf::{LANES, Lanes3, Tag};
use glam::{DVec3, Vec3};
use rect::Toward;
use std::f32::consts::PI;
use std::ops::Range;

/// A light without extent.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PointLight<E> {
    /// Shines from one point.
    Point {
        /// Where.
        position: DVec3,
        /// Radiant intensity: radiance of a small source times its area.
        intensity: E,
    },
    /// Shines along one direction from infinitely far.
    Directional {
        /// The way the light travels, any length but zero.
        direction: DVec3,
        /// On a plane across the direction.
        irradiance: E,
    },
}

/// The shape of a light.
#[derive(Clone, Debug)]
pub(crate) enum Emitter<E> {
    Rect(RectLight),
    Sphere(SphereLight),
    Triangles(TriangleLight),
    Point(Vec3),
    /// Toward the light.
    Directional(Vec3),
    Constant,
    Image(ImageLight<E>),
}

/// A light: shape and strength.
#[derive(Clone, Debug)]
pub(crate) struct Light<E> {
    pub(crate) emitter: Emitter<E>,
    /// Radiance, intensity or irradiance by kind; unused by a picture.
    pub(crate) strength: E,
    /// Primitive of an analytic shape, or [`NONE`].
    pub(crate) prim: u32,
}

/// [`LANES`] directions toward lights.
#[derive(Clone, Debug)]
pub(crate) struct LightLanes<const N: usize> {
    pub(crate) wi: Lanes3,
    pub(crate) distance: F,
    /// Per solid angle; 0 = nothing.
    pub(crate) pdf: F,
    /// 1 if the material could find the light as well, 0 for lights without extent.
    pub(crate) shared: F,
    pub(crate) radiance: [F; N],
    /// The primitive that shines, or [`NONE`].
    pub(crate) prim: U,
}

impl<const N: usize> LightLanes<N> {
    pub(crate) const EMPTY: Self = Self {
        wi: Lanes3::ZERO,
        distance: [0.0; LANES],
        pdf: [0.0; LANES],
        shared: [0.0; LANES],
        radiance: [[0.0; LANES]; N],
        prim: [NONE; LANES],
    };

    #[inline(always)]
    fn set(&mut self, k: usize, toward: Toward) {
        self.wi.set(k, toward.wi);
        self.distance[k] = toward.distance;
        self.pdf[k] = toward.pdf;
    }

    /// Takes lane `k` from another.
    fn copy(&mut self, k: usize, from: &Self) {
        self.wi.set(k, from.wi.get(k));
        self.distance[k] = from.distance[k];
        self.pdf[k] = from.pdf[k];
        self.shared[k] = from.shared[k];
        self.prim[k] = from.prim[k];
        for c in 0..N {
            self.radiance[c][k] = from.radiance[c][k];
        }
    }
}

impl<E> Light<E> {
    /// Fills the `lanes` of `out` for the points `p` of paths with these tags.
    #[inline(always)]
    pub(crate) fn sample<const N: usize, T: Tag>(
        &self,
        p: &Lanes3,
        u: &[F; 2],
        tags: &[T; LANES],
        lanes: Range<usize>,
        out: &mut LightLanes<N>,
    ) where
        E: Emission<N, T>,
    {
        self.shine(tags, lanes.clone(), out);
        match &self.emitter {
            Emitter::Rect(light) => {
                for k in lanes {
                    out.set(k, light.sample(p.get(k), u[0][k], u[1][k]));
                }
            }
            Emitter::Sphere(light) => {
                for k in lanes {
                    out.set(k, light.sample(p.get(k), u[0][k], u[1][k]));
                }
            }
            Emitter::Triangles(light) => {
                for k in lanes {
                    let (toward, prim) = light.sample(p.get(k), u[0][k], u[1][k]);
                    out.set(k, toward);
                    out.prim[k] = prim;
                }
            }
            Emitter::Image(light) => {
                for k in lanes {
                    let (wi, pdf, radiance) = light.sample(u[0][k], u[1][k]);
                    let radiance = radiance.at(tags[k]);
                    out.set(k, far(wi, pdf));
                    for c in 0..N {
                        out.radiance[c][k] = radiance[c];
                    }
                }
            }
            Emitter::Constant => {
                for k in lanes {
                    out.set(k, far(uniform(u[0][k], u[1][k]), 0.25 / PI));
                }
            }
            Emitter::Point(_) | Emitter::Directional(_) => self.sample_point(p, lanes, out),
        }
    }

    /// What does not depend on where a lane is.
    #[inline(always)]
    fn shine<const N: usize, T: Tag>(
        &self,
        tags: &[T; LANES],
        lanes: Range<usize>,
        out: &mut LightLanes<N>,
    ) where
        E: Emission<N, T>,
    {
        if lanes.len() == LANES {
            out.radiance = self.strength.at_lanes(tags);
            out.shared = [1.0; LANES];
            out.prim = [self.prim; LANES];
            return;
        }
        for k in lanes {
            let radiance = self.strength.at(tags[k]);
            for c in 0..N {
                out.radiance[c][k] = radiance[c];
            }
            out.shared[k] = 1.0;
            out.prim[k] = self.prim;
        }
    }

    /// [`Self::sample`] for lights without extent.
    #[inline(never)]
    fn sample_point<const N: usize>(
        &self,
        p: &Lanes3,
        lanes: Range<usize>,
        out: &mut LightLanes<N>,
    ) {
        for k in lanes {
            out.shared[k] = 0.0;
            let (toward, fall) = match &self.emitter {
                Emitter::Point(position) => {
                    let to = *position - p.get(k);
                    let d2 = to.length_squared();
                    let toward = Toward {
                        wi: to.normalize_or_zero(),
                        distance: d2.sqrt(),
                        pdf: if d2 > 0.0 { 1.0 } else { 0.0 },
                    };
                    (toward, 1.0 / d2)
                }
                Emitter::Directional(wi) => (far(*wi, 1.0), 1.0),
                _ => (far(Vec3::Z, 0.0), 0.0),
            };
            out.set(k, toward);
            for c in 0..N {
                out.radiance[c][k] *= fall;
            }
        }
    }

    /// Density with which [`Self::sample`] from `o` chooses the point met at `t` along `d`, where `normal` gives the
    /// front normal of what is flat. For environments only `d` counts.
    #[inline]
    pub(crate) fn pdf(&self, o: Vec3, d: Vec3, t: f32, normal: impl Fn() -> Vec3) -> f32 {
        match &self.emitter {
            Emitter::Rect(light) => light.pdf(o, t),
            Emitter::Sphere(light) => light.pdf(o),
            Emitter::Triangles(light) => light.pdf(normal(), d, t),
            Emitter::Image(light) => light.pdf(d),
            Emitter::Constant => 0.25 / PI,
            Emitter::Point(_) | Emitter::Directional(_) => 0.0,
        }
    }

    /// Radiance toward `-d` of an emitter that was met by a path with this tag.
    #[inline]
    pub(crate) fn radiance<const N: usize, T: Tag>(&self, d: Vec3, tag: T) -> [f32; N]
    where
        E: Emission<N, T>,
    {
        match &self.emitter {
            Emitter::Image(light) => light.radiance(d).at(tag),
            _ => self.strength.at(tag),
        }
    }
}

#[inline(always)]
fn far(wi: Vec3, pdf: f32) -> Toward {
    Toward {
        wi,
        distance: f32::INFINITY,
        pdf,
    }
}

/// A direction even over the sphere.
#[inline(always)]
fn uniform(u: f32, v: f32) -> Vec3 {
    let z = 1.0 - 2.0 * u;
    let r = (4.0 * u * (1.0 - u)).max(0.0).sqrt();
    let (s, c) = sin_cos(2.0 * PI * v - PI);
    Vec3::new(r * c, r * s, z)
}
