//! RGL tables for packets of directions in f32: angles of all lanes in straight loops the compiler vectorises, then
//! each lane reads its cells.
//!
//! Formulas as in [`crate::rgl::table`]. Accuracy: coordinates of the half vector are good to 4e-7, the masses of the
//! warp to 1e-7 of the mass of a row; values change by what their slope makes of that.

use crate::grid::fast_math::atan2_upper;
use crate::rgl::image::Image;
use crate::rgl::lane_warp::{Between, LaneWarp, Spot};
use crate::rgl::warp::Warp;
use brdf::{LANES, Lanes3, SampleLanes};
use std::f32::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};

type F = [f32; LANES];
const ZERO: F = [0.0; LANES];

/// Everything of an isotropic table but its values.
#[derive(Clone, Debug)]
pub(crate) struct RglLanes {
    theta: Vec<f32>,
    sigma: Image,
    ndf: Image,
    vndf: LaneWarp,
    luminance: LaneWarp,
    microfacet_factor: bool,
}

/// Parts of a table that lanes are made of.
pub(crate) struct Parts<'a> {
    pub(crate) theta: &'a [f64],
    pub(crate) sigma: &'a Image,
    pub(crate) ndf: &'a Image,
    pub(crate) vndf: &'a Warp,
    pub(crate) luminance: &'a Warp,
    pub(crate) microfacet_factor: bool,
}

/// Values of `N` channels, interleaved: the two nodes of a row that a lane needs are neighbours.
#[derive(Clone, Debug)]
pub(crate) struct LaneValues<const N: usize> {
    nx: usize,
    ny: usize,
    nodes: Vec<[f32; N]>,
}

/// The viewer in the coordinates of the file.
struct Viewers {
    /// Between which incidences: index of the lower one and weight of the upper one.
    lower: [u32; LANES],
    t: F,
    /// Unit vector of the azimuth.
    cos_phi: F,
    sin_phi: F,
    /// Polar coordinate in the unit square.
    u_theta: F,
}

/// Half vectors in the coordinates of the file.
struct Halves {
    u_theta: F,
    u_phi: F,
    /// Density of the reflected direction per density on the unit square.
    jacobian: F,
}

impl<const N: usize> LaneValues<N> {
    /// From planar grids of `N` channels an incidence.
    pub(crate) fn new(values: &Image) -> Self {
        let (nx, ny) = (values.nx(), values.ny());
        let slices = values.bytes() / size_of::<f32>() / (nx * ny * N);
        let mut nodes = Vec::with_capacity(slices * nx * ny);
        for slice in 0..slices {
            for at in 0..nx * ny {
                let channel = |c| values.node(slice * N + c, at / nx, at % nx) as f32;
                nodes.push(std::array::from_fn(channel));
            }
        }
        Self { nx, ny, nodes }
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
    }

    #[inline(always)]
    fn blend(&self, u: [f32; 2], s: &Between) -> [f32; N] {
        let at = Spot::new(u, self.nx, self.ny);
        let mut out = [0.0; N];
        for (slice, weight) in [(s.lower, 1.0 - s.t), (s.upper, s.t)] {
            let start = (slice * self.ny + at.row) * self.nx + at.col;
            let low = &self.nodes[start..start + 2];
            let high = &self.nodes[start + self.nx..start + self.nx + 2];
            for c in 0..N {
                let a = low[0][c] + at.x * (low[1][c] - low[0][c]);
                let b = high[0][c] + at.x * (high[1][c] - high[0][c]);
                out[c] += weight * (a + at.y * (b - a));
            }
        }
        out
    }
}

