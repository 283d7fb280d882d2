//! The laws, over the list of all models: what the registry promises is kept, what it calls broken breaks.

mod cases;
mod docs;
mod energy;
mod extremes;
mod listed;
mod lobes;
mod packets;
mod parsing;
mod published;
mod reciprocity;
mod sampling;
mod spectral;
