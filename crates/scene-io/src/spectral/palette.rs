//! How the parts of a scene file become what the renderer of a mode holds.

use super::channels::Channels;
use super::hero::HeroChannels;
use super::light;
use super::surface::SpectralSurface;
use crate::build::Places;
use crate::cache::Cache;
use crate::error::Error;
use crate::material::{MaterialOptions, SamplerReport, Surface, load_measured};
use crate::scene::{Colour, LightSpectrum, MaterialSpec, SamplerName};
use brdf::{HERO, Material, RotatedTable, Rotation};
use spectrum::matrix::transform;
use spectrum::{LinearUplift, Samples, Spectrum, Viewing, table_srgb_from_xyz};
use std::path::PathBuf;
use std::sync::Arc;
use tracer::{Fixed, Hero, HeroEmission, Mode};

/// Surfaces as scene files name them.
pub(crate) trait FromScene: Sized {
    /// What is no mixture, and the file it was read from.
    fn of_spec(spec: &MaterialSpec, places: &Places) -> Result<(Self, Option<PathBuf>), Error>;
    /// A weighted sum.
    fn mix(parts: Vec<(Self, f64)>) -> Result<Self, Error>;
}

impl FromScene for Surface {
    fn of_spec(spec: &MaterialSpec, places: &Places) -> Result<(Self, Option<PathBuf>), Error> {
        Self::of_spec(spec, places)
    }
    fn mix(parts: Vec<(Self, f64)>) -> Result<Self, Error> {
        Self::mix(&parts)
    }
}

impl FromScene for SpectralSurface {
    fn of_spec(spec: &MaterialSpec, places: &Places) -> Result<(Self, Option<PathBuf>), Error> {
        match spec {
            MaterialSpec::File(m) => {
                let path = places.data.find(&m.path, &m.home)?;
                let options = MaterialOptions::of_file(m, SamplerName::Auto);
                let loaded = load_measured(&path, &options)?;
                let surface = Self::of_file(&loaded, &options, &places.cache)?;
                Ok((surface, Some(path)))
            }
            MaterialSpec::Lambert {
                reflectance,
                spectrum,
            } => {
                let rgb = Surface::of_spec(spec, places)?.0;
                let surface = match spectrum {
                    None => Self::colour(rgb, reflectance.0),
                    Some(rows) => {
                        Self::flat(rgb, light::reflectance(rows)?.scaled(reflectance.0[0]))
                    }
                };
                Ok((surface, None))
            }
            MaterialSpec::Model(m) => {
                let options = MaterialOptions::of_model(m, SamplerName::Auto);
                Ok((Self::of_model(&m.model, &options)?, None))
            }
            _ => {
                let (rgb, path) = Surface::of_spec(spec, places)?;
                Ok((Self::of_rgb(rgb), path))
            }
        }
    }
    fn mix(parts: Vec<(Self, f64)>) -> Result<Self, Error> {
        Self::mix(parts)
    }
}

/// A material and what is to be said of its sampler.
pub(crate) type Made<const N: usize, S> =
    (Box<dyn Material<N, <S as Mode<N>>::Tag>>, SamplerReport);

/// Makes the parts of a scene for one mode.
pub(crate) trait Palette<const N: usize> {
    /// How paths carry colour.
    type Mode: Mode<N>;
    /// Materials before they have a sampler.
    type Surface: FromScene;

    /// The mode itself.
    fn mode(&self) -> Self::Mode;

    /// A light: a colour, or how bright a spectrum shines.
    fn light(
        &self,
        colour: Colour,
        spectrum: Option<&LightSpectrum>,
    ) -> Result<<Self::Mode as Mode<N>>::Emission, Error>;

    /// Radiance of a pixel of an environment, linear sRGB.
    fn pixel(&self, rgb: [f32; 3]) -> <Self::Mode as Mode<N>>::Emission;