impl RglLanes {
    pub(crate) fn new(parts: &Parts<'_>) -> Self {
        Self {
            theta: parts.theta.iter().map(|t| *t as f32).collect(),
            sigma: parts.sigma.clone(),
            ndf: parts.ndf.clone(),
            vndf: LaneWarp::new(parts.vndf),
            luminance: LaneWarp::new(parts.luminance),
            microfacet_factor: parts.microfacet_factor,
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        let warps = self.vndf.bytes() + self.luminance.bytes();
        warps + self.sigma.bytes() + self.ndf.bytes() + size_of_val(&self.theta[..])
    }

    /// f_r of every lane; zero where a direction is not above the horizon.
    #[inline(always)]
    pub(crate) fn eval<const N: usize>(
        &self,
        values: &LaneValues<N>,
        min_cos: f32,
        wi: &Lanes3,
        wo: &Lanes3,
    ) -> [F; N] {
        let viewers = self.viewers(wo);
        let halves = halves(&viewers, wi, wo);
        let mut out = [ZERO; N];
        for k in 0..LANES {
            let s = self.between(&viewers, k);
            let u_m = [halves.u_theta[k], halves.u_phi[k]];
            let (uniform, _) = self.vndf.invert(u_m, &s);
            let factor = if self.microfacet_factor {
                let u_phi = azimuth(viewers.sin_phi[k], viewers.cos_phi[k]) / TAU + 0.5;
                let u_known = [viewers.u_theta[k], u_phi];
                look_up(&self.ndf, u_m) / (4.0 * look_up(&self.sigma, u_known))
            } else {
                1.0
            };
            let f = values.blend(uniform, &s);
            for c in 0..N {
                out[c][k] = factor * f[c];
            }
        }
        for channel in &mut out {
            for k in 0..LANES {
                let f = channel[k] / wi.z[k].max(min_cos);
                let good = (wi.z[k] > 0.0) & (wo.z[k] > 0.0) & (f.abs() < f32::INFINITY);
                channel[k] = if good { f } else { 0.0 };
            }
        }
        out
    }

    /// Density of the file's own sampling.
    #[inline(always)]
    pub(crate) fn pdf(&self, wi: &Lanes3, wo: &Lanes3) -> F {
        let viewers = self.viewers(wo);
        let halves = halves(&viewers, wi, wo);
        let mut out = ZERO;
        for k in 0..LANES {
            let s = self.between(&viewers, k);
            let (uniform, vndf) = self.vndf.invert([halves.u_theta[k], halves.u_phi[k]], &s);
            out[k] = vndf * self.luminance.pdf(uniform, &s);
        }
        for k in 0..LANES {
            let pdf = out[k] / halves.jacobian[k];
            let good = (wi.z[k] > 0.0) & (wo.z[k] > 0.0) & (pdf < f32::INFINITY);
            out[k] = if good { pdf } else { 0.0 };
        }
        out
    }

    /// The file's own sampling; density 0 where it points below the horizon.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: &Lanes3, u: &[F; 2]) -> SampleLanes {
        let viewers = self.viewers(wo);
        let mut points = [ZERO; 2];
        let mut densities = ZERO;
        for k in 0..LANES {
            let s = self.between(&viewers, k);
            // the file's order of coordinates: the first number drives the rows
            let (uniform, luminance) = self.luminance.sample([u[1][k], u[0][k]], &s);
            let (u_m, vndf) = self.vndf.sample(uniform, &s);
            [points[0][k], points[1][k]] = u_m;
            densities[k] = vndf * luminance;
        }
        let mut out = SampleLanes {
            wi: Lanes3::ZERO,
            pdf: ZERO,
        };
        for k in 0..LANES {
            let u_theta = points[0][k];
            let (sin, cos) = sin_cos(u_theta * u_theta * FRAC_PI_2);
            let (s, c) = sin_cos((2.0 * points[1][k] - 1.0) * PI);
            let mx = sin * (c * viewers.cos_phi[k] - s * viewers.sin_phi[k]);
            let my = sin * (s * viewers.cos_phi[k] + c * viewers.sin_phi[k]);
            let dot = wo.x[k] * mx + wo.y[k] * my + wo.z[k] * cos;
            let (x, y, z) = (
                2.0 * dot * mx - wo.x[k],
                2.0 * dot * my - wo.y[k],
                2.0 * dot * cos - wo.z[k],
            );
            // m and wo are unit up to rounding
            let inv = 1.0 / (x * x + y * y + z * z).sqrt();
            (out.wi.x[k], out.wi.y[k], out.wi.z[k]) = (x * inv, y * inv, z * inv);
            let pdf = densities[k] / jacobian(u_theta, sin, dot);
            let good = (z > 0.0) & (wo.z[k] > 0.0) & (pdf > 0.0) & (pdf < f32::INFINITY);
            out.pdf[k] = if good { pdf } else { 0.0 };
        }
        out
    }

    #[inline(always)]
    fn viewers(&self, wo: &Lanes3) -> Viewers {
        let mut v = Viewers {
            lower: [0; LANES],
            t: ZERO,
            cos_phi: ZERO,
            sin_phi: ZERO,
            u_theta: ZERO,
        };
        let mut theta = ZERO;
        for k in 0..LANES {
            let r = (wo.x[k] * wo.x[k] + wo.y[k] * wo.y[k]).sqrt();
            let flat = r > 0.0;
            let inv = 1.0 / if flat { r } else { 1.0 };
            v.cos_phi[k] = if flat { wo.x[k] * inv } else { 1.0 };
            v.sin_phi[k] = if flat { wo.y[k] * inv } else { 0.0 };
            theta[k] = atan2_upper(r, wo.z[k]);
            v.u_theta[k] = (theta[k] * FRAC_2_PI).sqrt();
        }
        // the last interval that starts at or below theta; its weight is held at both ends
        for (i, pair) in self.theta.windows(2).enumerate() {
            let inv = 1.0 / (pair[1] - pair[0]).max(f32::MIN_POSITIVE);
            for k in 0..LANES {
                let here = (i == 0) | (theta[k] >= pair[0]);
                let t = ((theta[k] - pair[0]) * inv).clamp(0.0, 1.0);
                v.lower[k] = if here { i as u32 } else { v.lower[k] };
                v.t[k] = if here { t } else { v.t[k] };
            }
        }
        v
    }

