//! The state of a render on disk: a killed render goes on to the same bits, and parts become a whole.

use crate::error::{Error, ErrorKind};
use crate::sealed::{Label, Refusal, seal, unseal_any};
use crate::{load, write};
use spectrum::{Basis, Bins, GamutMapping, Outside, Spectrum};
use std::path::Path;
use tracer::{Film, Shard};

/// Raised whenever the layout below, or the meaning of a sample number, changes.
const VERSION: u32 = 3;
/// Largest checkpoint, bytes: 16 GiB.
const MAX_BYTES: u64 = 16 << 30;

const fn label(key: u64) -> Label {
    Label {
        kind: *b"FILM",
        version: VERSION,
        key,
    }
}

/// What a picture made of a checkpoint needs to know besides the samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// The scene's path or name.
    pub scene: String,
    /// Sampler of the main material.
    pub sampler: String,
    /// Seed.
    pub seed: u64,
    /// Samples a pixel that were asked for.
    pub spp: u32,
    /// Factor of the PNG, if the scene fixes it.
    pub exposure: Option<f32>,
    /// How the PNG shows colours out of gamut.
    pub gamut: GamutMapping,
    /// What the channels of the film are, and the light they are told relative to; `None`: linear sRGB.
    pub channels: Option<(Basis, Spectrum)>,
    /// The part of the picture it holds; `None`: all of it.
    pub shard: Option<Shard>,
}

/// A checkpoint as it was found, of whatever render.
#[derive(Clone, Debug)]
pub struct Found<const N: usize> {
    /// The samples.
    pub film: Film<N>,
    /// What else was kept.
    pub about: About,
    /// Identifies everything the samples depend on but their number.
    pub key: u64,
}

/// Writes the film atomically. `key` must identify everything the samples depend on but their number: scene,
/// materials, seed, sampler.
///
/// # Errors
/// If the file cannot be written; the checkpoint before it then stays.
pub fn save<const N: usize>(
    path: &Path,
    film: &Film<N>,
    about: &About,
    key: u64,
) -> Result<(), Error> {
    let mut payload = Vec::new();
    let tiles = film.tiles();
    let count = |n: usize| {
        u32::try_from(n).map_err(|_| Error::invalid("expected fewer than 2^32 tiles and letters"))
    };
    let (index, shards) = about.shard.map_or((0, 0), |s| (s.index, s.count));
    let numbers = [
        film.width(),
        film.height(),
        film.replicates(),
        count(tiles.len())?,
        about.spp,
        index,
        shards,
        about.exposure.unwrap_or(f32::NAN).to_bits(),
    ];
    for number in numbers {
        payload.extend_from_slice(&number.to_le_bytes());
    }
    payload.extend_from_slice(&about.seed.to_le_bytes());
    for text in [&about.scene, &about.sampler] {
        payload.extend_from_slice(&count(text.len())?.to_le_bytes());
        payload.extend_from_slice(text.as_bytes());
    }
    payload.push(u8::from(about.gamut == GamutMapping::Desaturate));
    channels::write(about.channels.as_ref(), &mut payload)?;
    for tile in tiles {
        payload.extend_from_slice(&tile.done().to_le_bytes());
        for value in tile.sums().iter().flatten() {
            payload.extend_from_slice(&value.to_le_bytes());
        }
    }
    write::bytes(path, &seal(label(key), &payload))
}

/// Puts the samples of a checkpoint into `film`, which has the size and replicates it will be rendered with; what else
/// the checkpoint says.
///
/// # Errors
/// If the file cannot be read, is damaged, of another version, of another render, or of another size; the film
/// is then as it was.
pub fn restore<const N: usize>(path: &Path, film: &mut Film<N>, key: u64) -> Result<About, Error> {
    let expected = [film.width(), film.height(), film.replicates()];
    let opened = Opened::new(path)?;
    if opened.key != key {
        return Err(refused(path, Refusal::Key));
    }
    let found = opened.size;
    if expected != found {
        return Err(Error::invalid(format!(
            "expected a film of {} x {} pixels and {} replicates, found {} x {} and {}",
            expected[0], expected[1], expected[2], found[0], found[1], found[2]
        ))
        .in_file(path));
    }
    *film = opened.film().map_err(|e| e.in_file(path))?;
    Ok(opened.about)
}

/// Reads a checkpoint of any render whose films have `N` channels.
///
/// # Errors
/// If the file cannot be read, is damaged or of another version.
pub fn open<const N: usize>(path: &Path) -> Result<Found<N>, Error> {
    let opened = Opened::new(path)?;
    Ok(Found {
        film: opened.film().map_err(|e| e.in_file(path))?,
        about: opened.about,
        key: opened.key,
    })
}

/// A checkpoint, before it is known how many channels its film has.
pub(crate) struct Opened {
    pub(crate) about: About,
    pub(crate) key: u64,
    /// Width, height, replicates.
    size: [u32; 3],
    tiles: u32,
    /// What the tiles hold.
    sums: Vec<u8>,
}

impl Opened {
    pub(crate) fn new(path: &Path) -> Result<Self, Error> {
        let bytes = load::bytes(path, MAX_BYTES)?;
        let (key, payload) = unseal_any(label(0), &bytes).map_err(|r| refused(path, r))?;
        read(payload, key).map_err(|e| e.in_file(path))
    }

