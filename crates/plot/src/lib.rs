//! Polar plots, curves and slices as SVG and PNG; knows numbers, not BRDFs.
