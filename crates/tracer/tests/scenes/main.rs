//! Scenes whose radiance is known on paper, and properties every render must have.

#![expect(
    clippy::unwrap_used,
    reason = "a scene of a test that can't be built fails it"
)]

mod closed_form;
mod common;
mod error;
mod hero;
mod invariance;
mod lights;
mod malformed;
mod resampling;
mod robust;
mod selection;
mod stopping;
mod strategies;