    /// Its film.
    ///
    /// # Errors
    /// If it has not `N` channels.
    pub(crate) fn film<const N: usize>(&self) -> Result<Film<N>, Error> {
        let [width, height, replicates] = self.size;
        // the film is only made once its sums are known to be there
        let sums =
            (u128::from(width) * u128::from(height) * u128::from(replicates)) * 8 * N as u128;
        let bytes = sums + 4 * u128::from(self.tiles);
        if bytes != self.sums.len() as u128 || sums == 0 {
            return Err(Error::invalid(format!(
                "expected {bytes} bytes of sums for {width} x {height} pixels, found {}",
                self.sums.len()
            )));
        }
        let mut reader = Reader(&self.sums);
        let mut film = Film::new(width, height, replicates);
        if film.tiles().len() != self.tiles as usize {
            let message = format!(
                "expected {} tiles, found {}",
                film.tiles().len(),
                self.tiles
            );
            return Err(Error::invalid(message));
        }
        let counts: Vec<usize> = film.tiles().map(|t| t.sums().len()).collect();
        for (index, count) in counts.into_iter().enumerate() {
            let done = reader.number()?;
            let values = reader.take(count * N * 8)?;
            let sums: Vec<[f64; N]> = (values.as_chunks().0.as_chunks::<N>().0.iter())
                .map(|pixel| pixel.map(f64::from_le_bytes))
                .collect();
            film.restore(index, done, &sums)
                .map_err(|e| Error::invalid(e.to_string()))?;
        }
        Ok(film)
    }
}

fn refused(path: &Path, refusal: Refusal) -> Error {
    let message = format!("not a checkpoint of this render: {refusal}");
    Error::new(ErrorKind::Invalid, message).in_file(path)
}

/// Takes numbers and texts off the front of a payload.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], Error> {
        let short = || Error::invalid("expected the sums of a film, found fewer bytes");
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(short)?;
        self.0 = rest;
        Ok(taken)
    }

    fn number(&mut self) -> Result<u32, Error> {
        let bytes = self.take(4)?;
        Ok(u32::from_le_bytes(std::array::from_fn(|k| bytes[k])))
    }

    fn text(&mut self) -> Result<String, Error> {
        let count = self.number()? as usize;
        let bytes = self.take(count)?.to_vec();
        String::from_utf8(bytes).map_err(|_| Error::invalid("expected UTF-8, found other bytes"))
    }
}

fn read(payload: &[u8], key: u64) -> Result<Opened, Error> {
    let mut reader = Reader(payload);
    let mut numbers = [0; 8];
    for number in &mut numbers {
        *number = reader.number()?;
    }
    let [
        width,
        height,
        replicates,
        tiles,
        spp,
        index,
        count,
        exposure,
    ] = numbers;
    let seed = [reader.number()?, reader.number()?].map(u64::from);
    let about = About {
        scene: reader.text()?,
        sampler: reader.text()?,
        seed: seed[0] | seed[1] << 32,
        spp,
        exposure: Some(f32::from_bits(exposure)).filter(|e| !e.is_nan()),
        gamut: match reader.take(1)? {
            [1] => GamutMapping::Desaturate,
            _ => GamutMapping::Clip,
        },
        channels: channels::read(&mut reader)?,
        shard: (count > 0).then_some(Shard { index, count }),
    };
    Ok(Opened {
        about,
        key,
        size: [width, height, replicates],
        tiles,
        sums: reader.0.to_vec(),
    })
}

/// What the channels are: kind, wavelengths, reference.
mod channels {
    use super::{Basis, Bins, Error, Outside, Reader, Spectrum};

    pub(super) fn write(
        channels: Option<&(Basis, Spectrum)>,
        payload: &mut Vec<u8>,
    ) -> Result<(), Error> {
        let mut list = |values: &[f64]| -> Result<(), Error> {
            let count = u32::try_from(values.len())
                .map_err(|_| Error::invalid("expected fewer than 2^32 wavelengths"))?;
            payload.extend_from_slice(&count.to_le_bytes());
            values
                .iter()
                .for_each(|v| payload.extend_from_slice(&v.to_le_bytes()));
            Ok(())
        };
        let (kind, nm): (f64, &[f64]) = match channels.map(|(basis, _)| basis) {
            None => return list(&[]),
            Some(Basis::Xyz) => (1.0, &[]),
            Some(Basis::Bands(nm)) => (2.0, nm),
            Some(Basis::Bins(bins)) => (3.0, bins.edges_nm()),
            Some(_) => return Err(Error::invalid("expected XYZ, bands or bins")),
        };
        list(&[kind])?;
        list(nm)?;
        if let Some((_, reference)) = channels {
            list(reference.lambda_nm())?;
            list(reference.values())?;
            list(&[f64::from(u8::from(reference.outside() == Outside::Zero))])?;
        }
        Ok(())
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Option<(Basis, Spectrum)>, Error> {
        let mut list = || -> Result<Vec<f64>, Error> {
            let count = reader.number()? as usize;
            let bytes = reader.take(count.saturating_mul(8))?;
            let values = bytes.as_chunks().0.iter();
            Ok(values.map(|b| f64::from_le_bytes(*b)).collect())
        };
        let kind = list()?;
        if kind.is_empty() {
            return Ok(None);
        }
        let nm = list()?;
        let invalid = |e: &dyn std::fmt::Display| Error::invalid(e.to_string());
        let basis = match kind[..] {
            [1.0] => Basis::Xyz,
            [2.0] => Basis::Bands(nm),
            [3.0] => Basis::Bins(Bins::new(nm).map_err(|e| invalid(&e))?),
            _ => {
                return Err(Error::invalid(
                    "expected a kind of channels, found another number",
                ));
            }
        };
        let (knots, values) = (list()?, list()?);
        let outside = match list()?[..] {
            [0.0] => Outside::Hold,
            _ => Outside::Zero,
        };
        let reference = Spectrum::new(knots, values, outside).map_err(|e| invalid(&e))?;
        Ok(Some((basis, reference)))
    }
}
