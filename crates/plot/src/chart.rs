//! Curves over two axes, linear or logarithmic.

use crate::curve::{Curve, Stroke};
use crate::error::PlotError;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint};
use plotters::prelude::*;
use std::ops::Range;

/// How an axis maps numbers to places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equally long.
    Linear,
    /// Equal ratios are equally long; non-positive values are not drawn.
    Log,
}

/// An axis: its name (with the unit), its scale and, if fixed, its range.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Name and unit, such as `theta_o (deg)`.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Fixed range; `None` fits the curves.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// A linear axis fitted to the data.
    #[must_use]
    pub fn linear(label: &str) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Linear,
            range: None,
        }
    }

    /// A logarithmic axis fitted to the data.
    #[must_use]
    pub fn log(label: &str) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Log,
            range: None,
        }
    }
}

/// A chart of curves.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Heading.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is drawn, first below.
    pub curves: Vec<Curve>,
}

/// An axis as plotters wants it: our scale decides where a value lies and where the ticks are.
#[derive(Clone)]
pub(crate) struct Placed {
    pub(crate) scale: Scale,
    pub(crate) range: Range<f64>,
}

impl Ranged for Placed {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "pixels")]
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let place = |v: f64| if self.scale == Scale::Log { v.ln() } else { v };
        let (low, high) = (place(self.range.start), place(self.range.end));
        let t = (place(*value) - low) / (high - low);
        limit.0 + (t * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match self.scale {
            Scale::Linear => linear_ticks(&self.range, hint.max_num_points().min(10)),
            Scale::Log => log_ticks(&self.range, hint.max_num_points().min(12)),
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// Multiples of 1, 2 or 5 times a power of ten inside the range, at most `most` of them.
fn linear_ticks(range: &Range<f64>, most: usize) -> Vec<f64> {
    let rough = (range.end - range.start) / most.max(2) as f64;
    let decade = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|m| m * decade)
        .find(|s| *s >= rough * (1.0 - 1e-9))
        .unwrap_or(decade);
    let first = (range.start / step - 1e-9).ceil();
    let last = (range.end / step + 1e-9).floor();
    (0..)
        .map(|k| first + f64::from(k))
        .take_while(|n| *n <= last)
        .map(|n| n * step)
        .collect()
}

/// Powers of ten inside the range, thinned to at most `most`; with 2 and 5 when there are few.
fn log_ticks(range: &Range<f64>, most: usize) -> Vec<f64> {
    let decades = range.start.log10().floor()..=range.end.log10().ceil();
    let span = decades.end() - decades.start();
    let factors: &[f64] = if span <= 3.0 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let every = (span / most.max(2) as f64).ceil().max(1.0);
    let mut ticks = Vec::new();
    let mut decade = *decades.start();
    while decade <= *decades.end() {
        ticks.extend(factors.iter().map(|f| f * 10_f64.powf(decade)));
        decade += every;
    }
    ticks.retain(|t| *t >= range.start * (1.0 - 1e-9) && *t <= range.end * (1.0 + 1e-9));
    ticks
}

/// A number as short as it can be read: `0.001`, `1e-5`, `250`.
pub(crate) fn shown(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        format!("{value:.0e}")
    } else {
        format!("{}", (value * 1e6).round() / 1e6)
    }
}

impl Chart {
    /// The picture as SVG, `size` units wide and high.
    ///
    /// # Errors
    /// If no curve has a drawable point.
    pub fn svg(&self, size: (u32, u32)) -> Result<String, PlotError> {
        let (x, y) = (
            self.placed(&self.x, |p| p.0)?,
            self.placed(&self.y, |p| p.1)?,
        );
        let mut out = String::new();
        {
            let area = SVGBackend::with_string(&mut out, size).into_drawing_area();
            self.draw(&area, x, y).map_err(PlotError::new)?;
            area.present().map_err(PlotError::new)?;
        }
        Ok(out)
    }

