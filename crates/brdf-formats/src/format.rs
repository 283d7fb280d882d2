//! The registry of formats, and detection by content.

use crate::error::Error;
use crate::file::File;
use crate::{astm, kaist, merl, pbrt_text, rgl};
use std::io::{self, Write};

/// How a file is written, if its format has a writer.
pub type Writer = fn(&File, &mut dyn Write) -> io::Result<()>;

/// One file format: everything that help, docs and tests derive from.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Format {
    /// Short name, for instance `merl`.
    pub name: &'static str,
    /// What it is, for people.
    pub title: &'static str,
    /// What in the content it is recognised by.
    pub magic: &'static str,
    /// Usual file extensions, without the dot; never used to tell formats apart.
    pub extensions: &'static [&'static str],
    /// Whether a file that starts with these bytes and has this length is of the format.
    pub detect: fn(&[u8], u64) -> bool,
    /// Reads a whole file.
    pub read: fn(Vec<u8>) -> Result<File, Error>,
    /// Writes a file of this format.
    pub writer: Option<Writer>,
    /// The page about it, from the root of the repository.
    pub docs: &'static str,
}

/// Every known format, in the order in which detection tries them.
pub const FORMATS: &[Format] = &[
    kaist::FORMAT,
    rgl::FORMAT,
    merl::FORMAT,
    astm::FORMAT,
    pbrt_text::FORMAT,
];

/// Bytes from the start of a file that [`detect_prefix`] wants to see, if there are as many.
pub const PREFIX: usize = 1 << 16;

/// The format of a whole file, from its content; `None` if no reader knows it.
#[must_use]
pub fn detect(bytes: &[u8]) -> Option<&'static Format> {
    detect_prefix(bytes, bytes.len() as u64)
}

/// The format of a file of `total_len` bytes that starts with `prefix`, of which at least [`PREFIX`]
/// bytes should be given.
#[must_use]
pub fn detect_prefix(prefix: &[u8], total_len: u64) -> Option<&'static Format> {
    let prefix = &prefix[..prefix.len().min(PREFIX)];
    FORMATS.iter().find(|f| (f.detect)(prefix, total_len))
}
