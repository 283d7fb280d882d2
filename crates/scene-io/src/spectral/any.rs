//! A scene and its film in whichever mode was asked for.

use super::channels::Channels;
use super::hero::HeroChannels;
use super::light::{self, LightSum};
use super::palette::{FixedPalette, HeroPalette, RgbPalette};
use crate::build::{Parts, Places, native_bands, parts};
use crate::checkpoint::{self, About, Opened};
use crate::error::Error;
use crate::image::SpectralPicture;
use crate::scene::{SceneFile, SpectrumName};
use brdf::HERO;
use spectrum::Basis;
use std::borrow::Cow;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use tracer::{
    Film, Hero, LeftOut, Progress, Scene, SceneBytes, Settings, Shard, Stats, Strategy, Trial,
};

/// A scene of `N` fixed channels that are not linear sRGB.
#[derive(Debug)]
pub struct ChannelScene<const N: usize> {
    scene: Scene<N>,
    channels: Arc<Channels>,
}

/// A film of `N` fixed channels that are not linear sRGB.
#[derive(Clone, Debug)]
pub struct ChannelFilm<const N: usize> {
    /// The sums.
    pub film: Film<N>,
    /// What its channels mean.
    pub channels: Arc<Channels>,
}

impl<const N: usize> ChannelFilm<N> {
    fn spectral(&self) -> Option<SpectralPicture> {
        let (lambda_nm, edges_nm) = match self.channels.basis() {
            Basis::Bands(nm) => (nm.clone(), Vec::new()),
            Basis::Bins(bins) => (bins.centres_nm().collect(), bins.edges_nm().to_vec()),
            _ => return None,
        };
        let mean = self.film.mean();
        let power = self.channels.power();
        let plane = |c: usize| mean.iter().map(|p| (p[c] * power[c]) as f32).collect();
        Some(SpectralPicture {
            width: self.film.width() as usize,
            height: self.film.height() as usize,
            lambda_nm,
            edges_nm,
            planes: (0..N).map(plane).collect(),
        })
    }

    fn about(&self, about: &About) -> About {
        let channels = (
            self.channels.basis().clone(),
            self.channels.reference().clone(),
        );
        About {
            channels: Some(channels),
            ..about.clone()
        }
    }

    fn rows(&self) -> [[f64; 3]; N] {
        let rows = self.channels.to_srgb();
        std::array::from_fn(|c| rows.get(c).copied().unwrap_or_default())
    }
}

