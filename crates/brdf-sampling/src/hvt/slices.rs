//! Slices of the viewer: elevations dense at grazing and, for anisotropic targets, azimuths.
//!
//! With u = (1 - sin theta_o)^(1/4), tau = (1 - u)(1 + K u): 0 at the normal, where it is linear in theta_o, 1 at the
//! horizon, where it goes as the root of the elevation. Slices are even in tau; between them densities blend linearly.
//! What is fourth root here is one square root of a cosine the chart has at hand.

/// Moves slices from the horizon toward the normal; by measurement.
const K: f64 = 0.3;

/// tau of the viewer whose chart ends at the given cosine of theta_h, sqrt((1 - sin theta_o) / 2).
#[inline]
pub(crate) fn tau(min_cos_h: f64) -> f32 {
    tau_f32(min_cos_h as f32)
}

#[inline(always)]
pub(crate) fn tau_f32(min_cos_h: f32) -> f32 {
    let u = (min_cos_h * std::f32::consts::SQRT_2).sqrt();
    (1.0 - u).max(0.0) * (1.0 + K as f32 * u)
}

/// Sine and cosine of theta_o at `tau` in [0, 1].
pub(crate) fn viewer(tau: f64) -> (f64, f64) {
    // K u^2 + (1 - K) u = 1 - tau
    let rest = 1.0 - tau;
    let u = 2.0 * rest / ((1.0 - K) + ((1.0 - K).powi(2) + 4.0 * K * rest).sqrt());
    // 1 - sin theta_o
    let x = u.powi(4);
    (1.0 - x, (x * (2.0 - x)).sqrt())
}

/// d theta_o / d tau: what a viewer at `tau` stands for.
pub(crate) fn spread(tau: f64) -> f64 {
    let (low, high) = ((tau - 1e-4).max(0.0), (tau + 1e-4).min(1.0));
    let theta = |tau| {
        let (sin, cos) = viewer(tau);
        sin.atan2(cos)
    };
    (theta(high) - theta(low)) / (high - low)
}

/// The slice below, and the weight of the one above.
#[inline]
pub(crate) fn blend(x: f64, n: usize) -> (usize, f64) {
    let x = x * (n - 1) as f64;
    let k = (x as usize).min(n - 2);
    (k, x - k as f64)
}

/// Azimuth of the direction (x, y) in turns, [0, 1], within 0.004: quarters are exact and each is filled by a cubic
/// that bends the ratio y / (|x| + |y|) toward the angle. Continuous, increasing, and the same in sample and pdf, which
/// is all that slices ask of it.
#[inline(always)]
pub(crate) fn pseudo_turns(x: f32, y: f32) -> f32 {
    let sum = (x.abs() + y.abs()).max(f32::MIN_POSITIVE);
    let d = y.abs() / sum;
    let quarter = d - 0.363 * d * (1.0 - d) * (1.0 - 2.0 * d);
    let half = if x >= 0.0 { quarter } else { 2.0 - quarter };
    0.25 * if y >= 0.0 { half } else { 4.0 - half }
}

#[cfg(test)]
mod tests {
    use super::{pseudo_turns, spread, tau, viewer};
    use std::f64::consts::{FRAC_PI_2, TAU};

    #[test]
    fn tau_inverts_viewer() {
        for k in 0..=100 {
            let t = f64::from(k) / 100.0;
            let (s, c) = viewer(t);
            assert!((s * s + c * c - 1.0).abs() < 1e-14, "unit at {t}");
            let back = f64::from(tau((0.5 - 0.5 * s).max(0.0).sqrt()));
            // a few roundings of f32
            assert!((back - t).abs() < 5e-7, "{t} came back as {back}");
        }
    }

    #[test]
    fn spreads_add_up_to_a_right_angle() {
        let n = 1000;
        let sum: f64 = (0..n)
            .map(|k| spread((f64::from(k) + 0.5) / f64::from(n)))
            .sum();
        assert!((sum / f64::from(n) - FRAC_PI_2).abs() < 1e-4, "{sum}");
    }

    #[test]
    fn pseudo_turns_stay_near_turns_and_increase() {
        let mut last = -1.0;
        for k in 0..4000 {
            let turns = f64::from(k) / 4000.0;
            let (s, c) = (TAU * turns).sin_cos();
            let p = pseudo_turns(c as f32, s as f32);
            assert!((f64::from(p) - turns).abs() < 4e-3, "{turns} became {p}");
            assert!(p > last, "not increasing at {turns}");
            last = p;
        }
    }
}
