//! What the plots show of a material: in-plane lobes, slices and albedo, as numbers.

use crate::load::brdf_scale;
use brdf::{HalfDiff, Measured, direction};
use brdf_table::directional_albedo;
use glam::DVec3;
use plot::{Color, Curve, Stroke, palette};
use spectrum::{Basis, Observer, linear_srgb_from_xyz, srgb_encode};
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of an in-plane lobe from -90 to 90 degrees: a quarter degree.
const LOBE_STEPS: i32 = 720;
/// Rings of the albedo quadrature for grids: two a theta_h cell of a MERL table.
const GRID_RINGS: usize = 180;
/// Rings for scattered rows, whose smooth surface is slow to evaluate and has no features narrower than their own rings.
const ROW_RINGS: usize = 64;
/// Most bands of a spectrum that are drawn.
const BANDS: usize = 5;

/// All channels as the file has them, in the plane of incidence.
fn native(material: &dyn Measured, theta_i: f64, theta_o: f64) -> Vec<f64> {
    let mut out = vec![0.0; material.basis().len()];
    let (wi, wo) = in_plane(theta_i, theta_o);
    material.eval_native(wi, wo, &mut out);
    out
}

/// Light from the left (phi = 180 degrees), so that the mirror direction is at +theta_i.
fn in_plane(theta_i: f64, theta_o: f64) -> (DVec3, DVec3) {
    let wi = direction(theta_i, PI);
    let wo = direction(theta_o.abs(), if theta_o < 0.0 { PI } else { 0.0 });
    (wi, wo)
}

/// Which channels to draw, and how: three for colour, up to five bands spread over a spectrum.
pub(crate) fn shown_channels(basis: &Basis) -> Vec<(usize, String, Color)> {
    let names = basis.names();
    let count = basis.len().min(BANDS);
    let at = |k: usize| k * basis.len().saturating_sub(1) / count.saturating_sub(1).max(1);
    (0..count)
        .map(|k| {
            let color = match basis {
                Basis::Rgb(_) => [[200, 30, 30], [20, 140, 40], [40, 70, 210]][at(k)],
                Basis::Bands(nm) => wavelength_color(nm[at(k)]),
                _ => palette(k),
            };
            (at(k), names[at(k)].clone(), color)
        })
        .collect()
}

/// A colour to tell a wavelength by: its hue, dark enough for white paper, darker toward the ends of the spectrum,
/// where hues hardly change. Grey where nothing is seen.
fn wavelength_color(nm: f64) -> Color {
    let seen = linear_srgb_from_xyz(Observer::CIE_1931.at(nm)).map(|v| v.max(0.0));
    let most = seen.into_iter().fold(0.0, f64::max);
    if most <= 0.0 {
        return [90, 90, 90];
    }
    let toward_ends = ((nm - 550.0).abs() - 60.0).max(0.0);
    let level = (0.7 - 0.0055 * toward_ends).max(0.08) / most;
    // saturated greens and yellows are too bright for thin lines
    let green = 0.55;
    let linear = [seen[0], green * seen[1], seen[2]];
    linear.map(|v| (255.0 * srgb_encode((v * level).min(1.0))).round() as u8)
}

/// One in-plane lobe a channel, for light at `theta_i` radians.
pub(crate) fn lobes(material: &dyn Measured, theta_i: f64) -> Vec<Curve> {
    let scale = brdf_scale(material.basis());
    let rows = lobe_angles().map(|t| (t, native(material, theta_i, t)));
    by_channel(material, scale, rows)
}

/// A curve for each shown channel from rows of all channels; one for all of them where they are the same.
fn by_channel(
    material: &dyn Measured,
    scale: f64,
    rows: impl Iterator<Item = (f64, Vec<f64>)>,
) -> Vec<Curve> {
    let shown = shown_channels(material.basis());
    let named = |(_, name, color): &(usize, String, Color)| curve(name, *color, Vec::new());
    let mut curves: Vec<Curve> = shown.iter().map(named).collect();
    for (x, values) in rows {
        for (curve, (c, ..)) in curves.iter_mut().zip(&shown) {
            curve.points.push((x, scale * values[*c]));
        }
    }
    if curves.iter().all(|c| c.points == curves[0].points) && curves.len() > 1 {
        let points = curves.swap_remove(0).points;
        return vec![curve("all channels", [40, 40, 40], points)];
    }
    curves
}

fn curve(label: &str, color: Color, points: Vec<(f64, f64)>) -> Curve {
    Curve {
        label: label.into(),
        color,
        stroke: Stroke::Solid,
        points,
    }
}

/// The in-plane lobe of the luminance, to overlay several materials.
pub(crate) fn luminance_lobe(
    material: &dyn Measured,
    label: &str,
    theta_i: f64,
    color: Color,
) -> Curve {
    let weights = material.basis().luminance_weights();
    let points = lobe_angles()
        .map(|t| (t, dot(&native(material, theta_i, t), &weights)))
        .collect();
    curve(label, color, points)
}

/// The in-plane lobe of anything with a value for a pair of directions.
pub(crate) fn lobe_of(
    value: impl Fn(DVec3, DVec3) -> f64,
    label: &str,
    theta_i: f64,
    color: Color,
) -> Curve {
    let points = lobe_angles().map(|t| {
        let (wi, wo) = in_plane(theta_i, t);
        (t, value(wi, wo))
    });
    curve(label, color, points.collect())
}

fn lobe_angles() -> impl Iterator<Item = f64> {
    // half a step inside the horizon at both ends
    (0..LOBE_STEPS).map(|k| (f64::from(k) + 0.5) / f64::from(LOBE_STEPS) * PI - FRAC_PI_2)
}

