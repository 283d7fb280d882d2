//! The container of everything gonio writes for itself: magic, kind, version, key, length, payload, CRC-32.
//!
//! Little-endian. A file that is not exactly what was asked for is refused as a whole; nothing in it is
//! believed before the checksum holds.

use std::fmt;

const MAGIC: &[u8; 8] = b"gonio\r\n\0";
/// Magic, kind, version, key, length.
const HEADER: usize = 8 + 4 + 4 + 8 + 8;

/// What a sealed file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Label {
    /// Four letters.
    pub kind: [u8; 4],
    /// Raised whenever the meaning of the payload changes.
    pub version: u32,
    /// Hash of everything the payload was computed from.
    pub key: u64,
}

/// Why a sealed file was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// Shorter or longer than it says.
    Length {
        /// Bytes by the header.
        expected: u64,
        /// Bytes found.
        found: u64,
    },
    /// Not one of ours, or another kind.
    Kind,
    /// Written by another version.
    Version {
        /// The version asked for.
        expected: u32,
        /// The version found.
        found: u32,
    },
    /// Belongs to other input.
    Key,
    /// Bits have changed.
    Checksum,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { expected, found } => {
                write!(f, "expected {expected} bytes, found {found}")
            }
            Self::Kind => f.write_str("expected a file of this kind, found another"),
            Self::Version { expected, found } => {
                write!(f, "expected version {expected}, found version {found}")
            }
            Self::Key => f.write_str("belongs to other input"),
            Self::Checksum => f.write_str("the checksum does not match: bits have changed"),
        }
    }
}

impl std::error::Error for Refusal {}

/// The bytes of a sealed file.
#[must_use]
pub fn seal(label: Label, payload: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(HEADER + payload.len() + 4);
    out.extend_from_slice(MAGIC);
    out.extend_from_slice(&label.kind);
    out.extend_from_slice(&label.version.to_le_bytes());
    out.extend_from_slice(&label.key.to_le_bytes());
    out.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    out.extend_from_slice(payload);
    let checksum = crc32fast::hash(&out);
    out.extend_from_slice(&checksum.to_le_bytes());
    out
}

/// The payload of a sealed file, if it is exactly what `label` asks for.
///
/// # Errors
/// The first [`Refusal`] that applies.
pub fn unseal(label: Label, bytes: &[u8]) -> Result<&[u8], Refusal> {
    let (key, payload) = unseal_any(label, bytes)?;
    if key == label.key {
        Ok(payload)
    } else {
        Err(Refusal::Key)
    }
}

/// Key and payload of a sealed file of the kind and version of `label`, whatever its key.
///
/// # Errors
/// The first [`Refusal`] that applies.
pub fn unseal_any(label: Label, bytes: &[u8]) -> Result<(u64, &[u8]), Refusal> {
    let length = |expected: u64| Refusal::Length {
        expected,
        found: bytes.len() as u64,
    };
    if !bytes.starts_with(MAGIC) {
        return Err(Refusal::Kind);
    }
    let header: &[u8; HEADER] = bytes.first_chunk().ok_or(length(HEADER as u64 + 4))?;
    let number = |at: usize| u64::from_le_bytes(std::array::from_fn(|k| header[at + k]));
    if header[8..12] != label.kind {
        return Err(Refusal::Kind);
    }
    let version = u32::from_le_bytes(std::array::from_fn(|k| header[12 + k]));
    if version != label.version {
        return Err(Refusal::Version {
            expected: label.version,
            found: version,
        });
    }
    let total = number(24).saturating_add(HEADER as u64 + 4);
    if total != bytes.len() as u64 {
        return Err(length(total));
    }
    let (content, checksum) = bytes.split_last_chunk::<4>().ok_or(length(total))?;
    if crc32fast::hash(content).to_le_bytes() != *checksum {
        return Err(Refusal::Checksum);
    }
    Ok((number(16), &content[HEADER..]))
}

/// A 64-bit hash of bytes, the same on every machine and in every version: FNV-1a over 8-byte words with
/// a final mix. It tells files apart; it does not resist forgery.
#[must_use]
pub fn content_hash(bytes: &[u8]) -> u64 {
    const PRIME: u64 = 0x0000_0100_0000_01b3;
    let (words, rest) = bytes.as_chunks::<8>();
    let mut last = [0; 8];
    last[..rest.len()].copy_from_slice(rest);
    let tail = [u64::from_le_bytes(last), bytes.len() as u64];
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for word in words.iter().map(|w| u64::from_le_bytes(*w)).chain(tail) {
        hash = (hash ^ word).wrapping_mul(PRIME);
        hash ^= hash >> 29; // FNV alone never carries high bits of a word down
    }
    hash
}

#[cfg(test)]
mod tests {
    use super::*;

    const LABEL: Label = Label {
        kind: *b"TEST",
        version: 3,
        key: 77,
    };

    #[test]
    fn what_is_sealed_comes_back() {
        for payload in [&b""[..], b"x", b"twelve bytes"] {
            assert_eq!(unseal(LABEL, &seal(LABEL, payload)), Ok(payload));
        }
    }

    #[test]
    fn no_single_bit_may_change_and_no_byte_be_missing() {
        let sealed = seal(LABEL, b"payload");
        for bit in 0..sealed.len() * 8 {
            let mut broken = sealed.clone();
            broken[bit / 8] ^= 1 << (bit % 8);
            assert!(unseal(LABEL, &broken).is_err(), "bit {bit}");
        }
        for length in 0..sealed.len() {
            assert!(unseal(LABEL, &sealed[..length]).is_err(), "length {length}");
        }
        let longer = [&sealed[..], b"!"].concat();
        assert!(unseal(LABEL, &longer).is_err(), "longer");
    }

    #[test]
    fn other_versions_kinds_and_keys_are_refused_by_name() {
        let sealed = seal(LABEL, b"payload");
        let version = Label {
            version: 4,
            ..LABEL
        };
        let expected = Refusal::Version {
            expected: 4,
            found: 3,
        };
        assert_eq!(unseal(version, &sealed), Err(expected));
        let kind = Label {
            kind: *b"ELSE",
            ..LABEL
        };
        assert_eq!(unseal(kind, &sealed), Err(Refusal::Kind));
        assert_eq!(
            unseal(Label { key: 78, ..LABEL }, &sealed),
            Err(Refusal::Key)
        );
    }

    #[test]
    fn hashes_differ_for_every_changed_bit_and_length() {
        let base: Vec<u8> = (0..40).collect();
        let mut seen = std::collections::BTreeSet::from([content_hash(&base)]);
        for bit in 0..base.len() * 8 {
            let mut changed = base.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            assert!(seen.insert(content_hash(&changed)), "bit {bit}");
        }
        for length in 0..base.len() {
            assert!(
                seen.insert(content_hash(&base[..length])),
                "length {length}"
            );
        }
    }
}
