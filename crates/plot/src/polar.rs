//! In-plane polar plots of reflectance: the surface is the horizontal line, the normal points up.

use crate::curve::{Curve, Stroke};
use crate::error::PlotError;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// What the distance from the centre means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Radius {
    /// Proportional to the value.
    Linear,
    /// Proportional to log10(value / maximum) + `decades`; smaller values lie in the centre.
    Log {
        /// Powers of ten between the rim and the centre.
        decades: f64,
    },
}

/// A half disc of directions in the plane of incidence.
#[derive(Clone, Debug)]
pub struct PolarPlot {
    /// Heading.
    pub title: String,
    /// Name and unit of the radius.
    pub radius_label: String,
    /// Scale of the radius.
    pub radius: Radius,
    /// (theta in radians, value): theta from the normal, positive to the right.
    pub curves: Vec<Curve>,
    /// Directions marked by an arrow toward the centre: theta in radians and colour.
    pub incident: Vec<(f64, crate::Color)>,
}

/// Units of the drawing in one unit of the picture: plotters draws at whole numbers, too coarse for curves.
const FINE: i32 = 8;
/// [`FINE`], as a length.
const F: f64 = FINE as f64;

/// Where things lie, in units of the drawing.
struct Frame {
    center: (f64, f64),
    rim: f64,
    max: f64,
    radius: Radius,
}

impl Frame {
    fn place(&self, theta: f64, value: f64) -> (i32, i32) {
        let r = match self.radius {
            Radius::Linear => value / self.max,
            Radius::Log { decades } => 1.0 + (value / self.max).log10() / decades,
        };
        self.at(theta, r.clamp(0.0, 1.0))
    }

    #[expect(clippy::cast_possible_truncation, reason = "pixels")]
    fn at(&self, theta: f64, r: f64) -> (i32, i32) {
        let (s, c) = theta.sin_cos();
        (
            (self.center.0 + self.rim * r * s).round() as i32,
            (self.center.1 - self.rim * r * c).round() as i32,
        )
    }

    /// The values at which rings are drawn, and their labels.
    fn rings(&self) -> Vec<(f64, String)> {
        match self.radius {
            Radius::Linear => {
                let step = round_step(self.max / 4.0);
                (1..)
                    .map(|k| step * f64::from(k))
                    .take_while(|v| *v <= self.max * (1.0 + 1e-9))
                    .map(|v| (v, short(v)))
                    .collect()
            }
            Radius::Log { decades } => {
                let top = self.max.log10();
                let mut rings = Vec::new();
                let mut exponent = (top + 1e-9).floor();
                // a ring closer to the centre than its label is wide would be unreadable
                while exponent > top - 0.95 * decades {
                    let value = 10_f64.powf(exponent);
                    rings.push((value, short(value)));
                    exponent -= (decades / 6.0).ceil();
                }
                rings
            }
        }
    }
}

/// The smallest of 1, 2 and 5 times a power of ten that is not below `rough`.
fn round_step(rough: f64) -> f64 {
    let decade = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|m| m * decade);
    let fits = steps.into_iter().find(|s| *s >= rough * (1.0 - 1e-9));
    fits.unwrap_or(10.0 * decade)
}

fn short(value: f64) -> String {
    if (1e-3..1e4).contains(&value) {
        format!("{value:.3}")
            .trim_end_matches('0')
            .trim_end_matches('.')
            .into()
    } else {
        format!("{value:.1e}")
    }
}

type Failed<B> = DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>;

impl PolarPlot {
    /// The picture as SVG, `width` units wide.
    ///
    /// # Errors
    /// If no curve has a positive finite value.
    pub fn svg(&self, width: u32) -> Result<String, PlotError> {
        let max = self
            .curves
            .iter()
            .flat_map(|c| &c.points)
            .map(|p| p.1)
            .filter(|v| v.is_finite())
            .fold(0.0, f64::max);
        if max <= 0.0 {
            return Err(PlotError::new("no value is positive"));
        }
        let entries = self.curves.iter().filter(|c| !c.label.is_empty()).count();
        let legend = 20
            * u32::try_from(entries.div_ceil(LEGEND_COLUMNS.unsigned_abs() as usize)).unwrap_or(0);
        let height = width / 2 + 72 + legend;
        let rim = F * (f64::from(width) / 2.0 - 48.0);
        let frame = Frame {
            center: (F * f64::from(width) / 2.0, rim + F * 76.0),
            rim,
            max,
            radius: self.radius,
        };
        let fine = FINE.unsigned_abs();
        let mut out = String::new();
        {
            let area = SVGBackend::with_string(&mut out, (fine * width, fine * height))
                .into_drawing_area();
            self.draw(&area, &frame).map_err(PlotError::new)?;
            area.present().map_err(PlotError::new)?;
        }
        // the view box stays fine, the picture gets its size
        let drawn = format!(
            "<svg width=\"{}\" height=\"{}\"",
            fine * width,
            fine * height
        );
        Ok(out.replacen(
            &drawn,
            &format!("<svg width=\"{width}\" height=\"{height}\""),
            1,
        ))
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        frame: &Frame,
    ) -> Result<(), Failed<B>> {
        area.fill(&WHITE)?;
        let width = area.dim_in_pixel().0.cast_signed();
        let title = text(20).pos(centered());
        area.draw(&Text::new(
            self.title.clone(),
            (width / 2, FINE * 18),
            title,
        ))?;
        draw_grid(area, frame, &self.radius_label)?;
        for (theta, color) in &self.incident {
            draw_incident(area, frame, *theta, *color)?;
        }
        let mut entry = 0;
        for curve in &self.curves {
            let places = |run: Vec<(f64, f64)>| -> Vec<(i32, i32)> {
                run.iter()
                    .map(|(theta, value)| frame.place(*theta, value.max(0.0)))
                    .collect()
            };
            for run in curve.runs(|p| p.1.is_finite()) {
                draw_line(area, &places(run), curve)?;
            }
            if !curve.label.is_empty() {
                draw_legend_entry(area, frame, curve, entry)?;
                entry += 1;
            }
        }
        Ok(())
    }
}