    #[inline(always)]
    fn between(&self, v: &Viewers, k: usize) -> Between {
        let lower = v.lower[k] as usize;
        Between {
            lower,
            upper: (lower + 1).min(self.theta.len() - 1),
            t: v.t[k],
        }
    }
}

#[inline(always)]
fn halves(v: &Viewers, wi: &Lanes3, wo: &Lanes3) -> Halves {
    let mut out = Halves {
        u_theta: ZERO,
        u_phi: ZERO,
        jacobian: ZERO,
    };
    for k in 0..LANES {
        let (x, y, z) = (wi.x[k] + wo.x[k], wi.y[k] + wo.y[k], wi.z[k] + wo.z[k]);
        let xy = (x * x + y * y).sqrt();
        let len = (xy * xy + z * z).sqrt();
        let u_theta = (atan2_upper(xy, z) * FRAC_2_PI).sqrt();
        let turn = azimuth(
            y * v.cos_phi[k] - x * v.sin_phi[k],
            x * v.cos_phi[k] + y * v.sin_phi[k],
        );
        let u_phi = turn / TAU + 0.5;
        out.u_theta[k] = u_theta;
        out.u_phi[k] = if u_phi < 1.0 { u_phi } else { 0.0 };
        let len = len.max(f32::MIN_POSITIVE);
        out.jacobian[k] = jacobian(u_theta, xy / len, 0.5 * len);
    }
    out
}

/// Density of the reflected direction per density on the unit square, from the sine of the half vector's polar angle
/// and its cosine to the viewer.
#[inline(always)]
fn jacobian(u_theta: f32, sin: f32, cos_known: f32) -> f32 {
    (2.0 * PI * PI * u_theta * sin).max(1e-6) * 4.0 * cos_known
}

/// The angle of (x, y) in [-pi, pi].
#[inline(always)]
fn azimuth(y: f32, x: f32) -> f32 {
    let half_turn = atan2_upper(y.abs(), x);
    if y < 0.0 { -half_turn } else { half_turn }
}

/// Sine and cosine for |x| <= 4, absolute error below 2e-7.
#[inline(always)]
fn sin_cos(x: f32) -> (f32, f32) {
    // whole quarter turns; pi/2 in two parts keeps the digits of the rest
    let quarters = (x * FRAC_2_PI + 4.5) as i32 - 4;
    let whole = quarters as f32;
    let r = (x - whole * 1.570_796_4) + whole * 4.371_139e-8;
    let z = r * r;
    let s =
        r + r * z * (-1.666_666_6e-1 + z * (8.333_332e-3 + z * (-1.984_087_5e-4 + z * 2.752_5e-6)));
    let c = 1.0 + z * (-0.5 + z * (4.166_666_6e-2 + z * (-1.388_888_6e-3 + z * 2.476_9e-5)));
    let (s, c) = if quarters & 1 == 1 { (c, s) } else { (s, c) };
    let s = if quarters & 2 == 2 { -s } else { s };
    let c = if (quarters + 1) & 2 == 2 { -c } else { c };
    (s, c)
}

/// The only grid of `image` at `u`.
#[inline(always)]
fn look_up(image: &Image, u: [f32; 2]) -> f32 {
    let at = Spot::new(u, image.nx(), image.ny());
    let [low, high] = image.cell(at.row, at.col);
    let a = low[0] + at.x * (low[1] - low[0]);
    let b = high[0] + at.x * (high[1] - high[0]);
    a + at.y * (b - a)
}

#[cfg(test)]
mod tests {
    use super::sin_cos;

    #[test]
    fn sine_and_cosine_keep_their_digits() {
        for k in -40_000..=40_000_i32 {
            let x = k as f32 * 1e-4;
            let (s, c) = sin_cos(x);
            let (es, ec) = f64::from(x).sin_cos();
            let error = (f64::from(s) - es).abs().max((f64::from(c) - ec).abs());
            assert!(error < 2e-7, "sin_cos({x}) off by {error:e}");
        }
    }
}
