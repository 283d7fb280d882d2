//! Smith's shadowing of Gaussian surfaces [Smith1967], free of the division by the cosine.

use crate::elementary::gauss_and_erfc;
use glam::DVec3;
use std::f64::consts::FRAC_2_SQRT_PI;

/// What Smith's theory says about one direction over a surface of rms slope m / sqrt 2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Smith {
    /// erfc(q), q = cot(theta) / m: twice the share of facets that face away.
    pub(crate) erfc_q: f64,
    /// G1 / cos(theta) = 1 / (cos (1 + Lambda)), finite at the horizon.
    pub(crate) g1_over_cos: f64,
    /// tan(theta).
    pub(crate) tan: f64,
}

impl Smith {
    /// The direction `w`, above the horizon, and the roughness `m` > 0.
    #[inline(always)]
    pub(crate) fn new(w: DVec3, m: f64) -> Self {
        let (c, s) = (w.z, (w.x * w.x + w.y * w.y).sqrt());
        // beyond 6 erfc is 2e-17, and the terms below are under 1e-17 of c
        let [gauss, erfc_q] = gauss_and_erfc(c / (m * s));
        // Lambda = (exp(-q^2)/(sqrt(pi) q) - erfc(q))/2, times the cosine
        let c_lambda = 0.5 * (gauss * m * s * (0.5 * FRAC_2_SQRT_PI) - c * erfc_q);
        Self {
            erfc_q,
            g1_over_cos: 1.0 / (c + c_lambda.max(0.0)),
            tan: s / c,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Smith;
    use brdf::direction;
    use testkit::assert_relative;

    /// G1 from its definition: over all facets that face the viewer, the visible projected area is the cosine
    /// [Heitz2014, eq. 14]; Gaussian slopes of variance m^2/2, integrated by midpoints.
    fn g1_by_quadrature(theta: f64, m: f64) -> f64 {
        let (s, c) = theta.sin_cos();
        let n = 200_000;
        // slopes to 8 m on both sides; only the slope in the plane of incidence matters
        let step = 16.0 * m / f64::from(n);
        let sum: f64 = (0..n)
            .map(|k| (f64::from(k) + 0.5) * step - 8.0 * m)
            .map(|x| (-(x / m).powi(2)).exp() * (c - x * s).max(0.0))
            .sum();
        let projected = sum * step / (m * std::f64::consts::PI.sqrt());
        c / projected
    }

    #[test]
    fn shadowing_keeps_the_projected_area() {
        for m in [0.05, 0.3, 1.0] {
            for theta in [0.2, 0.8, 1.3, 1.5, 1.57] {
                let g1 = Smith::new(direction(theta, 0.4), m).g1_over_cos * f64::cos(theta);
                // midpoints over a kink: step^2
                assert_relative(g1, g1_by_quadrature(theta, m), 1e-6, "G1");
            }
        }
    }
}
