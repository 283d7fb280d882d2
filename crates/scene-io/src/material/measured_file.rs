//! Measured files: bytes to [`LoadedMeasured`].

use super::colour::Recolouring;
use super::identity::Identity;
use super::loaded::{Detail, Form, LoadedMeasured};
use super::options::MaterialOptions;
use super::scattered;
use crate::cache::combine;
use crate::error::{Error, ErrorKind, os_message};
use crate::load;
use crate::scene::{ColourChoice, InterpolationName, NegativeName};
use crate::sealed::content_hash;
use brdf::Measured;
use brdf_formats::{File, Format, MerlReader, PREFIX, ReadAt, RglFile};
use brdf_table::{CellPolicy, GridError, Gridded, HalfDiffTable, Interpolation, RglTable};
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads any known measured file, whatever it is called.
///
/// MERL files are decoded while they are read: at no time is there more than the table and a small buffer.
///
/// # Errors
/// Unreadable files, unknown formats, broken content, an interpolation or policy that does not go with the format.
pub fn load_measured(path: &Path, options: &MaterialOptions) -> Result<LoadedMeasured, Error> {
    let load = || match Content::open(path)? {
        Content::Merl { format, source, of } => merl((format, of), &source, options),
        Content::Parsed { file, of } => parsed(&file, of, options),
    };
    load()
        .map(|loaded| LoadedMeasured {
            path: path.to_owned(),
            ..loaded
        })
        .map_err(|e: Error| e.in_file(path))
}

/// [`load_measured`] from memory; names no path.
///
/// # Errors
/// As [`load_measured`].
pub(crate) fn measured_from_bytes(
    bytes: &[u8],
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let of = Origin {
        bytes: bytes.len() as u64,
        key: content_hash(bytes),
    };
    match brdf_formats::detect(bytes) {
        Some(format) if format.name == "merl" => merl((format, of), bytes, options),
        _ => parsed(
            &brdf_formats::read(bytes.to_vec()).map_err(broken)?,
            of,
            options,
        ),
    }
}

/// What a file is and holds, without making an interpolant: scattered rows are counted, nothing is solved for them.
///
/// # Errors
/// Unreadable files, unknown formats, broken content, a `colour` that does not go with the format.
pub fn identify(path: &Path, colour: &ColourChoice) -> Result<Identity, Error> {
    let options = MaterialOptions {
        colour: *colour,
        ..MaterialOptions::default()
    };
    let identify = || match Content::open(path)? {
        Content::Merl { format, source, of } => {
            merl((format, of), &source, &options).map(Identity::of)
        }
        Content::Parsed { file, of } => match scattered::cloud(&file) {
            Some(cloud) => {
                let (cloud, format) = (cloud?, file.format());
                let recolouring = Recolouring::new(colour, format, cloud.basis())?;
                Ok(Identity::of_rows(format, of.bytes, &cloud, recolouring))
            }
            None => parsed(&file, of, &options).map(Identity::of),
        },
    };
    identify()
        .map(|identity| Identity {
            path: path.to_owned(),
            ..identity
        })
        .map_err(|e: Error| e.in_file(path))
}

/// Whether the beginning of a file is that of a known format; false for what cannot be read.
#[must_use]
pub fn is_measured(path: &Path) -> bool {
    let Ok((mut file, bytes)) = load::open(path, load::MAX_FILE_BYTES) else {
        return false;
    };
    let mut prefix = Vec::new();
    (file.by_ref().take(PREFIX as u64).read_to_end(&mut prefix)).is_ok()
        && brdf_formats::detect_prefix(&prefix, bytes).is_some()
}

/// What tells one file from another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    /// Its size.
    pub(super) bytes: u64,
    /// The hash of its content; 0 where the content is a table that is hashed by its cells.
    pub(super) key: u64,
}

/// A file, as far as it is read before the options matter.
enum Content {
    /// Still to be decoded.
    Merl {
        format: &'static Format,
        source: load::Places,
        of: Origin,
    },
    Parsed {
        file: File,
        of: Origin,
    },
}

impl Content {
    fn open(path: &Path) -> Result<Self, Error> {
        let refuse = |e: std::io::Error| {
            let message = format!("cannot read: {}", os_message(&e));
            Error::new(ErrorKind::Read, message)
        };
        let (mut file, bytes) = load::open(path, load::MAX_FILE_BYTES)?;
        let mut prefix = Vec::new();
        (file.by_ref().take(PREFIX as u64).read_to_end(&mut prefix)).map_err(refuse)?;
        let found = brdf_formats::detect_prefix(&prefix, bytes);
        if let Some(format) = found.filter(|f| f.name == "merl") {
            let (source, of) = (load::Places(file), Origin { bytes, key: 0 });
            return Ok(Self::Merl { format, source, of });
        }
        let mut content = Vec::with_capacity(usize::try_from(bytes).unwrap_or(0));
        let source = Cursor::new(prefix).chain(file);
        (source.take(bytes).read_to_end(&mut content)).map_err(refuse)?;
        let key = content_hash(&content);
        let file = brdf_formats::read(content).map_err(broken)?;
        let of = Origin { bytes, key };
        Ok(Self::Parsed { file, of })
    }
}

