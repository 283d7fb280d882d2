//! Points with error bars and fitted lines over two logarithmic axes: how an error falls with time.

use crate::chart::{Placed, Scale, emptiest_corner, shown};
use crate::curve;
use crate::error::PlotError;
use plotters::prelude::*;

/// Points of one kind.
#[derive(Clone, Debug)]
pub struct Series {
    /// Text in the legend.
    pub label: String,
    /// Colour of points, bars and line.
    pub color: curve::Color,
    /// x, y, and the interval of y: `[x, y, low, high]`. What is not positive and finite is not drawn.
    pub points: Vec<[f64; 4]>,
    /// A fitted line through these points, in data coordinates; empty for none.
    pub line: Vec<(f64, f64)>,
}

/// A chart of [`Series`]; both axes are logarithmic and fit the points.
#[derive(Clone, Debug)]
pub struct LogLog {
    /// Heading.
    pub title: String,
    /// Name and unit of the horizontal axis.
    pub x_label: String,
    /// Name and unit of the vertical axis.
    pub y_label: String,
    /// A level to compare at, drawn as a dotted line with its name.
    pub level: Option<(f64, String)>,
    /// What is drawn, first below.
    pub series: Vec<Series>,
}

/// Room left of the first and right of the last point, as a factor.
const MARGIN: f64 = 1.4;
/// Half the width of the ends of an error bar, units.
const CAP: i32 = 4;
/// Text sizes: heading, axes and legend.
const FONTS: [u32; 2] = [20, 14];

impl LogLog {
    /// The picture as SVG, `size` units wide and high.
    ///
    /// # Errors
    /// If there is no drawable point.
    pub fn svg(&self, size: (u32, u32)) -> Result<String, PlotError> {
        let drawable = || {
            self.series
                .iter()
                .flat_map(|s| s.points.iter().filter(|p| is_drawable(p)))
        };
        if drawable().next().is_none() {
            return Err(PlotError::new("no point with a positive, finite error"));
        }
        let level = self
            .level
            .iter()
            .map(|l| l.0)
            .filter(|v| v.is_finite() && *v > 0.0);
        let x = axis(drawable().map(|p| p[0]));
        // bars that reach toward zero are cut off rather than drawn at the cost of all others
        let y = axis(
            drawable()
                .flat_map(|p| [p[1], p[3], p[2].max(0.3 * p[1])])
                .chain(level),
        );
        let mut out = String::new();
        {
            let area = SVGBackend::with_string(&mut out, size).into_drawing_area();
            self.draw(&area, x, y).map_err(PlotError::new)?;
            area.present().map_err(PlotError::new)?;
        }
        Ok(out)
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, plotters::coord::Shift>,
        x: Placed,
        y: Placed,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let points = self
            .series
            .iter()
            .flat_map(|s| s.points.iter().map(|p| (p[0], p[1])));
        let legend = emptiest_corner(points, &x, &y);
        let (x_range, y_range) = (x.range.clone(), y.range.clone());
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", FONTS[0]))
            .margin(14)
            .x_label_area_size(46)
            .y_label_area_size(72)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .x_desc(&self.x_label)
            .y_desc(&self.y_label)
            .label_style(("sans-serif", FONTS[1]))
            .x_label_formatter(&|v| shown(*v))
            .y_label_formatter(&|v| shown(*v))
            .draw()?;
        if let Some((level, name)) = &self.level {
            let ends = [(x_range.start, *level), (x_range.end, *level)];
            chart.draw_series(DashedLineSeries::new(
                ends,
                2,
                4,
                BLACK.mix(0.6).stroke_width(1),
            ))?;
            let at = (x_range.start, *level);
            let text =
                EmptyElement::at(at) + Text::new(name.clone(), (6, -17), ("sans-serif", FONTS[1]));
            chart.draw_series([text])?;
        }
        for series in &self.series {
            let [r, g, b] = series.color;
            let color = RGBColor(r, g, b);
            let line = LineSeries::new(series.line.iter().copied(), color.mix(0.7).stroke_width(2));
            chart.draw_series(line)?;
            for p in series.points.iter().filter(|p| is_drawable(p)) {
                let (low, high) = (p[2].max(y_range.start), p[3].min(y_range.end));
                let thin = color.stroke_width(1);
                chart.draw_series([PathElement::new([(p[0], low), (p[0], high)], thin)])?;
                for end in [low, high] {
                    let cap = EmptyElement::at((p[0], end))
                        + PathElement::new([(-CAP, 0), (CAP, 0)], thin);
                    chart.draw_series([cap])?;
                }
            }
            let dots = series.points.iter().filter(|p| is_drawable(p));
            let drawn =
                chart.draw_series(dots.map(|p| Circle::new((p[0], p[1]), 4, color.filled())))?;
            drawn.label(&series.label).legend(move |(x, y)| {
                EmptyElement::at((x, y))
                    + PathElement::new([(0, 0), (18, 0)], color.mix(0.7).stroke_width(2))
                    + Circle::new((9, 0), 4, color.filled())
            });
        }
        chart
            .configure_series_labels()
            .background_style(WHITE.mix(0.9))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", FONTS[1]))
            .position(legend)
            .draw()
    }
}

fn is_drawable(p: &[f64; 4]) -> bool {
    p[..2].iter().all(|v| v.is_finite() && *v > 0.0) && p[2..].iter().all(|v| v.is_finite())
}

fn axis(values: impl Iterator<Item = f64>) -> Placed {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
    Placed {
        scale: Scale::Log,
        range: low / MARGIN..high * MARGIN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: Vec<[f64; 4]>) -> LogLog {
        LogLog {
            title: "t".into(),
            x_label: "x".into(),
            y_label: "y".into(),
            level: Some((0.01, "target".into())),
            series: vec![Series {
                label: "kind of".into(),
                color: [0, 0, 0],
                points,
                line: vec![(1.0, 1.0), (4.0, 0.5)],
            }],
        }
    }

    #[test]
    fn points_bars_and_names_are_drawn() {
        let svg = chart(vec![[1.0, 1.0, 0.9, 1.1], [4.0, 0.5, 0.4, 0.6]])
            .svg((600, 400))
            .unwrap();
        // two points and one in the legend; a bar has three strokes
        assert_eq!(svg.matches("<circle").count(), 3, "{svg}");
        assert!(svg.contains("kind of") && svg.contains("target"), "{svg}");
    }

    #[test]
    fn what_a_logarithm_cannot_show_is_left_out() {
        let bad = [0.0, f64::NAN, f64::INFINITY].map(|v| [1.0, v, 0.1, 0.2]);
        let svg = chart([vec![[1.0, 1.0, 0.0, 1.1]], bad.to_vec()].concat())
            .svg((600, 400))
            .unwrap();
        assert_eq!(svg.matches("<circle").count(), 2, "{svg}");
        assert!(
            chart(bad.to_vec()).svg((600, 400)).is_err(),
            "nothing to draw"
        );
    }
}
