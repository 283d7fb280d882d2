//! SVG to PNG, with a font of our own: the result does not depend on what a machine has installed.

use crate::PlotError;
use resvg::{tiny_skia, usvg};
use std::sync::Arc;

/// The largest side of a picture in pixels; more is a mistake of the caller.
const MAX_SIDE: u32 = 16_384;

/// Rasterises a picture made by this crate, `zoom` pixels a unit.
///
/// # Errors
/// If the text is not SVG, or the picture would be empty or larger than 16384 pixels a side.
pub fn png(svg: &str, zoom: f32) -> Result<Vec<u8>, PlotError> {
    let mut options = usvg::Options::default();
    let fonts = Arc::make_mut(&mut options.fontdb);
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    let tree = usvg::Tree::from_str(svg, &options).map_err(PlotError::new)?;
    let size = tree
        .size()
        .to_int_size()
        .scale_by(zoom)
        .ok_or_else(|| PlotError::new("the picture is empty"))?;
    if size.width().max(size.height()) > MAX_SIDE {
        return Err(PlotError::new(format!(
            "{} x {} pixels, at most {MAX_SIDE} a side",
            size.width(),
            size.height()
        )));
    }
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height())
        .ok_or_else(|| PlotError::new("the picture is empty"))?;
    resvg::render(
        &tree,
        tiny_skia::Transform::from_scale(zoom, zoom),
        &mut pixels.as_mut(),
    );
    pixels.encode_png().map_err(PlotError::new)
}