    fn placed(&self, axis: &Axis, of: impl Fn(&(f64, f64)) -> f64) -> Result<Placed, PlotError> {
        let drawable = |v: &f64| v.is_finite() && (axis.scale == Scale::Linear || *v > 0.0);
        let values: Vec<f64> = self
            .curves
            .iter()
            .flat_map(|c| c.points.iter().map(&of))
            .filter(drawable)
            .collect();
        let (low, high) = match axis.range {
            Some(range) => range,
            None if values.is_empty() => {
                return Err(PlotError::new(format!(
                    "nothing to draw along {:?}",
                    axis.label
                )));
            }
            None => values
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                    (a.min(*v), b.max(*v))
                }),
        };
        let range = match axis.scale {
            Scale::Log if high > low => low / 1.15..high * 1.15,
            Scale::Log => low / 2.0..high * 2.0,
            Scale::Linear if axis.range.is_some() && high > low => low..high,
            Scale::Linear => {
                let pad = if high > low {
                    0.04 * (high - low)
                } else {
                    0.5 * high.abs().max(1e-9)
                };
                low - pad..high + pad
            }
        };
        Ok(Placed {
            scale: axis.scale,
            range,
        })
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, plotters::coord::Shift>,
        x: Placed,
        y: Placed,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let points = self.curves.iter().flat_map(|c| c.points.iter().copied());
        let legend = emptiest_corner(points, &x, &y);
        let keep = {
            let (x, y) = (x.clone(), y.clone());
            move |p: &(f64, f64)| {
                let ok =
                    |a: &Placed, v: f64| v.is_finite() && (a.scale == Scale::Linear || v > 0.0);
                ok(&x, p.0) && ok(&y, p.1)
            }
        };
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 20))
            .margin(14)
            .x_label_area_size(42)
            .y_label_area_size(68)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .x_desc(&self.x.label)
            .y_desc(&self.y.label)
            .label_style(("sans-serif", 13))
            .x_label_formatter(&|v| shown(*v))
            .y_label_formatter(&|v| shown(*v))
            .draw()?;
        for curve in &self.curves {
            let color = RGBColor(curve.color[0], curve.color[1], curve.color[2]);
            let mut label = Some(curve.label.clone()).filter(|l| !l.is_empty());
            for run in curve.runs(&keep) {
                let drawn = match curve.stroke {
                    Stroke::Solid => {
                        chart.draw_series(LineSeries::new(run, color.stroke_width(2)))?
                    }
                    Stroke::Dashed => chart.draw_series(DashedLineSeries::new(
                        run,
                        7,
                        5,
                        color.stroke_width(2),
                    ))?,
                    Stroke::Dots => chart
                        .draw_series(run.into_iter().map(|p| Circle::new(p, 3, color.filled())))?,
                };
                if let Some(label) = label.take() {
                    drawn.label(label).legend(move |(x, y)| {
                        PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2))
                    });
                }
            }
        }
        if self.curves.iter().any(|c| !c.label.is_empty()) {
            chart
                .configure_series_labels()
                .background_style(WHITE.mix(0.85))
                .border_style(BLACK.mix(0.3))
                .label_font(("sans-serif", 13))
                .position(legend)
                .draw()?;
        }
        Ok(())
    }
}

/// Where a legend hides the fewest points; the upper right if all are alike.
pub(crate) fn emptiest_corner(
    points: impl Iterator<Item = (f64, f64)> + Clone,
    x: &Placed,
    y: &Placed,
) -> SeriesLabelPosition {
    // in thousandths of the axes; a legend takes less than four tenths of either
    let near =
        |axis: &Placed, value: f64, corner: i32| (axis.map(&value, (0, 1000)) - corner).abs() < 400;
    let hidden = |(cx, cy): (i32, i32)| {
        points
            .clone()
            .filter(|p| near(x, p.0, cx) && near(y, p.1, cy))
            .count()
    };
    [
        (SeriesLabelPosition::UpperRight, (1000, 1000)),
        (SeriesLabelPosition::UpperLeft, (0, 1000)),
        (SeriesLabelPosition::LowerRight, (1000, 0)),
        (SeriesLabelPosition::LowerLeft, (0, 0)),
    ]
    .into_iter()
    .min_by_key(|(_, corner)| hidden(*corner))
    .map_or(SeriesLabelPosition::UpperRight, |(position, _)| position)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(
            linear_ticks(&(0.0..1.0), 5),
            vec![0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]
        );
        let ticks = log_ticks(&(3e-4..20.0), 12);
        assert!(
            (ticks[0] - 1e-3).abs() < 1e-12 && ticks.len() == 5,
            "{ticks:?}"
        );
    }

    #[test]
    fn empty_chart_is_an_error() {
        let chart = Chart {
            title: "t".into(),
            x: Axis::linear("x"),
            y: Axis::log("y"),
            curves: vec![],
        };
        assert!(chart.svg((300, 200)).is_err(), "nothing to draw");
    }

    #[test]
    fn points_off_a_log_scale_interrupt_the_line() {
        let points = vec![(1.0, 1.0), (2.0, 10.0), (3.0, 0.0), (4.0, 5.0), (5.0, 6.0)];
        let curve = Curve {
            label: "c".into(),
            color: [0, 0, 0],
            stroke: Stroke::Solid,
            points,
        };
        let chart = Chart {
            title: "t".into(),
            x: Axis::linear("x"),
            y: Axis::log("y"),
            curves: vec![curve],
        };
        let svg = chart.svg((400, 300)).unwrap();
        let lines = svg.matches("stroke-width=\"2\"").count();
        assert_eq!(lines, 3, "two runs and a legend line");
    }
}
