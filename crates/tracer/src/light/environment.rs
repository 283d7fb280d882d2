//! Light from infinitely far away in every direction.

use glam::{DMat3, Mat3, Vec3};
use spectrum::Samples;
use std::f32::consts::PI;

/// What a ray that leaves the scene sees.
#[derive(Clone, Debug)]
pub enum Environment<const N: usize> {
    /// The same radiance everywhere.
    Constant(Samples<N>),
    /// A latitude-longitude picture.
    Image(EnvironmentImage<N>),
}

/// A latitude-longitude picture around the scene.
///
/// The top row is +y, the middle of the picture is -z, and +x lies a quarter to the right of the middle
/// (as seen from inside). Radiance is constant over a pixel: the density it is sampled with then follows it exactly.
#[derive(Clone, Debug)]
pub struct EnvironmentImage<const N: usize> {
    /// Columns, positive.
    pub width: u32,
    /// Rows, positive.
    pub height: u32,
    /// Row after row from the top, `width * height` radiances.
    pub pixels: Vec<Samples<N>>,
    /// Rotation from the picture's axes to the world's.
    pub to_world: DMat3,
}

/// The picture with its sampling tables.
#[derive(Clone, Debug)]
pub(crate) struct ImageLight<const N: usize> {
    width: u32,
    height: u32,
    pixels: Vec<[f32; N]>,
    to_world: Mat3,
    to_local: Mat3,
    /// Per row, sums of brightness over its pixels up to and with each, normalised.
    conditional: Vec<f32>,
    /// Sums over rows, brightness times the row's share of the sphere, normalised.
    marginal: Vec<f32>,
    /// Density per solid angle of each pixel.
    density: Vec<f32>,
}

impl<const N: usize> ImageLight<N> {
    /// Builds the tables. `None` if the picture is nowhere bright.
    pub(crate) fn new(image: &EnvironmentImage<N>) -> Option<Self> {
        let (w, h) = (image.width as usize, image.height as usize);
        let bright = |i: usize| f64::from(image.pixels[i].mean().max(0.0));
        let mut conditional = vec![0.0; w * h];
        let mut rows = vec![0.0; h];
        let mut total = 0.0;
        for y in 0..h {
            let sums: Vec<f64> = (0..w)
                .scan(0.0, |sum, x| {
                    *sum += bright(y * w + x);
                    Some(*sum)
                })
                .collect();
            let row = sums[w - 1];
            for x in 0..w {
                conditional[y * w + x] = if row > 0.0 { sums[x] / row } else { 1.0 } as f32;
            }
            total += row * row_solid_angle(y, h);
            rows[y] = total;
        }
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        // brightness / integral of brightness; the pixel's solid angle is 2 pi / w times its row's share
        let per_pixel = std::f64::consts::TAU / w as f64;
        let density = (0..w * h).map(|i| (bright(i) / (total * per_pixel)) as f32);
        Some(Self {
            width: image.width,
            height: image.height,
            pixels: image.pixels.iter().map(|p| p.0).collect(),
            to_world: image.to_world.as_mat3(),
            to_local: image.to_world.transpose().as_mat3(),
            conditional,
            marginal: rows.iter().map(|r| (r / total) as f32).collect(),
            density: density.collect(),
        })
    }

    /// Index of the pixel in direction `d`.
    #[inline]
    fn pixel(&self, d: Vec3) -> usize {
        let d = self.to_local * d;
        let u = d.x.atan2(-d.z) / (2.0 * PI) + 0.5;
        let v = d.y.clamp(-1.0, 1.0).acos() / PI;
        let x = ((u * self.width as f32) as u32).min(self.width - 1);
        let y = ((v * self.height as f32) as u32).min(self.height - 1);
        (y * self.width + x) as usize
    }

    /// Radiance from direction `d`.
    #[inline]
    pub(crate) fn radiance(&self, d: Vec3) -> [f32; N] {
        self.pixels[self.pixel(d)]
    }

    /// Density of [`Self::sample`] per solid angle.
    #[inline]
    pub(crate) fn pdf(&self, d: Vec3) -> f32 {
        self.density[self.pixel(d)]
    }

    /// A direction, its density and the radiance from there.
    #[inline]
    pub(crate) fn sample(&self, u: f32, v: f32) -> (Vec3, f32, [f32; N]) {
        let w = self.width as usize;
        let (y, v) = invert(&self.marginal, v);
        let (x, u) = invert(&self.conditional[y * w..(y + 1) * w], u);
        // even in cos(theta) inside the row, even in phi inside the column
        let h = self.height as f32;
        let (top, bottom) = (y as f32 * PI / h, (y + 1) as f32 * PI / h);
        let cos = top.cos() + v * (bottom.cos() - top.cos());
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let phi = ((x as f32 + u) / w as f32 - 0.5) * 2.0 * PI;
        let d = Vec3::new(sin * phi.sin(), cos, -sin * phi.cos());
        let i = y * w + x;
        (self.to_world * d, self.density[i], self.pixels[i])
    }
}

/// cos of the upper edge minus cos of the lower edge of row `y` of `h`.
fn row_solid_angle(y: usize, h: usize) -> f64 {
    let step = std::f64::consts::PI / h as f64;
    (y as f64 * step).cos() - ((y + 1) as f64 * step).cos()
}

/// The interval of a normalised cumulative table that holds `u`, and where in it.
#[inline]
fn invert(cdf: &[f32], u: f32) -> (usize, f32) {
    let i = cdf.partition_point(|&c| c <= u).min(cdf.len() - 1);
    let below = if i > 0 { cdf[i - 1] } else { 0.0 };
    let width = cdf[i] - below;
    let rest = if width > 0.0 {
        (u - below) / width
    } else {
        0.5
    };
    (i, rest.clamp(0.0, 1.0))
}
