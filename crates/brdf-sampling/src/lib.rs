//! Direction samplers built from any Brdf.
