//! Tables of measured reflectance: interpolate, repair, combine.
