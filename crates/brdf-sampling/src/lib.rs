//! Direction samplers built from any reflectance: f(wi, wo) as one number is all they see.
//!
//! Every sampler draws `wi` for a known `wo` and knows its own density exactly, for every `wo` and not only
//! at the directions it has tables for. Formulas: docs/sampling.md.
//!
//! - [`Uniform`], [`Cosine`]: no table, the yardsticks.
//! - [`Rejection`]: the thesis' method; no table but maxima.
//! - [`Inversion`]: large tables, plain.
//! - [`Hvt`]: small tables of least variance, the default choice; [`ColourTarget`] serves several channels,
//!   [`colour_floor`] says how well that can go; [`BakedHvt`] evaluates through the table.
//! - [`Dictionary`]: GGX lobes and a cosine, 0.4 KB or a single lobe.
//! - [`sampler_report`], [`sampler_cost`], [`packet_cost`], [`relative_variance`]: how noisy and how fast any of them is.
//!
//! Not here: lights, multiple importance sampling, files.

mod albedo;
mod baked;
mod chart;
mod colour;
mod cosine;
mod cost;
mod dictionary;
mod hvt;
mod inversion;
mod known_grid;
mod lane_math;
mod pseudo_angle;
mod pseudo_log;
mod rejection;
mod rejection_cache;
mod report;
mod slice_measure;
mod target;
mod uniform;
mod variance;

pub use baked::BakedHvt;
pub use colour::{ColourTarget, colour_floor};
pub use cosine::Cosine;
pub use cost::{PacketCalls, SamplerCost, SingleCalls, packet_cost, sampler_cost};
pub use dictionary::Dictionary;
pub use hvt::{Hvt, HvtOptions, MAX_B, Preset};
pub use inversion::{Inversion, InversionOptions};
pub use rejection::{BoundAudit, Rejection, RejectionOptions, SharedTarget};
pub use rejection_cache::{CacheError, Proposal, RejectionCache};
pub use report::{OFF_GRID, SHOWN_DEG, SamplerReport, off_grid_deg, sampler_report};
pub use target::{Target, TargetLanes};
pub use uniform::Uniform;
pub use variance::{RelativeVariance, relative_variance, relative_variance_for};
