//! The only library that touches files: scenes, meshes, BRDF files, EXR and PNG, caches.
