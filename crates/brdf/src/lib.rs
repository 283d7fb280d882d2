//! The contract between measured or modelled reflectance and whatever renders, plots or checks it.
//!
//! - [`Brdf`]: what the surface does. [`DirectionSampler`]: how a direction is chosen for it.
//!   [`Paired`]: one of each, as the [`Material`] a renderer holds.
//! - [`Measured`]: reflectance in the channels of its file; [`Projected`] turns it into a [`Brdf`], [`Computed`] a model into it.
//! - [`TaggedBrdf`]: the same where lanes differ in what they carry, as in hero wavelength sampling.
//! - [`HalfDiff`]: Rusinkiewicz' angles.
//! - [`Pages`]: memory for what is large.
//!
//! Only reflection is implemented. Transmission would bring the eta^2 factor of non-symmetric
//! scattering [Veach1997]; its place is [`Material`], which knows the direction of transport.
//!
//! World space, files and particular models are unknown here.

mod arch;
mod contract;
mod half_diff;
mod lanes;
mod material;
mod measured;
mod pages;
mod spread;
mod tag;

pub use arch::{arch, instructions};
pub use contract::{Brdf, DirectionSample, DirectionSampler, SampleLanes, Symmetry};
pub use half_diff::{HalfDiff, direction};
pub use lanes::{LANES, Lanes3};
pub use material::{EvalPacket, Material, Paired, SamplePacket};
pub use measured::{Computed, Measured, Projected, Status};
pub use pages::Pages;
pub use spread::{Rotated, Spread};
pub use tag::{HERO, ROTATIONS, RotatedTable, Rotation, Tag, TaggedBrdf, rotated};