/// Legend entries side by side.
const LEGEND_COLUMNS: i32 = 3;

/// Plain text of a height in units of the picture.
fn text(height: i32) -> TextStyle<'static> {
    TextStyle::from(("sans-serif", FINE * height))
}

fn stroke(color: impl Color, width: u32) -> ShapeStyle {
    color.stroke_width(FINE.unsigned_abs() * width)
}

/// The way the light comes: a line from the rim with a head at the centre, and the angle where the grid has none.
fn draw_incident<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    frame: &Frame,
    theta: f64,
    color: crate::Color,
) -> Result<(), Failed<B>> {
    let color = RGBColor(color[0], color[1], color[2]);
    area.draw(&PathElement::new(
        [frame.at(theta, 1.0), frame.at(theta, 0.0)],
        stroke(color, 1),
    ))?;
    // half-way in, so that narrow lobes near the centre stay visible
    let (tip, back) = (0.5, 0.5 + 11.0 * F / frame.rim);
    let head = [
        frame.at(theta, tip),
        frame.at(theta - 0.02, back),
        frame.at(theta + 0.02, back),
    ];
    area.draw(&Polygon::new(head, color.filled()))?;
    area.draw(&Circle::new(frame.at(theta, 1.0), FINE * 4, color.filled()))?;
    let deg = theta.to_degrees().abs();
    if (deg / 15.0 - (deg / 15.0).round()).abs() < 1e-6 {
        return Ok(());
    }
    let label = format!("{}\u{b0}", (deg * 10.0).round() / 10.0);
    let place = frame.at(theta, 1.0 + 16.0 * F / frame.rim);
    area.draw(&Text::new(
        label,
        place,
        text(12).pos(centered()).color(&color),
    ))
}

fn centered() -> plotters::style::text_anchor::Pos {
    use plotters::style::text_anchor::{HPos, Pos, VPos};
    Pos::new(HPos::Center, VPos::Center)
}

fn draw_grid<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    frame: &Frame,
    label: &str,
) -> Result<(), Failed<B>> {
    let faint = stroke(BLACK.mix(0.18), 1);
    let small = text(12).pos(centered());
    let rim = (-180..=180).map(|half| frame.at(f64::from(half).to_radians() / 2.0, 1.0));
    area.draw(&PathElement::new(rim.collect::<Vec<_>>(), faint))?;
    for (value, label) in frame.rings() {
        let arc: Vec<_> = (-180..=180)
            .map(|half| frame.place(f64::from(half).to_radians() / 2.0, value))
            .collect();
        let (x, y) = frame.place(90_f64.to_radians(), value);
        area.draw(&PathElement::new(arc, faint))?;
        area.draw(&Text::new(label, (x, y + FINE * 12), small.clone()))?;
    }
    for deg in (-90_i32..=90).step_by(15) {
        let theta = f64::from(deg).to_radians();
        area.draw(&PathElement::new(
            [frame.at(theta, 0.0), frame.at(theta, 1.0)],
            faint,
        ))?;
        let (x, y) = frame.at(theta, 1.0 + 16.0 * F / frame.rim);
        let label = format!("{}\u{b0}", deg.abs());
        area.draw(&Text::new(label, (x, y), small.clone()))?;
    }
    let (x, y) = frame.at(0.0, 0.0);
    area.draw(&PathElement::new(
        [frame.at(-FRAC_PI_2, 1.0), frame.at(FRAC_PI_2, 1.0)],
        stroke(BLACK, 1),
    ))?;
    area.draw(&Text::new(label.to_owned(), (x, y + FINE * 28), small))
}

/// A line through `places` in the style of `curve`: dashes and dots are evenly long on paper.
fn draw_line<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    places: &[(i32, i32)],
    curve: &Curve,
) -> Result<(), Failed<B>> {
    let color = RGBColor(curve.color[0], curve.color[1], curve.color[2]);
    let style = stroke(color, 2);
    match curve.stroke {
        Stroke::Solid => area.draw(&PathElement::new(places.to_vec(), style))?,
        Stroke::Dashed => {
            for dash in dashes(places, F * 8.0, F * 5.0) {
                area.draw(&PathElement::new(dash, style))?;
            }
        }
        Stroke::Dots => {
            for dot in dashes(places, 0.0, F * 5.0) {
                area.draw(&Circle::new(dot[0], FINE * 3 / 2, color.filled()))?;
            }
        }
    }
    Ok(())
}

