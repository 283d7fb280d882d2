//! The laws, over the list of all models: what the registry promises is kept, what it calls broken breaks.

mod cases;
mod energy;
mod extremes;
mod listed;
mod packets;
mod parsing;
mod reciprocity;
mod sampling;
