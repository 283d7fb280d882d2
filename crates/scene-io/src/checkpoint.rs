//! The state of a render on disk: a killed render goes on to the same bits.

use crate::error::{Error, ErrorKind};
use crate::sealed::{Label, seal, unseal};
use crate::{load, write};
use std::path::Path;
use tracer::Film;

/// Raised whenever the layout below, or the meaning of a sample number, changes.
const VERSION: u32 = 1;
/// Largest checkpoint, bytes: 16 GiB.
const MAX_BYTES: u64 = 16 << 30;
/// Width, height, replicates, number of tiles.
const HEADER: usize = 16;

const fn label(key: u64) -> Label {
    Label {
        kind: *b"FILM",
        version: VERSION,
        key,
    }
}

/// Writes the film atomically. `key` must identify everything the samples depend on but their number: scene,
/// materials, seed, sampler.
///
/// # Errors
/// If the file cannot be written; the checkpoint before it then stays.
pub fn save<const N: usize>(path: &Path, film: &Film<N>, key: u64) -> Result<(), Error> {
    let mut payload = Vec::new();
    let tiles = film.tiles();
    let numbers = [
        film.width(),
        film.height(),
        film.replicates(),
        u32::try_from(tiles.len()).map_err(|_| Error::invalid("expected fewer than 2^32 tiles"))?,
    ];
    for number in numbers {
        payload.extend_from_slice(&number.to_le_bytes());
    }
    for tile in tiles {
        payload.extend_from_slice(&tile.done().to_le_bytes());
        for value in tile.sums().iter().flatten() {
            payload.extend_from_slice(&value.to_le_bytes());
        }
    }
    write::bytes(path, &seal(label(key), &payload))
}

/// Puts the samples of a checkpoint into `film`, which has the size and replicates it will be rendered with.
///
/// # Errors
/// If the file cannot be read, is damaged, of another version, of another render, or of another size; the film
/// is then as it was.
pub fn restore<const N: usize>(path: &Path, film: &mut Film<N>, key: u64) -> Result<(), Error> {
    let bytes = load::bytes(path, MAX_BYTES)?;
    let payload = unseal(label(key), &bytes).map_err(|refusal| {
        let message = format!("not a checkpoint of this render: {refusal}");
        Error::new(ErrorKind::Invalid, message).in_file(path)
    })?;
    let mut restored = Film::new(film.width(), film.height(), film.replicates());
    fill(&mut restored, payload).map_err(|e| e.in_file(path))?;
    *film = restored;
    Ok(())
}

fn fill<const N: usize>(film: &mut Film<N>, payload: &[u8]) -> Result<(), Error> {
    let short = || Error::invalid("expected the sums of a film, found fewer bytes");
    let (header, mut rest) = payload.split_at_checked(HEADER).ok_or_else(short)?;
    let numbers: Vec<u32> = (header.as_chunks().0.iter().copied())
        .map(u32::from_le_bytes)
        .collect();
    let tiles = film.tiles().len();
    let expected = [film.width(), film.height(), film.replicates()];
    if numbers[..3] != expected || numbers[3] as usize != tiles {
        return Err(Error::invalid(format!(
            "expected a film of {} x {} pixels and {} replicates, found {} x {} and {}",
            expected[0], expected[1], expected[2], numbers[0], numbers[1], numbers[2]
        )));
    }
    for index in 0..tiles {
        let count = film.tiles()[index].sums().len();
        let (done, after) = rest.split_first_chunk().ok_or_else(short)?;
        let (sums, after) = after.split_at_checked(count * N * 8).ok_or_else(short)?;
        let values = sums.as_chunks().0;
        let sums: Vec<[f64; N]> = (values.as_chunks::<N>().0.iter())
            .map(|pixel| pixel.map(f64::from_le_bytes))
            .collect();
        film.restore(index, u32::from_le_bytes(*done), &sums)
            .map_err(|e| Error::invalid(e.to_string()))?;
        rest = after;
    }
    if rest.is_empty() {
        Ok(())
    } else {
        Err(Error::invalid(
            "expected the end of the checkpoint, found more bytes",
        ))
    }
}
