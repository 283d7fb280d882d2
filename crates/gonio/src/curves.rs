//! What the plots show of a material: in-plane lobes, slices and albedo, as numbers.

use brdf::{HalfDiff, Measured, direction};
use brdf_table::directional_albedo;
use plot::{Color, Curve, Stroke, palette};
use spectrum::Basis;
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of an in-plane lobe from -90 to 90 degrees: a quarter degree.
const LOBE_STEPS: i32 = 720;
/// Rings of the albedo quadrature: two a theta_h cell of a MERL table.
const ALBEDO_RINGS: usize = 180;

/// Evaluates all channels; `None` at and below the horizon.
fn channels(material: &dyn Measured, theta_i: f64, theta_o: f64) -> Vec<f64> {
    let mut out = vec![0.0; material.basis().len()];
    // light from the left (phi = 180 degrees), so that the mirror direction is at +theta_i
    let wi = direction(theta_i, PI);
    let wo = direction(theta_o.abs(), if theta_o < 0.0 { PI } else { 0.0 });
    material.eval_native(wi, wo, &mut out);
    out
}

/// Which channels to draw, and how: three for colour, up to five bands spread over a spectrum.
pub(crate) fn shown_channels(basis: &Basis) -> Vec<(usize, String, Color)> {
    let names = basis.names();
    match basis {
        Basis::Rgb(_) => [[200, 30, 30], [20, 140, 40], [40, 70, 210]]
            .into_iter()
            .enumerate()
            .map(|(c, k)| (c, names[c].clone(), k))
            .collect(),
        _ => {
            let count = basis.len().min(5);
            let at = |k: usize| {
                if count < 2 {
                    0
                } else {
                    k * (basis.len() - 1) / (count - 1)
                }
            };
            (0..count)
                .map(|k| (at(k), names[at(k)].clone(), palette(k)))
                .collect()
        }
    }
}

/// One in-plane lobe a channel, for light at `theta_i` radians.
pub(crate) fn lobes(material: &dyn Measured, label: &str, theta_i: f64) -> Vec<Curve> {
    let mut curves: Vec<Curve> = shown_channels(material.basis())
        .into_iter()
        .map(|(_, name, color)| Curve {
            label: format!("{label} {name}"),
            color,
            stroke: Stroke::Solid,
            points: Vec::new(),
        })
        .collect();
    let shown = shown_channels(material.basis());
    for theta_o in lobe_angles() {
        let values = channels(material, theta_i, theta_o);
        for (curve, (c, ..)) in curves.iter_mut().zip(&shown) {
            curve.points.push((theta_o, values[*c]));
        }
    }
    curves
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
        .map(|t| (t, dot(&channels(material, theta_i, t), &weights)))
        .collect();
    Curve {
        label: label.into(),
        color,
        stroke: Stroke::Solid,
        points,
    }
}

fn lobe_angles() -> impl Iterator<Item = f64> {
    // half a step inside the horizon at both ends
    (0..LOBE_STEPS).map(|k| (f64::from(k) + 0.5) / f64::from(LOBE_STEPS) * PI - FRAC_PI_2)
}

fn dot(values: &[f64], weights: &[f64]) -> f64 {
    values.iter().zip(weights).map(|(v, w)| v * w).sum()
}

/// Luminance over theta_h (columns, 0 to 90 degrees) and theta_d (rows) at phi_d = 90 degrees, where both directions are
/// above the horizon; NaN elsewhere. Square, `n` a side.
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
pub(crate) fn albedo(material: &dyn Measured, label: &str) -> Vec<Curve> {
    let shown = shown_channels(material.basis());
    let mut curves: Vec<Curve> = shown
        .iter()
        .map(|(_, name, color)| Curve {
            label: format!("{label} {name}"),
            color: *color,
            stroke: Stroke::Solid,
            points: Vec::new(),
        })
        .collect();
    for theta_deg in (0..=88).step_by(2).map(f64::from) {
        let values = directional_albedo(material, theta_deg.to_radians(), ALBEDO_RINGS);
        for (curve, (c, ..)) in curves.iter_mut().zip(&shown) {
            curve.points.push((theta_deg, values[*c]));
        }
    }
    curves
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
    fn lobe_peaks_at_the_mirror_direction() {
        let curves = lobes(&Lobe(Basis::Rgb(RgbSpace::srgb())), "x", 0.6);
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
    fn slice_is_nan_below_the_horizon() {
        let values = slice(&Lobe(Basis::Rgb(RgbSpace::srgb())), 16);
        assert!(
            values[0].is_finite() && values[255].is_nan(),
            "corner values"
        );
    }

    #[test]
    fn bands_are_thinned_to_five() {
        let shown = shown_channels(&Basis::Bands(
            (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect(),
        ));
        let names: Vec<&str> = shown.iter().map(|s| s.1.as_str()).collect();
        assert_eq!(names, ["400nm", "470nm", "550nm", "620nm", "700nm"]);
    }
}
