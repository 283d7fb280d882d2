//! Which incidences of a file a known direction lies between.

/// Axes of incidence: azimuths and polar angles in radians, ascending, neither empty.
#[derive(Clone, Debug)]
pub(crate) struct Incidences {
    phi: Vec<f64>,
    theta: Vec<f64>,
}

/// Up to four incidences and their weights, which sum to 1.
pub(crate) type Slices = [(usize, f64); 4];

impl Incidences {
    pub(crate) fn new(phi: &[f32], theta: &[f32]) -> Self {
        let wide = |v: &[f32]| v.iter().copied().map(f64::from).collect();
        Self {
            phi: wide(phi),
            theta: wide(theta),
        }
    }

    /// How many incidences there are.
    pub(crate) fn count(&self) -> usize {
        self.phi.len() * self.theta.len()
    }

    /// Polar angles, ascending.
    pub(crate) fn theta(&self) -> &[f64] {
        &self.theta
    }

    /// True if there is but one azimuth.
    pub(crate) fn isotropic(&self) -> bool {
        self.phi.len() == 1
    }

    /// Incidences around (phi, theta), weighted bilinearly; beyond the ends the end itself.
    pub(crate) fn around(&self, phi: f64, theta: f64) -> Slices {
        let (p0, p1, p) = bracket(&self.phi, phi);
        let (t0, t1, t) = bracket(&self.theta, theta);
        let n = self.theta.len();
        [
            (p0 * n + t0, (1.0 - p) * (1.0 - t)),
            (p0 * n + t1, (1.0 - p) * t),
            (p1 * n + t0, p * (1.0 - t)),
            (p1 * n + t1, p * t),
        ]
    }
}

/// Neighbours of `x` among ascending `knots`, and the weight of the upper one.
fn bracket(knots: &[f64], x: f64) -> (usize, usize, f64) {
    let last = knots.len() - 1;
    let upper = knots
        .partition_point(|k| *k <= x)
        .clamp(1, last.max(1))
        .min(last);
    let lower = upper.saturating_sub(1);
    let width = knots[upper] - knots[lower];
    let t = if width > 0.0 {
        (x - knots[lower]) / width
    } else {
        0.0
    };
    (lower, upper, t.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::Incidences;

    #[test]
    fn weights_sum_to_one_and_reproduce_the_angle() {
        let axis = Incidences::new(&[0.0], &[0.0, 0.5, 1.5]);
        for k in 0..=30 {
            let theta = f64::from(k) * 0.05;
            let around = axis.around(0.3, theta);
            let (mut weight, mut mean) = (0.0, 0.0);
            for (slice, w) in around {
                weight += w;
                mean += w * [0.0, 0.5, 1.5][slice];
            }
            assert!((weight - 1.0).abs() < 1e-15, "weights of {theta}: {weight}");
            assert!((mean - theta).abs() < 1e-7, "{theta} came back as {mean}");
        }
    }
}
