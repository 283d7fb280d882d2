//! A named sequence of points and how it is drawn.

/// An sRGB colour, 0..=255.
pub type Color = [u8; 3];

/// How a curve's line looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// An unbroken line.
    Solid,
    /// Dashes: a reference or a fit.
    Dashed,
    /// Dots at the points, no line.
    Dots,
}

/// Points in data coordinates; a non-finite point interrupts the line.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Text in the legend; empty for none.
    pub label: String,
    /// Line colour.
    pub color: Color,
    /// Line style.
    pub stroke: Stroke,
    /// (x, y) of a chart; (theta in radians, r) of a polar plot.
    pub points: Vec<(f64, f64)>,
}

/// The `k`-th of eight colours that stay apart for most kinds of colour vision [Okabe2008].
#[must_use]
pub fn palette(k: usize) -> Color {
    const COLORS: [Color; 8] = [
        [0, 114, 178],
        [213, 94, 0],
        [0, 158, 115],
        [204, 121, 167],
        [86, 180, 233],
        [230, 159, 0],
        [0, 0, 0],
        [148, 128, 40],
    ];
    COLORS[k % COLORS.len()]
}

impl Curve {
    /// The curve's runs of drawable points.
    pub(crate) fn runs(&self, keep: impl Fn(&(f64, f64)) -> bool) -> Vec<Vec<(f64, f64)>> {
        self.points
            .split(|p| !keep(p))
            .filter(|run| !run.is_empty())
            .map(<[_]>::to_vec)
            .collect()
    }
}