/// Pieces of a line, `on` long, with gaps of `off` between them; of length 0, single places.
fn dashes(places: &[(i32, i32)], on: f64, off: f64) -> Vec<Vec<(i32, i32)>> {
    let mut pieces: Vec<Vec<(i32, i32)>> = Vec::new();
    let (mut drawing, mut left) = (true, on);
    let mut piece: Vec<(i32, i32)> = places.iter().take(1).copied().collect();
    for pair in places.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let length = f64::from(to.0 - from.0).hypot(f64::from(to.1 - from.1));
        let at = |s: f64| {
            let along = |a: i32, b: i32| a + (f64::from(b - a) * s / length).round() as i32;
            (along(from.0, to.0), along(from.1, to.1))
        };
        let mut gone = 0.0;
        while gone + left < length {
            gone += left;
            if drawing {
                piece.push(at(gone));
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![at(gone)];
            }
            drawing = !drawing;
            left = if drawing { on } else { off };
        }
        left -= length - gone;
        if drawing {
            piece.push(to);
        }
    }
    if drawing && piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

fn draw_legend_entry<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    frame: &Frame,
    curve: &Curve,
    entry: i32,
) -> Result<(), Failed<B>> {
    let width = area.dim_in_pixel().0.cast_signed();
    let columns = LEGEND_COLUMNS;
    let (column, row) = (entry % columns, entry / columns);
    let x = FINE * 24 + column * (width - FINE * 40) / columns;
    let y = frame.at(0.0, 0.0).1 + FINE * (54 + 20 * row);
    draw_line(area, &[(x, y), (x + FINE * 34, y)], curve)?;
    let place = (x + FINE * 42, y - FINE * 7);
    area.draw(&Text::new(curve.label.clone(), place, text(13)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lobe(scale: f64) -> Curve {
        let points = (-90..=90)
            .map(|d| f64::from(d).to_radians())
            .map(|t| (t, scale * t.cos().powi(8)))
            .collect();
        Curve {
            label: "lobe".into(),
            color: crate::palette(0),
            stroke: Stroke::Solid,
            points,
        }
    }

    #[test]
    fn normal_points_up_and_right_is_positive() {
        let frame = Frame {
            center: (100.0, 100.0),
            rim: 50.0,
            max: 2.0,
            radius: Radius::Linear,
        };
        assert_eq!(frame.place(0.0, 2.0), (100, 50));
        assert_eq!(frame.place(90_f64.to_radians(), 1.0), (125, 100));
    }

    #[test]
    fn log_radius_counts_decades() {
        let frame = Frame {
            center: (0.0, 0.0),
            rim: 100.0,
            max: 10.0,
            radius: Radius::Log { decades: 4.0 },
        };
        assert_eq!(frame.place(0.0, 0.1), (0, -50));
        assert_eq!(
            frame.place(0.0, 1e-9),
            (0, 0),
            "below the last decade: the centre"
        );
    }

    #[test]
    fn black_material_is_an_error_and_others_draw() {
        let plot = |scale| PolarPlot {
            title: "t".into(),
            radius_label: "1/sr".into(),
            radius: Radius::Linear,
            curves: vec![lobe(scale)],
            incident: vec![(-0.5, [0, 0, 0])],
        };
        assert!(plot(0.0).svg(400).is_err(), "nothing positive");
        let svg = plot(1.0).svg(400).unwrap();
        assert!(
            crate::png(&svg, 1.0).unwrap().starts_with(b"\x89PNG"),
            "a PNG file"
        );
    }

    #[test]
    fn rings_are_round_numbers() {
        let rings = |max, radius| {
            let frame = Frame {
                center: (0.0, 0.0),
                rim: 100.0,
                max,
                radius,
            };
            let labels = frame.rings().into_iter().map(|r| r.1);
            labels.collect::<Vec<_>>().join(" ")
        };
        assert_eq!(rings(19.083, Radius::Linear), "5 10 15");
        assert_eq!(rings(0.08, Radius::Linear), "0.02 0.04 0.06 0.08");
        let log = Radius::Log { decades: 4.0 };
        assert_eq!(rings(0.4988, log), "0.1 0.01 0.001 1.0e-4");
    }

    #[test]
    fn dashes_are_evenly_long() {
        let line = [(0, 0), (7, 0), (100, 0)];
        let ends: Vec<_> = dashes(&line, 30.0, 20.0)
            .iter()
            .map(|d| (d[0].0, d[d.len() - 1].0))
            .collect();
        assert_eq!(ends, [(0, 30), (50, 80)]);
        let dots = dashes(&line, 0.0, 40.0);
        assert_eq!(dots.iter().map(|d| d[0].0).collect::<Vec<_>>(), [0, 40, 80]);
    }
}
