//! Charts for measured reflectance as SVG and PNG: polar lobes, curves, maps, and points with error bars.
//!
//! Knows numbers, not BRDFs: callers evaluate, this crate draws. Every picture is made once, as SVG;
//! [`png`] rasterises that same picture with a font the crate carries, so both look alike on any machine.

mod chart;
mod curve;
mod error;
mod loglog;
mod map;
mod polar;
mod raster;

pub use chart::{Axis, Chart, Scale};
pub use curve::{Color, Curve, Stroke, palette};
pub use error::PlotError;
pub use loglog::{LogLog, Series};
pub use map::HeatMap;
pub use polar::{PolarPlot, Radius};
pub use raster::png;
