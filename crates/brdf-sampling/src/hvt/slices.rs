//! Slices of the viewer's elevation, dense at grazing.
//!
//! tau = 1 - sqrt(1 - sqrt(1 - cos theta_o)): 0 at the normal, where it is linear in theta_o, 1 at the
//! horizon, where it goes as the root of the elevation. Slices are even in tau; between them densities blend
//! linearly.

/// tau of the viewer with cosine of theta_o. Near the normal it is good to 1e-8 only, which moves weights
/// between slices, the same in sample and pdf.
#[inline]
pub(crate) fn tau(cos_o: f64) -> f64 {
    let root = (1.0 - cos_o).max(0.0).sqrt();
    1.0 - (1.0 - root).max(0.0).sqrt()
}

/// Sine and cosine of theta_o at `tau` in [0, 1].
pub(crate) fn viewer(tau: f64) -> (f64, f64) {
    let root = tau * (2.0 - tau);
    let cos = 1.0 - root * root;
    (root * (2.0 - root * root).max(0.0).sqrt(), cos)
}

/// d theta_o / d tau: what a viewer at `tau` stands for.
pub(crate) fn spread(tau: f64) -> f64 {
    let root = tau * (2.0 - tau);
    // cos = 1 - root^2, so d theta = 2 root d root / sin = 2 d root / sqrt(2 - root^2)
    4.0 * (1.0 - tau) / (2.0 - root * root).sqrt()
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
            assert!((tau(c) - t).abs() < 3e-8, "{t} came back as {}", tau(c));
        }
    }
}
