//! The CIEDE2000 colour difference.

use std::f64::consts::{PI, TAU};

/// CIEDE2000 of two L*a*b* colours with all parametric factors 1, in the corrected form of [Sharma2005]
/// (equation numbers are theirs).
#[must_use]
pub fn ciede2000(lab1: [f64; 3], lab2: [f64; 3]) -> f64 {
    let chroma = |lab: [f64; 3]| lab[1].hypot(lab[2]);
    // 2 to 7: a is stretched so that greys keep their hue
    let g = 0.5 * (1.0 - saturate(0.5 * (chroma(lab1) + chroma(lab2))));
    let (c1, h1) = polar(lab1, g);
    let (c2, h2) = polar(lab2, g);
    // 8 to 11: differences
    let turn = hue_difference(c1 * c2, h2 - h1);
    let delta_l = lab2[0] - lab1[0];
    let delta_c = c2 - c1;
    let delta_h = 2.0 * (c1 * c2).sqrt() * (0.5 * turn).sin();
    // 12 to 14: means
    let l = 0.5 * (lab1[0] + lab2[0]);
    let c = 0.5 * (c1 + c2);
    let h = mean_hue(c1 * c2, h1, h2);
    // 15 to 21: weights and rotation
    let t = 1.0 - 0.17 * (h - radians(30.0)).cos()
        + 0.24 * (2.0 * h).cos()
        + 0.32 * (3.0 * h + radians(6.0)).cos()
        - 0.20 * (4.0 * h - radians(63.0)).cos();
    let l50 = (l - 50.0).powi(2);
    let s_l = 1.0 + 0.015 * l50 / (20.0 + l50).sqrt();
    let s_c = 1.0 + 0.045 * c;
    let s_h = 1.0 + 0.015 * c * t;
    let theta = radians(30.0) * (-((h.to_degrees() - 275.0) / 25.0).powi(2)).exp();
    let r_t = -(2.0 * theta).sin() * 2.0 * saturate(c);
    // 22
    let (l, c, h) = (delta_l / s_l, delta_c / s_c, delta_h / s_h);
    (l * l + c * c + h * h + r_t * c * h).max(0.0).sqrt()
}

fn radians(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// sqrt(c^7 / (c^7 + 25^7)).
fn saturate(c: f64) -> f64 {
    let c7 = c.powi(7);
    let k = 25_f64.powi(7);
    (1.0 / (1.0 + k / c7)).sqrt()
}

/// Chroma and hue in [0, 2 pi) with a scaled by 1 + g; hue 0 for greys.
fn polar([_, a, b]: [f64; 3], g: f64) -> (f64, f64) {
    let a = a * (1.0 + g);
    let h = b.atan2(a);
    let h = if h < 0.0 { h + TAU } else { h };
    (a.hypot(b), h)
}

/// Hues this close to opposite, in radians, are taken as opposite: which way round is then a convention, not
/// a question of rounding.
const TIE: f64 = 1e-12;

/// 10: the shorter way round from hue 1 to 2, (-pi, pi]; 0 if either colour is grey.
fn hue_difference(chromas: f64, difference: f64) -> f64 {
    if chromas.abs() == 0.0 {
        0.0
    } else if difference > PI + TIE {
        difference - TAU
    } else if difference < -PI - TIE {
        difference + TAU
    } else {
        difference
    }
}

/// 14: the hue in the middle of the shorter way; that of the other colour if one is grey.
fn mean_hue(chromas: f64, h1: f64, h2: f64) -> f64 {
    let sum = h1 + h2;
    if chromas.abs() == 0.0 {
        sum
    } else if (h1 - h2).abs() <= PI + TIE {
        0.5 * sum
    } else if sum < TAU {
        0.5 * (sum + TAU)
    } else {
        0.5 * (sum - TAU)
    }
}
