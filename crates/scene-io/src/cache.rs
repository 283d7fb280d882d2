//! What is slow to compute and quick to read: kept on disk, rebuilt whenever in doubt.

use crate::sealed::{Label, content_hash, seal, unseal};
use crate::{load, write};
use brdf_sampling::{Proposal, RejectionCache};
use std::path::{Path, PathBuf};

/// Raised whenever the search for maxima or the layout below changes.
const VERSION: u32 = 1;
/// Largest cache file, bytes.
const MAX_BYTES: u64 = 64 << 20;
/// Most slices of a stored rejection cache: 4 million.
const MAX_SLICES: usize = 1 << 22;

/// A folder of cache files, or none: then nothing is kept.
#[derive(Clone, Debug, Default)]
pub struct Cache {
    folder: Option<PathBuf>,
}

impl Cache {
    /// Keeps files in `folder`, which is made when first needed.
    #[must_use]
    pub fn at(folder: PathBuf) -> Self {
        Self {
            folder: Some(folder),
        }
    }

    /// Where the rejection maxima for `key` are kept.
    #[must_use]
    pub fn rejection_path(&self, key: u64) -> Option<PathBuf> {
        let folder = self.folder.as_ref()?;
        Some(folder.join(format!("rejection-{key:016x}.gonio")))
    }

    /// The maxima for `key`: from disk if a sound file is there, else from `build`, and then kept.
    ///
    /// `key` identifies the reflectance and every option of the search. A damaged or outdated file, or a folder
    /// that may not be written, only costs time; `notes` says so.
    pub fn rejection(
        &self,
        key: u64,
        notes: &mut Vec<String>,
        build: impl FnOnce() -> RejectionCache,
    ) -> RejectionCache {
        let Some(path) = self.rejection_path(key) else {
            return build();
        };
        if path.exists() {
            match read(&path, key) {
                Ok(cache) => return cache,
                Err(why) => notes.push(format!("{}: ignored, {why}; rebuilt", path.display())),
            }
        }
        let cache = build();
        if let Err(e) = self.keep(&path, key, &cache) {
            notes.push(format!("rejection maxima are not kept: {e}"));
        }
        cache
    }

    fn keep(&self, path: &Path, key: u64, cache: &RejectionCache) -> Result<(), crate::Error> {
        if let Some(folder) = &self.folder {
            write::folder(folder)?;
        }
        write::bytes(path, &seal(label(key), &encode(cache)))
    }
}

/// One key from several: the order matters.
#[must_use]
pub(crate) fn combine(parts: &[u64]) -> u64 {
    let bytes: Vec<u8> = parts.iter().flat_map(|p| p.to_le_bytes()).collect();
    content_hash(&bytes)
}

const fn label(key: u64) -> Label {
    Label {
        kind: *b"REJM",
        version: VERSION,
        key,
    }
}

fn read(path: &Path, key: u64) -> Result<RejectionCache, String> {
    let bytes = load::bytes(path, MAX_BYTES).map_err(|e| e.to_string())?;
    let payload = unseal(label(key), &bytes).map_err(|e| e.to_string())?;
    let cache = decode(payload).ok_or("its content contradicts itself")?;
    cache.check().map_err(|e| e.to_string())?;
    Ok(cache)
}

/// Three u64 (elevations, azimuths, proposal), then maxima, then integrals, f64.
fn encode(cache: &RejectionCache) -> Vec<u8> {
    let proposal = match cache.proposal {
        Proposal::Uniform => 0,
        Proposal::Cosine => 1,
    };
    let numbers = [cache.n_theta as u64, cache.n_phi as u64, proposal];
    let values = cache.maxima.iter().chain(&cache.integrals);
    (numbers.iter().flat_map(|n| n.to_le_bytes()))
        .chain(values.flat_map(|v| v.to_le_bytes()))
        .collect()
}

fn decode(payload: &[u8]) -> Option<RejectionCache> {
    let (words, rest) = payload.as_chunks::<8>();
    let (&[n_theta, n_phi, proposal], values) = words.split_first_chunk()?;
    let number = |word| usize::try_from(u64::from_le_bytes(word)).ok();
    let (n_theta, n_phi) = (number(n_theta)?, number(n_phi)?);
    let slices = n_theta.checked_mul(n_phi).filter(|n| *n <= MAX_SLICES)?;
    if !rest.is_empty() || values.len() != 2 * slices {
        return None;
    }
    let (maxima, integrals) = values.split_at(slices);
    let floats = |words: &[[u8; 8]]| words.iter().map(|w| f64::from_le_bytes(*w)).collect();
    Some(RejectionCache {
        n_theta,
        n_phi,
        proposal: match u64::from_le_bytes(proposal) {
            0 => Proposal::Uniform,
            1 => Proposal::Cosine,
            _ => return None,
        },
        maxima: floats(maxima),
        integrals: floats(integrals),
    })
}