fn dot(values: &[f64], weights: &[f64]) -> f64 {
    values.iter().zip(weights).map(|(v, w)| v * w).sum()
}

/// Luminance over theta_h (columns, 0 to 90 degrees) and theta_d (rows) at phi_d = 90 degrees, where both directions are
/// above the horizon everywhere (but for rounding: NaN). Square, `n` a side.
pub(crate) fn slice(material: &dyn Measured, n: usize) -> Vec<f64> {
    let weights = material.basis().luminance_weights();
    let mut out = vec![0.0; material.basis().len()];
    let at = |k: usize| (k as f64 + 0.5) / n as f64 * FRAC_PI_2;
    (0..n * n)
        .map(|k| {
            let (wi, wo) = HalfDiff {
                theta_h: at(k % n),
                theta_d: at(k / n),
                phi_d: FRAC_PI_2,
            }
            .directions();
            if wi.z <= 0.0 || wo.z <= 0.0 {
                return f64::NAN;
            }
            material.eval_native(wi, wo, &mut out);
            dot(&out, &weights)
        })
        .collect()
}

/// Directional albedo of each shown channel against theta_o in degrees.
pub(crate) fn albedo(material: &dyn Measured) -> Vec<Curve> {
    by_channel(
        material,
        brdf_scale(material.basis()),
        albedo_rows(material),
    )
}

/// Directional albedo of the luminance against theta_o in degrees.
pub(crate) fn luminance_albedo(material: &dyn Measured, label: &str, color: Color) -> Curve {
    let weights = material.basis().luminance_weights();
    let rows = albedo_rows(material);
    curve(
        label,
        color,
        rows.map(|(x, v)| (x, dot(&v, &weights))).collect(),
    )
}

fn albedo_rows(material: &dyn Measured) -> impl Iterator<Item = (f64, Vec<f64>)> + '_ {
    // what is reciprocal by its layout is a grid
    let grid = material.symmetry().reciprocal;
    let rings = if grid { GRID_RINGS } else { ROW_RINGS };
    let angles = (0..=88).step_by(2).map(f64::from);
    angles.map(move |deg| (deg, directional_albedo(material, deg.to_radians(), rings)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use brdf::{Status, Symmetry};
    use glam::DVec3;
    use spectrum::RgbSpace;

    /// A Lambertian of albedo 0.5 with a mirror-ward lobe in the red channel.
    struct Lobe(Basis);

    impl Measured for Lobe {
        fn basis(&self) -> &Basis {
            &self.0
        }
        fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
            let h = (wi + wo).normalize();
            out.fill(0.5 / PI);
            out[0] += h.z.powi(200);
            Status::Interpolated
        }
        fn symmetry(&self) -> Symmetry {
            Symmetry::FULL
        }
    }

    #[test]
    fn grey_is_one_curve_and_colour_is_three() {
        let grey = brdf_models::parse_model("ggx:alpha=0.2").unwrap();
        let drawn = lobes(&brdf::Computed::new(grey.built.brdf), 0.6);
        assert!(drawn.len() == 1 && drawn[0].label == "all channels");
        assert_eq!(lobes(&Lobe(Basis::Rgb(RgbSpace::srgb())), 0.6).len(), 3);
    }

    #[test]
    fn lobe_peaks_at_the_mirror_direction() {
        let curves = lobes(&Lobe(Basis::Rgb(RgbSpace::srgb())), 0.6);
        let peak = curves[0]
            .points
            .iter()
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        // the step is a quarter degree
        assert!((peak.0 - 0.6).abs() < 0.005, "{peak:?}");
        assert_eq!(curves.len(), 3, "one a channel");
    }

    #[test]
    fn slice_falls_off_from_the_mirror_and_is_whole() {
        let values = slice(&Lobe(Basis::Rgb(RgbSpace::srgb())), 16);
        assert!(values.iter().all(|v| v.is_finite()), "holes");
        // theta_h grows along a row; the lobe is narrower than a few of its columns
        let diffuse = 0.5 / PI;
        assert!(values[0] > 1.2 * diffuse, "{}", values[0]);
        assert!((values[8] / diffuse - 1.0).abs() < 1e-12, "{}", values[8]);
    }

    #[test]
    fn bands_are_thinned_to_five() {
        let shown = shown_channels(&Basis::Bands(
            (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect(),
        ));
        let names: Vec<&str> = shown.iter().map(|s| s.1.as_str()).collect();
        assert_eq!(names, ["400nm", "470nm", "550nm", "620nm", "700nm"]);
    }

    #[test]
    fn lobes_are_on_the_scale_of_a_brdf() {
        let trinitron = RgbSpace::trinitron();
        let scale = trinitron.white_level;
        let curves = lobes(&Lobe(Basis::Rgb(trinitron)), 0.6);
        let blue = curves[2].points[360].1;
        assert!((blue - 0.5 / PI / scale).abs() < 1e-12, "{blue}");
    }

    #[test]
    fn wavelengths_have_their_hues() {
        let [blue, green, orange, red] = [470.0, 540.0, 600.0, 700.0].map(wavelength_color);
        assert!(blue[2] > blue[0] && blue[2] > blue[1], "{blue:?}");
        assert!(green[1] > green[0] && green[1] > green[2], "{green:?}");
        assert!(orange[0] > orange[1] && orange[1] > orange[2], "{orange:?}");
        assert!(red[0] > 60 && red[1] == 0 && red[0] < orange[0], "{red:?}");
    }
}