fn parsed(file: &File, of: Origin, options: &MaterialOptions) -> Result<LoadedMeasured, Error> {
    if let Some(cloud) = scattered::cloud(file) {
        return scattered::load(file.format(), of, &cloud?, options);
    }
    match file {
        File::Merl(merl_file) => merl((file.format(), of), merl_file.as_bytes(), options),
        File::Rgl(file_rgl) => rgl((file.format(), of), file_rgl, options),
        _ => Err(Error::unsupported(format!(
            "{} files are read but cannot be rendered yet",
            file.format().title
        ))),
    }
}

/// Place and problem by the reader's own words; the file name goes in front of it.
fn broken(e: brdf_formats::Error) -> Error {
    let kind = match e.kind() {
        brdf_formats::ErrorKind::Unsupported => ErrorKind::Unsupported,
        brdf_formats::ErrorKind::Io => ErrorKind::Read,
        _ => ErrorKind::Invalid,
    };
    Error::new(kind, e.to_string())
}

fn merl(
    (format, of): (&'static Format, Origin),
    source: &(impl ReadAt + ?Sized),
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let interpolation = match options.interpolation {
        InterpolationName::Auto | InterpolationName::Linear => Interpolation::Linear,
        InterpolationName::Nearest => Interpolation::Nearest,
        other => return Err(misplaced(other)),
    };
    no_gaps(options)?;
    let policy = match options.negatives {
        NegativeName::Auto => CellPolicy::default(),
        NegativeName::Clamp => CellPolicy::PerChannel,
        NegativeName::Keep => CellPolicy::AllNegative,
    };
    let reader = MerlReader::new(source, of.bytes).map_err(broken)?;
    let (table, cells) = HalfDiffTable::from_merl_reader(&reader, policy).map_err(|e| match e {
        GridError::File(e) => broken(e),
        other => Error::invalid(other.to_string()),
    })?;
    if cells.measured == 0 {
        return Err(Error::invalid("expected measured cells, found none"));
    }
    let dims = table.dims();
    let recolouring = Recolouring::new(&options.colour, format, table.basis())?;
    let table = recolouring.table(table)?;
    let gridded = Gridded {
        table: Arc::new(table),
        interpolation,
    };
    Ok(LoadedMeasured {
        measured: Arc::new(gridded.clone()),
        format,
        path: PathBuf::new(),
        bytes: of.bytes,
        colour: recolouring.meaning,
        detail: Detail::Grid { dims, cells },
        form: Form::Grid(gridded),
    })
}

fn rgl(
    (format, of): (&'static Format, Origin),
    file: &RglFile,
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    if !matches!(
        options.interpolation,
        InterpolationName::Auto | InterpolationName::Linear
    ) {
        return Err(misplaced(options.interpolation));
    }
    no_gaps(options)?;
    if options.negatives == NegativeName::Clamp {
        let message = "expected \"auto\" or \"keep\" for an RGL file, found \"clamp\"";
        return Err(Error::invalid(message).in_field("negatives"));
    }
    let table = Arc::new(RglTable::new(file).map_err(broken)?);
    let mut measured = Arc::clone(&table) as Arc<dyn Measured>;
    let mut form = Form::Rgl(table, of.key);
    let recolouring = Recolouring::new(&options.colour, format, measured.basis())?;
    let colour = recolouring.meaning.clone();
    if recolouring.changes() {
        form = Form::Opaque(combine(&[of.key, recolouring.key()]));
        measured = recolouring.measured(measured);
    }
    Ok(LoadedMeasured {
        measured,
        format,
        path: PathBuf::new(),
        bytes: of.bytes,
        colour,
        detail: Detail::Rgl {
            description: file.description(),
        },
        form,
    })
}

/// The cells of a grid leave nothing open that these policies could decide.
fn no_gaps(options: &MaterialOptions) -> Result<(), Error> {
    let refuse = |field: &str, found: &str| {
        let message =
            format!("expected scattered measurements for this policy (\"{found}\"), found a grid");
        Err(Error::invalid(message).in_field(field))
    };
    match (options.gap, options.beyond) {
        (Some(name), _) => refuse("gap", name.name()),
        (_, Some(name)) => refuse("beyond", name.name()),
        _ => Ok(()),
    }
}

fn misplaced(name: InterpolationName) -> Error {
    Error::invalid(format!(
        "expected an interpolation that goes with this format (nearest or linear for grids, linear for RGL), found \"{name}\""
    ))
}