macro_rules! modes {
    ($($(#[$doc:meta])* $name:ident = $n:literal),+ $(,)?) => {
        /// A scene in the mode it is rendered in.
        #[derive(Debug)]
        #[non_exhaustive]
        pub enum AnyScene {
            /// Linear sRGB.
            Rgb(Box<Scene<3>>),
            /// Wavelengths that differ from path to path.
            Hero(Box<Scene<HERO, Hero>>),
            $($(#[$doc])* $name(Box<ChannelScene<$n>>)),+
        }

        /// The film that goes with an [`AnyScene`].
        #[derive(Clone, Debug)]
        #[non_exhaustive]
        pub enum AnyFilm {
            /// Linear sRGB, also that of hero wavelengths.
            Rgb(Film<3>),
            $($(#[$doc])* $name(ChannelFilm<$n>)),+
        }

        impl AnyScene {
            /// An empty film for it.
            #[must_use]
            pub fn film(&self, [width, height]: [u32; 2], replicates: u32) -> AnyFilm {
                match self {
                    Self::Rgb(_) | Self::Hero(_) => AnyFilm::Rgb(Film::new(width, height, replicates)),
                    $(Self::$name(s) => AnyFilm::$name(ChannelFilm {
                        film: Film::new(width, height, replicates),
                        channels: Arc::clone(&s.channels),
                    })),+
                }
            }

            /// [`tracer::render`]; `progress` is shown the film in linear sRGB.
            ///
            /// # Errors
            /// If the film is one of another mode, or the threads that were asked for can't be started.
            pub fn render(
                &self,
                settings: &Settings,
                film: &mut AnyFilm,
                progress: &dyn Progress<3>,
            ) -> Result<Stats, Error> {
                let stats = match (self, film) {
                    (Self::Rgb(s), AnyFilm::Rgb(f)) => tracer::render(s, settings, f, progress),
                    (Self::Hero(s), AnyFilm::Rgb(f)) => tracer::render(s, settings, f, progress),
                    $((Self::$name(s), AnyFilm::$name(f)) => {
                        let developed = Developed { inner: progress, rows: f.rows() };
                        tracer::render(&s.scene, settings, &mut f.film, &developed)
                    })+
                    _ => return Err(Error::invalid("expected the film of this scene's mode, found another's")),
                };
                stats.map_err(|e| Error::invalid(e.to_string()))
            }

            /// [`tracer::choose_strategy`].
            ///
            /// # Errors
            /// If the threads that were asked for can't be started.
            pub fn choose_strategy(
                &self,
                settings: &Settings,
                size: (u32, u32),
            ) -> Result<(Strategy, [Trial; 2]), Error> {
                let chosen = match self {
                    Self::Rgb(s) => tracer::choose_strategy::<3, 3, _>(s, settings, size),
                    Self::Hero(s) => tracer::choose_strategy::<HERO, 3, _>(s, settings, size),
                    $(Self::$name(s) => tracer::choose_strategy::<$n, $n, _>(&s.scene, settings, size)),+
                };
                chosen.map_err(|e| Error::invalid(e.to_string()))
            }

            /// [`Scene::bytes`].
            #[must_use]
            pub fn bytes(&self) -> SceneBytes {
                match self {
                    Self::Rgb(s) => s.bytes(),
                    Self::Hero(s) => s.bytes(),
                    $(Self::$name(s) => s.scene.bytes()),+
                }
            }

            /// [`Scene::left_out`].
            #[must_use]
            pub fn left_out(&self, settings: &Settings) -> Vec<LeftOut> {
                match self {
                    Self::Rgb(s) => s.left_out(settings),
                    Self::Hero(s) => s.left_out(settings),
                    $(Self::$name(s) => s.scene.left_out(settings)),+
                }
            }
        }

        impl AnyFilm {
            /// The picture in linear sRGB, replicate by replicate.
            #[must_use]
            pub fn rgb(&self) -> Cow<'_, Film<3>> {
                match self {
                    Self::Rgb(film) => Cow::Borrowed(film),
                    $(Self::$name(f) => Cow::Owned(f.film.mapped(&f.rows()))),+
                }
            }

            /// [`Film::samples`].
            #[must_use]
            pub fn samples(&self) -> u64 {
                match self {
                    Self::Rgb(film) => film.samples(),
                    $(Self::$name(f) => f.film.samples()),+
                }
            }

            /// [`Film::bytes`].
            #[must_use]
            pub fn bytes(&self) -> usize {
                match self {
                    Self::Rgb(film) => film.bytes(),
                    $(Self::$name(f) => f.film.bytes()),+
                }
            }

            /// Channels of a pixel.
            #[must_use]
            pub fn channels(&self) -> usize {
                match self {
                    Self::Rgb(_) => 3,
                    $(Self::$name(_) => $n),+
                }
            }

            /// Bytes of what [`Self::rgb`] makes: none where it only shows what is there.
            #[must_use]
            pub fn twin_bytes(&self) -> usize {
                match self {
                    Self::Rgb(_) => 0,
                    $(Self::$name(f) => f.film.bytes() / $n * 3),+
                }
            }

            /// The mean spectral radiance of bins and bands; `None` for a film of colours.
            #[must_use]
            pub fn spectral(&self) -> Option<SpectralPicture> {
                match self {
                    Self::Rgb(_) => None,
                    $(Self::$name(f) => f.spectral()),+
                }
            }

            /// Writes it as [`crate::checkpoint::save`] does.
            ///
            /// # Errors
            /// As there.
            pub fn save(&self, path: &Path, about: &About, key: u64) -> Result<(), Error> {
                match self {
                    Self::Rgb(f) => checkpoint::save(path, f, about, key),
                    $(Self::$name(f) => checkpoint::save(path, &f.film, &f.about(about), key)),+
                }
            }

            /// The film of a checkpoint of any mode, what is known about it, and its key.
            ///
            /// # Errors
            /// If the file cannot be read, is damaged or of another version.
            pub fn open(path: &Path) -> Result<(Self, About, u64), Error> {
                let opened = Opened::new(path)?;
                let in_file = |e: Error| e.in_file(path);
                let film = match &opened.about.channels {
                    None => Self::Rgb(opened.film().map_err(in_file)?),
                    Some((basis, reference)) => match mode_of(basis) {
                        $(Some(stringify!($name)) => Self::$name(ChannelFilm {
                            film: opened.film().map_err(in_file)?,
                            channels: Arc::new(Channels::new(basis.clone(), reference)),
                        }),)+
                        _ => {
                            let message = "expected the channels of a mode, found others";
                            return Err(in_file(Error::invalid(message)));
                        }
                    },
                };
                Ok((film, opened.about, opened.key))
            }

            /// Takes the tiles of `shard` from a film of the same mode and size.
            ///
            /// # Errors
            /// If it is another's.
            pub fn take(&mut self, other: &Self, shard: Shard) -> Result<(), Error> {
                match (self, other) {
                    (Self::Rgb(to), Self::Rgb(from)) => take(to, from, shard),
                    $((Self::$name(to), Self::$name(from)) => take(&mut to.film, &from.film, shard),)+
                    _ => Err(Error::invalid("expected a film of the same mode, found another's")),
                }
            }

            /// Puts back what [`Self::save`] wrote.
            ///
            /// # Errors
            /// As [`crate::checkpoint::restore`].
            pub fn restore(&mut self, path: &Path, key: u64) -> Result<About, Error> {
                match self {
                    Self::Rgb(f) => checkpoint::restore(path, f, key),
                    $(Self::$name(f) => checkpoint::restore(path, &mut f.film, key)),+
                }
            }
        }
    };
}

modes! {
    /// CIE XYZ relative to white.
    Xyz = 3,
    /// Eight bins.
    Bins8 = 8,
    /// Sixteen bins.
    Bins16 = 16,
    /// Forty-five bins.
    Bins45 = 45,
    /// The 31 bands of a measurement.
    Bands31 = 31,
    /// 65 bands.
    Bands65 = 65,
}

/// Which of the modes of fixed channels has this basis.
fn mode_of(basis: &Basis) -> Option<&'static str> {
    match (basis, basis.len()) {
        (Basis::Xyz, _) => Some("Xyz"),
        (Basis::Bins(_), 8) => Some("Bins8"),
        (Basis::Bins(_), 16) => Some("Bins16"),
        (Basis::Bins(_), 45) => Some("Bins45"),
        (Basis::Bands(_), 31) => Some("Bands31"),
        (Basis::Bands(_), 65) => Some("Bands65"),
        _ => None,
    }
}

fn take<const N: usize>(to: &mut Film<N>, from: &Film<N>, shard: Shard) -> Result<(), Error> {
    let mine = from.tiles().enumerate();
    for (index, tile) in mine.filter(|(index, _)| shard.has(*index)) {
        to.restore(index, tile.done(), tile.sums())
            .map_err(|e| Error::invalid(e.to_string()))?;
    }
    Ok(())
}

/// Shows a film in linear sRGB to whoever watches.
struct Developed<'a, const N: usize> {
    inner: &'a dyn Progress<3>,
    rows: [[f64; 3]; N],
}

impl<const N: usize> Progress<N> for Developed<'_, N> {
    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }

    fn tile_done(&self, paths: u64) {
        self.inner.tile_done(paths);
    }

    fn estimates(&self) -> bool {
        false
    }

    fn pass_done(&self, film: &Film<N>) -> ControlFlow<()> {
        self.inner.pass_done(&film.mapped(&self.rows))
    }
}

/// Builds the scene in the mode its file names.
pub(crate) fn build(
    file: &SceneFile,
    places: &Places,
    notes: &mut Vec<String>,
) -> Result<Parts<AnyScene>, Error> {
    let name = file.render.spectrum;
    if name == SpectrumName::Rgb {
        return Ok(parts(file, places, &RgbPalette, notes)?.map(|s| AnyScene::Rgb(Box::new(s))));
    }
    let lights = lights(file)?;
    let reference = lights.reference();
    let channels = |basis: Basis| Arc::new(Channels::new(basis, &reference));
    let bins = |count: usize| file.render.bins(count).map(Basis::Bins);
    Ok(match name {
        SpectrumName::Rgb | SpectrumName::Hero => {
            let palette = HeroPalette::new(HeroChannels::new(&lights));
            parts(file, places, &palette, notes)?.map(|s| AnyScene::Hero(Box::new(s)))
        }
        SpectrumName::Xyz => fixed(file, places, channels(Basis::Xyz), notes)?.map(AnyScene::Xyz),
        SpectrumName::Eight => fixed(file, places, channels(bins(8)?), notes)?.map(AnyScene::Bins8),
        SpectrumName::Sixteen => {
            fixed(file, places, channels(bins(16)?), notes)?.map(AnyScene::Bins16)
        }
        SpectrumName::FortyFive => {
            fixed(file, places, channels(bins(45)?), notes)?.map(AnyScene::Bins45)
        }
        SpectrumName::Native => {
            let bands = native_bands(file, places)?.0;
            let basis = channels(Basis::Bands(bands.clone()));
            if bands.len() == 31 {
                fixed(file, places, basis, notes)?.map(AnyScene::Bands31)
            } else {
                fixed(file, places, basis, notes)?.map(AnyScene::Bands65)
            }
        }
    })
}

fn fixed<const N: usize>(
    file: &SceneFile,
    places: &Places,
    channels: Arc<Channels>,
    notes: &mut Vec<String>,
) -> Result<Parts<Box<ChannelScene<N>>>, Error> {
    let palette = FixedPalette::<N>::new(Arc::clone(&channels));
    let parts = parts(file, places, &palette, notes)?;
    Ok(parts.map(|scene| Box::new(ChannelScene { scene, channels })))
}

/// All lights of a scene; those without a spectrum shine like daylight, coloured or not.
pub(crate) fn lights(file: &SceneFile) -> Result<LightSum, Error> {
    let mut sum = LightSum::default();
    for (k, shape) in file.shapes.iter().enumerate() {
        if let Some(colour) = shape.emission {
            let power = light::power(colour, shape.emission_spectrum.as_ref());
            sum.add(power.map_err(|e| e.in_field(&format!("shapes[{k}].emission_spectrum")))?);
        }
    }
    for (k, spec) in file.lights.iter().enumerate() {
        let (colour, spectrum) = spec.shine();
        let power = light::power(colour, spectrum);
        sum.add(power.map_err(|e| e.in_field(&format!("lights[{k}].spectrum")))?);
    }
    Ok(sum)
}
