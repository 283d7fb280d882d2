//! Slices of the viewer: elevations dense at grazing and, for anisotropic targets, azimuths.
//!
//! tau = (1 - u)(1 + K u) with u = sqrt(cos theta_o) (1 - A s + B s^2), s = sin theta_o: 0 at the normal, where it is
//! linear in theta_o, 1 at the horizon, where it goes as the root of the elevation. The square keeps u within 0.003 of
//! (1 - s)^(1/4) without two roots that wait for the one in s. Slices are even in tau; between them densities blend linearly.

/// Moves slices from the horizon toward the normal; by measurement.
const K: f32 = 0.3;
/// (1 + s)^(-1/4) at 0, 1/2 and 1.
const A: f32 = 0.2265;
const B: f32 = 0.0674;

/// tau of a viewer with sine `s` and cosine `c` of theta_o.
#[inline(always)]
pub(crate) fn tau(s: f32, c: f32) -> f32 {
    let u = c.sqrt() * (1.0 - s * (A - B * s));
    (1.0 - u).max(0.0) * (1.0 + K * u)
}

/// Sine and cosine of theta_o at `tau` in [0, 1].
pub(crate) fn viewer(tau: f64) -> (f64, f64) {
    let [k, a, b] = [K, A, B].map(f64::from);
    // K u^2 + (1 - K) u = 1 - tau
    let rest = 1.0 - tau;
    let wanted = 2.0 * rest / ((1.0 - k) + ((1.0 - k).powi(2) + 4.0 * k * rest).sqrt());
    // u grows with the elevation
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..60 {
        let mid = 0.5 * (low + high);
        let (c, s) = f64::sin_cos(mid);
        if c.sqrt() * (1.0 - s * (a - b * s)) < wanted {
            low = mid;
        } else {
            high = mid;
        }
    }
    let (c, s) = f64::sin_cos(high);
    (s, c)
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
            let back = f64::from(tau(s as f32, c as f32));
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
