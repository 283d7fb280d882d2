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

/// Where things lie, in SVG units.
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
            Radius::Linear => (1..=4)
                .map(|k| self.max * f64::from(k) / 4.0)
                .map(|v| (v, short(v)))
                .collect(),
            Radius::Log { decades } => {
                let top = self.max.log10();
                let mut rings = vec![(self.max, short(self.max))];
                // a ring closer to the rim than its label is wide would be unreadable
                let mut exponent = (top - 0.06 * decades).floor();
                while exponent > top - decades {
                    rings.push((10_f64.powf(exponent), format!("1e{exponent}")));
                    exponent -= (decades / 6.0).ceil();
                }
                rings
            }
        }
    }
}

fn short(value: f64) -> String {
    if (1e-2..1e4).contains(&value) {
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
        let legend = 20
            * u32::try_from(
                self.curves
                    .iter()
                    .filter(|c| !c.label.is_empty())
                    .count()
                    .div_ceil(3),
            )
            .unwrap_or(0);
        let rim = f64::from(width) / 2.0 - 48.0;
        let frame = Frame {
            center: (f64::from(width) / 2.0, rim + 72.0),
            rim,
            max,
            radius: self.radius,
        };
        let mut out = String::new();
        {
            let area = SVGBackend::with_string(&mut out, (width, width / 2 + 64 + legend))
                .into_drawing_area();
            self.draw(&area, &frame).map_err(PlotError::new)?;
            area.present().map_err(PlotError::new)?;
        }
        Ok(out)
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        frame: &Frame,
    ) -> Result<(), Failed<B>> {
        area.fill(&WHITE)?;
        let width = area.dim_in_pixel().0.cast_signed();
        let title = TextStyle::from(("sans-serif", 20)).pos(centered());
        area.draw(&Text::new(self.title.clone(), (width / 2, 18), title))?;
        draw_grid(area, frame, &self.radius_label)?;
        for (theta, color) in &self.incident {
            let color = RGBColor(color[0], color[1], color[2]);
            area.draw(&PathElement::new(
                [frame.at(*theta, 1.04), frame.at(*theta, 0.0)],
                color.mix(0.6).stroke_width(1),
            ))?;
            area.draw(&Circle::new(frame.at(*theta, 1.04), 4, color.filled()))?;
        }
        let mut entry = 0;
        for curve in &self.curves {
            draw_curve(area, frame, curve)?;
            if !curve.label.is_empty() {
                draw_legend_entry(area, frame, curve, entry)?;
                entry += 1;
            }
        }
        Ok(())
    }
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
    let faint = BLACK.mix(0.18).stroke_width(1);
    let text = TextStyle::from(("sans-serif", 12)).pos(centered());
    for (value, label) in frame.rings() {
        let arc: Vec<_> = (-90..=90)
            .map(|deg| frame.place(f64::from(deg).to_radians(), value))
            .collect();
        let (x, y) = frame.place(90_f64.to_radians(), value);
        area.draw(&PathElement::new(arc, faint))?;
        area.draw(&Text::new(label, (x, y + 12), text.clone()))?;
    }
    for deg in (-90_i32..=90).step_by(15) {
        let theta = f64::from(deg).to_radians();
        area.draw(&PathElement::new(
            [frame.at(theta, 0.0), frame.at(theta, 1.0)],
            faint,
        ))?;
        let (x, y) = frame.at(theta, 1.0 + 16.0 / frame.rim);
        area.draw(&Text::new(format!("{}", deg.abs()), (x, y), text.clone()))?;
    }
    let (x, y) = frame.at(0.0, 0.0);
    area.draw(&PathElement::new(
        [frame.at(-FRAC_PI_2, 1.0), frame.at(FRAC_PI_2, 1.0)],
        BLACK.stroke_width(1),
    ))?;
    area.draw(&Text::new(label.to_owned(), (x, y + 28), text))
}

fn draw_curve<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    frame: &Frame,
    curve: &Curve,
) -> Result<(), Failed<B>> {
    let color = RGBColor(curve.color[0], curve.color[1], curve.color[2]);
    for run in curve.runs(|p| p.1.is_finite()) {
        let places: Vec<_> = run
            .iter()
            .map(|(theta, value)| frame.place(*theta, value.max(0.0)))
            .collect();
        match curve.stroke {
            Stroke::Solid => area.draw(&PathElement::new(places, color.stroke_width(2)))?,
            Stroke::Dashed => {
                for pair in places.chunks(2).filter(|pair| pair.len() == 2) {
                    area.draw(&PathElement::new(pair.to_vec(), color.stroke_width(2)))?;
                }
            }
            Stroke::Dots => {
                for place in places {
                    area.draw(&Circle::new(place, 2, color.filled()))?;
                }
            }
        }
    }
    Ok(())
}

fn draw_legend_entry<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    frame: &Frame,
    curve: &Curve,
    entry: i32,
) -> Result<(), Failed<B>> {
    let width = area.dim_in_pixel().0.cast_signed();
    let (column, row) = (entry % 3, entry / 3);
    let x = 24 + column * (width - 40) / 3;
    let y = frame.at(0.0, 0.0).1 + 50 + 20 * row;
    let color = RGBColor(curve.color[0], curve.color[1], curve.color[2]);
    area.draw(&PathElement::new(
        [(x, y), (x + 20, y)],
        color.stroke_width(3),
    ))?;
    area.draw(&Text::new(
        curve.label.clone(),
        (x + 26, y - 7),
        TextStyle::from(("sans-serif", 13)),
    ))
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
}
