//! A matrix of values as a coloured map, with a scale beside it.

use crate::chart::Scale;
use crate::error::PlotError;
use plotters::prelude::*;

/// A rectangular map; row 0 is drawn at the bottom.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// Heading.
    pub title: String,
    /// Name, unit and range of the horizontal axis.
    pub x: (String, f64, f64),
    /// Name, unit and range of the vertical axis.
    pub y: (String, f64, f64),
    /// Values a row.
    pub columns: usize,
    /// Row after row; non-finite values (not measured) are drawn grey.
    pub values: Vec<f64>,
    /// Linear or logarithmic colours.
    pub scale: Scale,
}

/// Powers of ten a logarithmic map shows below its maximum.
const DECADES: f64 = 6.0;
/// Grey of values that do not exist.
const MISSING: RGBColor = RGBColor(200, 200, 200);

/// Perceptually even colours from dark blue over green to yellow: a cubic fit to matplotlib's viridis [Smith2015].
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to 0..=255"
)]
fn color(t: f64) -> RGBColor {
    let t = t.clamp(0.0, 1.0);
    let channel =
        |c: [f64; 4]| ((c[0] + t * (c[1] + t * (c[2] + t * c[3]))).clamp(0.0, 1.0) * 255.0) as u8;
    RGBColor(
        channel([0.29, -0.43, 0.35, 0.82]),
        channel([0.0, 1.37, -0.73, 0.26]),
        channel([0.34, 1.23, -2.62, 1.19]),
    )
}

impl HeatMap {
    /// The picture as SVG.
    ///
    /// # Errors
    /// If the values don't fill whole rows, or none can be drawn.
    pub fn svg(&self, size: (u32, u32)) -> Result<String, PlotError> {
        let max = self
            .values
            .iter()
            .copied()
            .filter(|v| v.is_finite())
            .fold(f64::NEG_INFINITY, f64::max);
        if self.columns == 0 || !self.values.len().is_multiple_of(self.columns) {
            return Err(PlotError::new(format!(
                "{} values do not fill rows of {}",
                self.values.len(),
                self.columns
            )));
        }
        if max <= 0.0 {
            return Err(PlotError::new("no value is positive"));
        }
        let mut out = String::new();
        {
            let area = SVGBackend::with_string(&mut out, size).into_drawing_area();
            self.draw(&area, max).map_err(PlotError::new)?;
            area.present().map_err(PlotError::new)?;
        }
        // cells that touch would show seams where their edges are smoothed
        Ok(out.replacen("<svg ", "<svg shape-rendering=\"crispEdges\" ", 1))
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, plotters::coord::Shift>,
        max: f64,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let (map, bar) = area.split_horizontally(area.dim_in_pixel().0.saturating_sub(112));
        let (low, high) = if self.scale == Scale::Log {
            (max.log10() - DECADES, max.log10())
        } else {
            (0.0, max)
        };
        let place = |v: f64| {
            if self.scale == Scale::Log {
                v.log10()
            } else {
                v
            }
        };
        let rows = self.values.len() / self.columns;
        let (dx, dy) = (
            (self.x.2 - self.x.1) / self.columns as f64,
            (self.y.2 - self.y.1) / rows as f64,
        );
        let mut chart = ChartBuilder::on(&map)
            .caption(&self.title, ("sans-serif", 20))
            .margin(12)
            .x_label_area_size(40)
            .y_label_area_size(52)
            .build_cartesian_2d(self.x.1..self.x.2, self.y.1..self.y.2)?;
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc(&self.x.0)
            .y_desc(&self.y.0)
            .label_style(("sans-serif", 13))
            .draw()?;
        chart.draw_series(self.values.iter().enumerate().map(|(k, v)| {
            let (x, y) = (
                self.x.1 + dx * (k % self.columns) as f64,
                self.y.1 + dy * (k / self.columns) as f64,
            );
            let fill = if v.is_finite() {
                color((place(*v) - low) / (high - low))
            } else {
                MISSING
            };
            Rectangle::new([(x, y), (x + dx, y + dy)], fill.filled())
        }))?;
        let mut scale = ChartBuilder::on(&bar)
            .margin(12)
            .margin_top(40)
            .margin_bottom(52)
            .y_label_area_size(64)
            .build_cartesian_2d(0.0..1.0, low..high)?;
        scale.draw_series((0..64).map(|k| {
            let at = |k: i32| low + (high - low) * f64::from(k) / 64.0;
            Rectangle::new(
                [(0.0, at(k)), (1.0, at(k + 1))],
                color((f64::from(k) + 0.5) / 64.0).filled(),
            )
        }))?;
        let log = self.scale == Scale::Log;
        scale
            .configure_mesh()
            .disable_mesh()
            .disable_x_axis()
            .label_style(("sans-serif", 12))
            .y_label_formatter(&|v| {
                if log {
                    format!("1e{v:.0} ")
                } else {
                    format!("{v:.3} ")
                }
            })
            .draw()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ragged_rows_are_refused_and_holes_are_grey() {
        let map = |columns, values: Vec<f64>| HeatMap {
            title: "t".into(),
            x: ("x".into(), 0.0, 1.0),
            y: ("y".into(), 0.0, 1.0),
            columns,
            values,
            scale: Scale::Linear,
        };
        assert!(map(2, vec![1.0; 3]).svg((300, 200)).is_err(), "ragged");
        assert!(map(2, vec![0.0; 4]).svg((300, 200)).is_err(), "black");
        let svg = map(2, vec![1.0, f64::NAN, 0.5, 0.0])
            .svg((300, 200))
            .unwrap();
        assert_eq!(svg.matches("#C8C8C8").count(), 1, "one hole");
    }
}
