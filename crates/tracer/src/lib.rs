//! Camera, shapes, lights, BVH, integrator and film; sees only the Brdf trait.
