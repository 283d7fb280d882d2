//! One target for several channels: the density that is best for their mean relative variance.

use crate::chart::Chart;
use glam::{DVec2, DVec3};

/// Viewers at which albedos are tabulated, even in theta_o.
const VIEWERS: usize = 46;
/// Quadrature points along the chart's coordinates.
const POINTS: [usize; 2] = [192, 32];
/// Radial scale of the quadrature chart.
const R0: f64 = 2e-3;

/// With g_c = f_c cos of channel c and a_c its directional albedo, p* proportional to sqrt(mean_c (g_c / a_c)^2)
/// minimises the relative variance averaged over channels. This holds the albedos, for isotropic targets.
#[derive(Clone, Debug)]
pub struct ColourTarget<F> {
    f: F,
    /// 1 / a_c by viewer; 0 for channels that reflect nothing.
    inverse_albedo: Vec<Vec<f64>>,
    channels: usize,
}

impl<F: Fn(DVec3, DVec3, &mut [f64])> ColourTarget<F> {
    /// `f` writes f_c(wi, wo) in 1/sr into a slice of `channels` numbers. Integrates every channel for 46 viewers.
    pub fn new(f: F, channels: usize) -> Self {
        let mut target = Self {
            f,
            inverse_albedo: Vec::new(),
            channels,
        };
        target.inverse_albedo = (0..VIEWERS).map(|k| target.inverse_at(k)).collect();
        target
    }

    fn inverse_at(&self, viewer: usize) -> Vec<f64> {
        let theta = viewer as f64 / (VIEWERS - 1) as f64 * 89.8_f64.to_radians();
        let (sin, cos) = theta.sin_cos();
        let (chart, wo) = (Chart::new(sin, cos, R0), DVec3::new(sin, 0.0, cos));
        let [n, m] = POINTS;
        let (mut sum, mut f) = (vec![0.0; self.channels], vec![0.0; self.channels]);
        for k in 0..n * m {
            let ab = DVec2::new(
                ((k / m) as f64 + 0.5) / n as f64,
                ((k % m) as f64 + 0.5) / m as f64,
            );
            let p = chart.forward(ab);
            (self.f)(p.wi, wo, &mut f);
            for (s, v) in sum.iter_mut().zip(&f) {
                if *v > 0.0 && v.is_finite() {
                    *s += v * p.wi.z * p.jacobian / (n * m) as f64;
                }
            }
        }
        let inverse = |a: f64| if a > 0.0 { 1.0 / a } else { 0.0 };
        sum.into_iter().map(inverse).collect()
    }

    /// sqrt(mean_c (f_c / a_c)^2): what to build a sampler for.
    pub fn eval(&self, wi: DVec3, wo: DVec3) -> f64 {
        let mut f = vec![0.0; self.channels];
        (self.f)(wi, wo, &mut f);
        let theta = wo.x.hypot(wo.y).atan2(wo.z);
        let x = (theta / 89.8_f64.to_radians()).clamp(0.0, 1.0) * (VIEWERS - 1) as f64;
        let k = (x as usize).min(VIEWERS - 2);
        let t = x - k as f64;
        let (low, high) = (&self.inverse_albedo[k], &self.inverse_albedo[k + 1]);
        let mut sum = 0.0;
        for (c, v) in f.iter().enumerate() {
            let g = v.max(0.0) * ((1.0 - t) * low[c] + t * high[c]);
            sum += g * g;
        }
        (sum / self.channels.max(1) as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::ColourTarget;
    use crate::{Hvt, Preset, Target, relative_variance};
    use glam::DVec3;

    /// Red matt, blue glossy.
    fn two(wi: DVec3, wo: DVec3, out: &mut [f64]) {
        let h = wi + wo;
        let q = 1.0 + (h.x * h.x + h.y * h.y) / (0.01 * h.z * h.z);
        out[0] = 0.3;
        out[1] = 0.01 + 0.5 / (q * q);
    }

    fn mean_variance(sampler: &Hvt) -> f64 {
        let channel = |c: usize| {
            let f = move |wi: DVec3, wo: DVec3| {
                let mut out = [0.0; 2];
                two(wi, wo, &mut out);
                out[c]
            };
            relative_variance(Target::new(&f), sampler, 35.0, 20_000).value
        };
        0.5 * (channel(0) + channel(1))
    }

    #[test]
    fn the_colour_target_serves_all_channels_better_than_their_sum() {
        let sum = |wi: DVec3, wo: DVec3| {
            let mut out = [0.0; 2];
            two(wi, wo, &mut out);
            0.9 * out[0] + 0.1 * out[1]
        };
        let colour = ColourTarget::new(two, 2);
        let star = |wi: DVec3, wo: DVec3| colour.eval(wi, wo);
        let options = Preset::Default.options();
        let by_sum = mean_variance(&Hvt::new(Target::new(&sum), options));
        let by_star = mean_variance(&Hvt::new(Target::new(&star), options));
        assert!(by_star < 0.7 * by_sum, "{by_star} against {by_sum}");
    }
}
