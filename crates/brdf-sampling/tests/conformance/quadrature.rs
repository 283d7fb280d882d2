//! Integrals over the light's hemisphere, independent of the crate's own chart: half-vector coordinates about the
//! viewer, cut off exactly where the light sinks below the horizon.

use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use testkit::integrate::gauss_legendre;

/// Nodes of the rule in a panel.
const NODES: usize = 6;

/// The integral of `f` over wi above the horizon, by `panels` panels along theta_h and around. Panels grow from
/// `width`, radians, as the hyperbolic sine, and shrink toward the last half vector that keeps wi above the horizon.
pub(crate) fn hemisphere(
    f: impl Fn(DVec3) -> f64,
    wo: DVec3,
    width: f64,
    panels: [usize; 2],
) -> f64 {
    let rule = gauss_legendre(NODES);
    let sin_o = wo.x.hypot(wo.y);
    let phi_o = wo.y.atan2(wo.x);
    let end = 0.5 * (sin_o.atan2(wo.z) + FRAC_PI_2);
    let reach = (end / width).asinh();
    let mut sum = 0.0;
    for (x, wx) in composite(&rule, panels[0]) {
        // x (2 - x) is flat at the end: it takes the square root in the horizon's azimuth away
        let (stretch, slope) = (reach * x * (2.0 - x), reach * 2.0 * (1.0 - x));
        let theta = width * stretch.sinh();
        let (s, c) = theta.sin_cos();
        let phi_max = horizon(sin_o, wo.z, s, c);
        let ring = wx * slope * width * stretch.cosh() * s * phi_max;
        for (y, wy) in composite(&rule, panels[1]) {
            let phi = (2.0 * y - 1.0) * phi_max;
            let h = DVec3::new(s * (phi + phi_o).cos(), s * (phi + phi_o).sin(), c);
            let wo_h = wo.dot(h);
            let wi = 2.0 * wo_h * h - wo;
            if wi.z > 0.0 {
                sum += ring * 2.0 * wy * 4.0 * wo_h * f(wi);
            }
        }
    }
    sum
}

/// The azimuth at which the light is at the horizon: 2 (wo.h) c = cos theta_o.
fn horizon(sin_o: f64, cos_o: f64, s: f64, c: f64) -> f64 {
    let numerator = cos_o * (1.0 - 2.0 * c * c);
    let denominator = 2.0 * sin_o * s * c;
    if numerator <= -denominator {
        return PI;
    }
    (numerator / denominator).clamp(-1.0, 1.0).acos()
}

/// Points in [0, 1] and weights that add to 1.
fn composite(rule: &[(f64, f64)], panels: usize) -> impl Iterator<Item = (f64, f64)> {
    let step = 1.0 / panels as f64;
    (0..panels).flat_map(move |p| {
        rule.iter()
            .map(move |(x, w)| ((p as f64 + 0.5 + 0.5 * x) * step, 0.5 * w * step))
    })
}

#[test]
fn the_rule_knows_hemispheres_and_cosines() {
    for theta in [0.0_f64, 0.7, 1.5] {
        let wo = brdf::direction(theta, 0.4);
        let area = hemisphere(|_| 1.0, wo, 0.01, [48, 12]);
        let cosine = hemisphere(|wi| wi.z, wo, 0.01, [48, 12]);
        // where the horizon first cuts the ring, its azimuth starts as a square root
        assert!((area / (2.0 * PI) - 1.0).abs() < 4e-5, "{theta}: {area}");
        assert!((cosine / PI - 1.0).abs() < 4e-5, "{theta}: {cosine}");
    }
}
