//! What is slow to compute and quick to read: kept on disk, rebuilt whenever in doubt.

mod grid;

use crate::sealed::{Label, content_hash, seal, unseal};
use crate::{load, write};
use brdf_sampling::{Proposal, RejectionCache};
use brdf_table::Resampled;
use std::path::{Path, PathBuf};

/// Raised whenever the search for maxima or the layout below changes.
const VERSION: u32 = 1;
/// Largest cache file, bytes: a grid of 65 bands has 135 MB.
const MAX_BYTES: u64 = 512 << 20;
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
        self.path(REJECTION.name, key)
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
        self.stored(&REJECTION, key, notes, build)
    }

    /// Where the grid for `key` is kept.
    #[must_use]
    pub fn grid_path(&self, key: u64) -> Option<PathBuf> {
        self.path(grid::KIND.name, key)
    }

    /// The resampled interpolant for `key`, in linear sRGB or in bands: as [`Self::rejection`].
    ///
    /// `key` identifies the file, the policies, the channels and the cells.
    pub fn grid(
        &self,
        key: u64,
        notes: &mut Vec<String>,
        build: impl FnOnce() -> Resampled,
    ) -> Resampled {
        self.stored(&grid::KIND, key, notes, build)
    }

    fn path(&self, name: &str, key: u64) -> Option<PathBuf> {
        let folder = self.folder.as_ref()?;
        Some(folder.join(format!("{name}-{key:016x}.gonio")))
    }

    fn stored<T>(
        &self,
        kind: &Kind<T>,
        key: u64,
        notes: &mut Vec<String>,
        build: impl FnOnce() -> T,
    ) -> T {
        let Some(path) = self.path(kind.name, key) else {
            return build();
        };
        if path.exists() {
            match kind.read(&path, key) {
                Ok(content) => return content,
                Err(why) => notes.push(format!("{}: ignored, {why}; rebuilt", path.display())),
            }
        }
        let content = build();
        if let Err(e) = self.keep(&path, &seal(kind.label(key), &(kind.encode)(&content))) {
            notes.push(format!("the {} is not kept: {e}", kind.name));
        }
        content
    }

    fn keep(&self, path: &Path, sealed: &[u8]) -> Result<(), crate::Error> {
        if let Some(folder) = &self.folder {
            write::folder(folder)?;
        }
        write::bytes(path, sealed)
    }
}

/// One kind of content and how it is stored.
struct Kind<T> {
    tag: [u8; 4],
    version: u32,
    /// Beginning of the file names.
    name: &'static str,
    encode: fn(&T) -> Vec<u8>,
    decode: fn(&[u8]) -> Result<T, String>,
}

impl<T> Kind<T> {
    const fn label(&self, key: u64) -> Label {
        Label {
            kind: self.tag,
            version: self.version,
            key,
        }
    }

    fn read(&self, path: &Path, key: u64) -> Result<T, String> {
        let bytes = load::bytes(path, MAX_BYTES).map_err(|e| e.to_string())?;
        let payload = unseal(self.label(key), &bytes).map_err(|e| e.to_string())?;
        (self.decode)(payload)
    }
}

const REJECTION: Kind<RejectionCache> = Kind {
    tag: *b"REJM",
    version: VERSION,
    name: "rejection",
    encode,
    decode: |payload| {
        let cache = decode(payload).ok_or("its content contradicts itself")?;
        cache.check().map_err(|e| e.to_string())?;
        Ok(cache)
    },
};

/// One key from several: the order matters.
#[must_use]
pub(crate) fn combine(parts: &[u64]) -> u64 {
    let bytes: Vec<u8> = parts.iter().flat_map(|p| p.to_le_bytes()).collect();
    content_hash(&bytes)
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
