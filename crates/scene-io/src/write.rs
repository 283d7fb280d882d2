//! Every byte that leaves does so here: whole or not at all.

use crate::error::{Error, ErrorKind, os_message};
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;
use tempfile::NamedTempFile;

/// What a file may be written through: EXR seeks back to its offset table.
pub trait WriteSeek: Write + Seek {}
impl<T: Write + Seek> WriteSeek for T {}

/// Writes `path` atomically: `fill` writes a temporary file in the same folder, which then takes the name.
///
/// Whoever reads `path` sees the old content or the new, never a part. On any failure the temporary file
/// is removed and the old content stays.
///
/// # Errors
/// If the folder does not exist or may not be written, the disk is full, or `fill` fails.
pub fn atomically(
    path: &Path,
    fill: impl FnOnce(&mut dyn WriteSeek) -> io::Result<()>,
) -> Result<(), Error> {
    let failed = |e: &io::Error| failed(path, e);
    let mut file = temporary(path)?;
    {
        let mut buffered = BufWriter::new(file.as_file_mut());
        fill(&mut buffered)
            .and_then(|()| buffered.flush())
            .map_err(|e| failed(&e))?;
    }
    // Without this a crash of the machine could leave the new name with no content.
    file.as_file().sync_all().map_err(|e| failed(&e))?;
    file.persist(path).map_err(|e| failed(&e.error))?;
    Ok(())
}

/// Whether `path` could be written now; long work asks before it begins. Leaves nothing behind.
///
/// # Errors
/// If `path` is a folder, or its folder does not exist or may not be written.
pub fn check(path: &Path) -> Result<(), Error> {
    temporary(path).map(drop)
}

fn temporary(path: &Path) -> Result<NamedTempFile, Error> {
    if path.file_name().is_none() || path.is_dir() {
        let message = "cannot write: expected a file name, found a folder";
        return Err(Error::new(ErrorKind::Write, message).in_file(path));
    }
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut temporary = tempfile::Builder::new();
    temporary.prefix(".gonio-").suffix(".tmp");
    // Ours to be read by others like any output, unlike the private files tempfile is made for.
    #[cfg(unix)]
    temporary.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    temporary.tempfile_in(folder).map_err(|e| failed(path, &e))
}

fn failed(path: &Path, e: &io::Error) -> Error {
    Error::new(ErrorKind::Write, format!("cannot write: {}", os_message(e))).in_file(path)
}

/// Writes `content` to `path` atomically.
///
/// # Errors
/// As [`atomically`].
pub fn bytes(path: &Path, content: &[u8]) -> Result<(), Error> {
    atomically(path, |w| w.write_all(content))
}

/// Creates a folder and its parents.
///
/// # Errors
/// If the operating system refuses.
pub fn folder(path: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(path).map_err(|e| {
        let message = format!("cannot create the folder: {}", os_message(&e));
        Error::new(ErrorKind::Write, message).in_file(path)
    })
}
