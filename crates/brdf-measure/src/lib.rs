//! A virtual gonioreflectometer: samples any Brdf onto the grids real instruments use, with their flaws.
