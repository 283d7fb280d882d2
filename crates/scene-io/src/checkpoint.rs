//! The state of a render on disk: a killed render goes on to the same bits, and parts become a whole.

use crate::error::{Error, ErrorKind};
use crate::sealed::{Label, Refusal, seal, unseal, unseal_any};
use crate::{load, write};
use std::path::Path;
use tracer::{Film, Shard};

/// Raised whenever the layout below, or the meaning of a sample number, changes.
const VERSION: u32 = 2;
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
    let bytes = load::bytes(path, MAX_BYTES)?;
    let payload = unseal(label(key), &bytes).map_err(|r| refused(path, r))?;
    let expected = [film.width(), film.height(), film.replicates()];
    let (restored, about) = read(payload, Some(expected)).map_err(|e| e.in_file(path))?;
    *film = restored;
    Ok(about)
}

/// Reads a checkpoint of any render.
///
/// # Errors
/// If the file cannot be read, is damaged or of another version.
pub fn open<const N: usize>(path: &Path) -> Result<Found<N>, Error> {
    let bytes = load::bytes(path, MAX_BYTES)?;
    let (key, payload) = unseal_any(label(0), &bytes).map_err(|r| refused(path, r))?;
    let (film, about) = read(payload, None).map_err(|e| e.in_file(path))?;
    Ok(Found { film, about, key })
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

fn read<const N: usize>(
    payload: &[u8],
    expected: Option<[u32; 3]>,
) -> Result<(Film<N>, About), Error> {
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
        shard: (count > 0).then_some(Shard { index, count }),
    };
    let found = [width, height, replicates];
    if let Some(expected) = expected.filter(|e| *e != found) {
        return Err(Error::invalid(format!(
            "expected a film of {} x {} pixels and {} replicates, found {} x {} and {}",
            expected[0], expected[1], expected[2], found[0], found[1], found[2]
        )));
    }
    // the film is only made once its sums are known to be there
    let sums = (u128::from(width) * u128::from(height) * u128::from(replicates)) * 8 * N as u128;
    let bytes = sums + 4 * u128::from(tiles);
    if bytes != reader.0.len() as u128 || sums == 0 {
        return Err(Error::invalid(format!(
            "expected {bytes} bytes of sums for {width} x {height} pixels, found {}",
            reader.0.len()
        )));
    }
    let mut film = Film::new(width, height, replicates);
    if film.tiles().len() != tiles as usize {
        let message = format!("expected {} tiles, found {tiles}", film.tiles().len());
        return Err(Error::invalid(message));
    }
    for index in 0..film.tiles().len() {
        let done = reader.number()?;
        let values = reader.take(film.tiles()[index].sums().len() * N * 8)?;
        let sums: Vec<[f64; N]> = (values.as_chunks().0.as_chunks::<N>().0.iter())
            .map(|pixel| pixel.map(f64::from_le_bytes))
            .collect();
        film.restore(index, done, &sums)
            .map_err(|e| Error::invalid(e.to_string()))?;
    }
    Ok((film, about))
}
