//! Every byte that leaves does so here: whole or not at all.

use crate::error::{Error, ErrorKind, os_message};
use std::fs::Metadata;
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// What a file may be written through: EXR seeks back to its offset table.
pub trait WriteSeek: Write + Seek {}
impl<T: Write + Seek> WriteSeek for T {}

/// Writes `path` atomically: `fill` writes a temporary file in the same folder, which then takes the name.
///
/// Whoever reads `path` sees the old content or the new, never a part. On any failure the temporary file
/// is removed and the old content stays. A symbolic link stays one: the file it leads to is written.
///
/// # Errors
/// If `path` is a folder, pipe or device or a link to nothing, the folder does not exist or may not be written, the
/// disk is full, or `fill` fails.
pub fn atomically(
    path: &Path,
    fill: impl FnOnce(&mut dyn WriteSeek) -> io::Result<()>,
) -> Result<(), Error> {
    let destination = destination(path)?;
    let failed = |e: &io::Error| failed(path, e);
    let mut file = temporary(&destination).map_err(|e| failed(&e))?;
    {
        let mut buffered = BufWriter::new(file.as_file_mut());
        fill(&mut buffered)
            .and_then(|()| buffered.flush())
            .map_err(|e| failed(&e))?;
    }
    // Without this a crash of the machine could leave the new name with no content.
    file.as_file().sync_all().map_err(|e| failed(&e))?;
    file.persist(&destination).map_err(|e| failed(&e.error))?;
    Ok(())
}

/// Whether `path` can be written, as far as can be told before there is anything to write: for callers that would
/// otherwise find out after hours of rendering.
///
/// Makes and removes a temporary file in its folder; whatever lies at `path` is not touched.
///
/// # Errors
/// As [`atomically`], except for what depends on the content.
pub fn check(path: &Path) -> Result<(), Error> {
    let file = temporary(&destination(path)?).map_err(|e| failed(path, &e))?;
    file.close().map_err(|e| failed(path, &e))
}

/// The path that takes the content: `path` itself, or where it leads if it is a symbolic link.
///
/// Renaming over a device or pipe would replace it for everyone, so only regular files are replaced.
fn destination(path: &Path) -> Result<PathBuf, Error> {
    let refused = |found: &str| {
        let message = format!("cannot write: expected a file name, found {found}");
        Error::new(ErrorKind::Write, message).in_file(path)
    };
    if path.file_name().is_none() {
        return Err(refused("a folder"));
    }
    let about = match path.symlink_metadata() {
        Ok(about) => about,
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(path.to_owned()),
        Err(e) => return Err(failed(path, &e)),
    };
    if !about.is_symlink() {
        return regular(&about).map(|()| path.to_owned()).map_err(refused);
    }
    let target = path.canonicalize().map_err(|e| match e.kind() {
        io::ErrorKind::NotFound => refused("a link to nothing"),
        _ => failed(path, &e),
    })?;
    let about = target.metadata().map_err(|e| failed(path, &e))?;
    regular(&about).map(|()| target).map_err(refused)
}

fn regular(about: &Metadata) -> Result<(), &'static str> {
    match (about.is_file(), about.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err("a folder"),
        _ => Err("a pipe or device"),
    }
}

/// An empty file in the folder of `destination`, under a name nobody uses.
fn temporary(destination: &Path) -> io::Result<NamedTempFile> {
    let folder = match destination.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut temporary = tempfile::Builder::new();
    temporary.prefix(".gonio-").suffix(".tmp");
    // Ours to be read by others like any output, unlike the private files tempfile is made for.
    #[cfg(unix)]
    temporary.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    temporary.tempfile_in(folder)
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
