//! Every byte that enters does so here: regular files of a bounded size.

use crate::error::{Error, ErrorKind, os_message};
use brdf_formats::ReadAt;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Largest file of any kind that is read, bytes: 4 GiB.
pub const MAX_FILE_BYTES: u64 = 4 << 30;
/// Largest scene, bytes: 16 MiB.
pub const MAX_SCENE_BYTES: u64 = 16 << 20;

/// Opens a regular file of at most `max_bytes`; returns it with its length.
///
/// # Errors
/// If it does not exist, is a folder, pipe or device, is too large or may not be read.
#[expect(
    clippy::disallowed_methods,
    reason = "the one place where files are opened for reading"
)]
pub fn open(path: &Path, max_bytes: u64) -> Result<(File, u64), Error> {
    let refuse = |e: &io::Error| {
        let kind = match e.kind() {
            io::ErrorKind::NotFound => ErrorKind::NotFound,
            _ => ErrorKind::Read,
        };
        Error::new(kind, format!("cannot read: {}", os_message(e))).in_file(path)
    };
    // Before opening: opening a named pipe would wait for its writer.
    let about = std::fs::metadata(path).map_err(|e| refuse(&e))?;
    if !about.is_file() {
        let what = if about.is_dir() {
            "a folder"
        } else {
            "a pipe or device"
        };
        return Err(Error::invalid(format!("expected a file, found {what}")).in_file(path));
    }
    if about.len() > max_bytes {
        let message = format!(
            "expected at most {max_bytes} bytes, found {} bytes",
            about.len()
        );
        return Err(Error::new(ErrorKind::TooLarge, message).in_file(path));
    }
    Ok((File::open(path).map_err(|e| refuse(&e))?, about.len()))
}

/// A file to be read anywhere, by several threads at once.
#[derive(Debug)]
pub(crate) struct Places(pub(crate) File);

impl ReadAt for Places {
    #[cfg(unix)]
    fn read_exact_at(&self, into: &mut [u8], at: u64) -> io::Result<()> {
        std::os::unix::fs::FileExt::read_exact_at(&self.0, into, at)
    }

    #[cfg(windows)]
    fn read_exact_at(&self, mut into: &mut [u8], mut at: u64) -> io::Result<()> {
        while !into.is_empty() {
            match std::os::windows::fs::FileExt::seek_read(&self.0, into, at) {
                Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
                Ok(n) => (into, at) = (&mut into[n..], at + n as u64),
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }
}

/// The whole content of a regular file of at most `max_bytes`.
///
/// # Errors
/// As [`open`]; also if the file grows beyond the bound while it is read.
pub fn bytes(path: &Path, max_bytes: u64) -> Result<Vec<u8>, Error> {
    let (file, length) = open(path, max_bytes)?;
    let mut content = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    file.take(max_bytes + 1)
        .read_to_end(&mut content)
        .map_err(|e| {
            let message = format!("cannot read: {}", os_message(&e));
            Error::new(ErrorKind::Read, message).in_file(path)
        })?;
    if content.len() as u64 > max_bytes {
        let message = format!("expected at most {max_bytes} bytes, found more");
        return Err(Error::new(ErrorKind::TooLarge, message).in_file(path));
    }
    Ok(content)
}

/// The whole content of a UTF-8 text file of at most `max_bytes`.
///
/// # Errors
/// As [`bytes`]; also if the content is not UTF-8.
pub fn text(path: &Path, max_bytes: u64) -> Result<String, Error> {
    String::from_utf8(bytes(path, max_bytes)?).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        Error::invalid(format!("expected UTF-8 text, found another byte at {at}")).in_file(path)
    })
}
