//! Light from infinitely far away in every direction.

use crate::mode::Emission;
use brdf::Tag;
use glam::{DMat3, DVec2, DVec3, Mat3, Vec3};
use sampling::Piecewise2;
use std::f32::consts::PI;

/// What a ray that leaves the scene sees.
#[derive(Clone, Debug)]
pub enum Environment<E> {
    /// The same radiance everywhere.
    Constant(E),
    /// A latitude-longitude picture.
    Image(EnvironmentImage<E>),
}

/// A latitude-longitude picture around the scene.
///
/// The top row is +y, the middle of the picture is -z, and +x lies a quarter to the right of the middle
/// (as seen from inside). Radiance is constant over a pixel: the density it is sampled with then follows it exactly.
#[derive(Clone, Debug)]
pub struct EnvironmentImage<E> {
    /// Columns, positive.
    pub width: u32,
    /// Rows, positive.
    pub height: u32,
    /// Row after row from the top, `width * height` radiances.
    pub pixels: Vec<E>,
    /// Rotation from the picture's axes to the world's.
    pub to_world: DMat3,
}

/// The picture with its sampling tables.
#[derive(Clone, Debug)]
pub(crate) struct ImageLight<E> {
    width: u32,
    height: u32,
    pixels: Vec<E>,
    to_world: Mat3,
    to_local: Mat3,
    /// Brightness times solid angle of each pixel, over columns and rows.
    table: Piecewise2,
    /// Density per solid angle of each pixel.
    density: Vec<f32>,
}

impl<E> ImageLight<E> {
    /// Builds the tables. `None` if the picture is nowhere bright.
    pub(crate) fn new<const N: usize, T: Tag>(image: EnvironmentImage<E>) -> Option<Self>
    where
        E: Emission<N, T>,
    {
        let (w, h) = (image.width as usize, image.height as usize);
        let bright = |i: usize| image.pixels[i].brightness();
        let solid_angle = |i: usize| row_solid_angle(i / w, h) * std::f64::consts::TAU / w as f64;
        let power: Vec<f64> = (0..w * h).map(|i| bright(i) * solid_angle(i)).collect();
        let total: f64 = power.iter().sum();
        let table = Piecewise2::constant(w, &power).ok()?;
        let density = (0..w * h).map(|i| (bright(i) / total) as f32).collect();
        Some(Self {
            width: image.width,
            height: image.height,
            pixels: image.pixels,
            to_world: image.to_world.as_mat3(),
            to_local: image.to_world.transpose().as_mat3(),
            table,
            density,
        })
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.pixels[..]) + size_of_val(&self.density[..]) + self.table.bytes()
    }

    /// Index of the pixel in direction `d`.
    #[inline]
    fn pixel(&self, d: Vec3) -> usize {
        let d = self.to_local * d;
        let u = d.x.atan2(-d.z) / (2.0 * PI) + 0.5;
        // atan2 keeps its digits at the poles, where acos loses half of them
        let v = d.x.hypot(d.z).atan2(d.y) / PI;
        let x = ((u * self.width as f32) as u32).min(self.width - 1);
        let y = ((v * self.height as f32) as u32).min(self.height - 1);
        (y * self.width + x) as usize
    }

    /// Radiance from direction `d`.
    #[inline]
    pub(crate) fn radiance(&self, d: Vec3) -> &E {
        &self.pixels[self.pixel(d)]
    }

    /// Density of [`Self::sample`] per solid angle.
    #[inline]
    pub(crate) fn pdf(&self, d: Vec3) -> f32 {
        self.density[self.pixel(d)]
    }

    /// A direction, its density and the radiance from there.
    ///
    /// Never inlined: a search that most scenes lack, and whether it stood in the loop would depend on how many kinds of
    /// channels a program has.
    #[inline(never)]
    pub(crate) fn sample(&self, u: f32, v: f32) -> (Vec3, f32, &E) {
        let (at, _) = self.table.sample(DVec2::new(f64::from(u), f64::from(v)));
        let (column, row) = (at.x * f64::from(self.width), at.y * f64::from(self.height));
        let x = (column as u32).min(self.width - 1);
        let y = (row as u32).min(self.height - 1);
        // even in the cosine of the polar angle inside of a row
        let step = std::f64::consts::PI / f64::from(self.height);
        let (top, bottom) = (f64::from(y) * step, f64::from(y + 1) * step);
        let cos = top.cos() + (row - f64::from(y)) * (bottom.cos() - top.cos());
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let phi = (at.x - 0.5) * std::f64::consts::TAU;
        let d = DVec3::new(sin * phi.sin(), cos, -sin * phi.cos()).as_vec3();
        let i = (y * self.width + x) as usize;
        (self.to_world * d, self.density[i], &self.pixels[i])
    }
}

/// cos of the upper edge minus cos of the lower edge of row `y` of `h`.
fn row_solid_angle(y: usize, h: usize) -> f64 {
    let step = std::f64::consts::PI / h as f64;
    (y as f64 * step).cos() - ((y + 1) as f64 * step).cos()
}