    /// A surface with the sampler `name` stands for.
    fn material(
        &self,
        surface: Self::Surface,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<Made<N, Self::Mode>, Error>;
}

/// Linear sRGB, as it is written.
pub(crate) struct RgbPalette;

impl Palette<3> for RgbPalette {
    type Mode = Fixed;
    type Surface = Surface;

    fn mode(&self) -> Fixed {
        Fixed
    }

    fn light(&self, colour: Colour, spectrum: Option<&LightSpectrum>) -> Result<Samples<3>, Error> {
        let rgb = match spectrum {
            None => colour.0,
            Some(_) => {
                let xyz = light::xyz(&light::power(colour, spectrum)?);
                transform(&table_srgb_from_xyz(&Viewing::standard()), xyz)
            }
        };
        Ok(Samples(rgb.map(|v| v as f32)))
    }

    fn pixel(&self, rgb: [f32; 3]) -> Samples<3> {
        Samples(rgb)
    }

    fn material(
        &self,
        surface: Surface,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<Made<3, Fixed>, Error> {
        surface.material(name, cache)
    }
}

/// `N` channels that are the same on every path.
pub(super) struct FixedPalette<const N: usize> {
    channels: Arc<Channels>,
    /// What one unit of each linear sRGB channel of a light is.
    pixel: [[f32; N]; 3],
}

impl<const N: usize> FixedPalette<N> {
    pub(super) fn new(channels: Arc<Channels>) -> Self {
        let pixel = unit_lights().map(|power| narrow(&channels.emission(&power)));
        Self { channels, pixel }
    }
}

impl<const N: usize> Palette<N> for FixedPalette<N> {
    type Mode = Fixed;
    type Surface = SpectralSurface;

    fn mode(&self) -> Fixed {
        Fixed
    }

    fn light(&self, colour: Colour, spectrum: Option<&LightSpectrum>) -> Result<Samples<N>, Error> {
        let power = light::power(colour, spectrum)?;
        Ok(Samples(narrow(&self.channels.emission(&power))))
    }

    fn pixel(&self, rgb: [f32; 3]) -> Samples<N> {
        let [r, g, b] = &self.pixel;
        Samples(std::array::from_fn(|c| {
            rgb[0] * r[c] + rgb[1] * g[c] + rgb[2] * b[c]
        }))
    }

    fn material(
        &self,
        surface: SpectralSurface,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<Made<N, Fixed>, Error> {
        surface.fixed(&self.channels, name, cache)
    }
}

/// Wavelengths that differ from path to path.
pub(super) struct HeroPalette {
    hero: HeroChannels,
    pixel: Arc<[RotatedTable; 3]>,
}

impl HeroPalette {
    pub(super) fn new(hero: HeroChannels) -> Self {
        let pixel = unit_lights().map(|power| brdf::rotated(&hero.channels.emission(&power)));
        let pixel = Arc::new(pixel);
        Self { hero, pixel }
    }
}

impl Palette<HERO> for HeroPalette {
    type Mode = Hero;
    type Surface = SpectralSurface;

    fn mode(&self) -> Hero {
        self.hero.mode()
    }

    fn light(
        &self,
        colour: Colour,
        spectrum: Option<&LightSpectrum>,
    ) -> Result<HeroEmission, Error> {
        Ok(self.hero.emission(&light::power(colour, spectrum)?))
    }

    fn pixel(&self, rgb: [f32; 3]) -> HeroEmission {
        HeroEmission::Mixture {
            parts: rgb,
            basis: Arc::clone(&self.pixel),
        }
    }

    fn material(
        &self,
        surface: SpectralSurface,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<(Box<dyn Material<HERO, Rotation>>, SamplerReport), Error> {
        surface.hero(&self.hero, name, cache)
    }
}

/// Daylight of each linear sRGB primary.
fn unit_lights() -> [Spectrum; 3] {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(|rgb| light::lit_by_daylight(&LinearUplift::spectrum(rgb)))
}

fn narrow<const N: usize>(values: &[f64]) -> [f32; N] {
    std::array::from_fn(|c| values.get(c).map_or(0.0, |v| *v as f32))
}
