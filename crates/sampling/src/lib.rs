//! Random and low-discrepancy points, warps with density and inverse, discrete and tabulated distributions, estimators.
