//! Slices of the viewer's elevation, dense at grazing.
//!
//! tau = 1 - sqrt(1 - sqrt(1 - cos theta_o)): 0 at the normal, where it is linear in theta_o, 1 at the
//! horizon, where it goes as the root of the elevation. Slices are even in tau; between them densities blend
//! linearly.

/// tau of the viewer with sine and cosine of theta_o; 1 - cos = sin^2 / (1 + cos) keeps its digits.
#[inline]
pub(crate) fn tau(sin_o: f64, cos_o: f64) -> f64 {
    let root = sin_o / (1.0 + cos_o).sqrt();
    1.0 - (1.0 - root).max(0.0).sqrt()
}

/// Sine and cosine of theta_o at `tau` in [0, 1].
pub(crate) fn viewer(tau: f64) -> (f64, f64) {
    let root = tau * (2.0 - tau);
    let cos = 1.0 - root * root;
    (root * (2.0 - root * root).max(0.0).sqrt(), cos)
}

/// The slice below, and the weight of the one above.
#[inline]
pub(crate) fn blend(tau: f64, n: usize) -> (usize, f64) {
    let x = tau * (n - 1) as f64;
    let k = (x as usize).min(n - 2);
    (k, x - k as f64)
}

#[cfg(test)]
mod tests {
    use super::{tau, viewer};

    #[test]
    fn tau_inverts_viewer() {
        for k in 0..=100 {
            let t = f64::from(k) / 100.0;
            let (s, c) = viewer(t);
            assert!((s * s + c * c - 1.0).abs() < 1e-14, "unit at {t}");
            // a square root of the rounding of 1 - root, near the horizon
            assert!((tau(s, c) - t).abs() < 3e-8, "{t} came back as {}", tau(s, c));
        }
    }
}
