//! Measured files: bytes to [`LoadedMeasured`].

use super::loaded::{Detail, Form, LoadedMeasured};
use super::options::MaterialOptions;
use crate::error::{Error, ErrorKind};
use crate::load;
use crate::scene::{InterpolationName, NegativeName};
use crate::sealed::content_hash;
use brdf::Measured;
use brdf_formats::{File, Format, MERL_SCALE, MerlStream, PREFIX};
use brdf_table::{CellPolicy, Gridded, Interpolation, PhiDomain, RglTable, TableBuilder};
use brdf_table::{LayerMode, LayeredTable, NegativePolicy, Policies, SampleCloud, ThinPlate};
use spectrum::{Basis, RgbSpace};
use std::io::{Chain, Cursor, Read};
use std::path::Path;
use std::sync::Arc;

/// Reads any known measured file, whatever it is called.
///
/// MERL files are decoded while they are read: at no time is there more than the table and a small buffer.
///
/// # Errors
/// Unreadable files, unknown formats, broken content, an interpolation that does not go with the format.
pub fn load_measured(path: &Path, options: &MaterialOptions) -> Result<LoadedMeasured, Error> {
    let (mut file, length) = load::open(path, load::MAX_FILE_BYTES)?;
    let mut prefix = Vec::new();
    file.by_ref()
        .take(PREFIX as u64)
        .read_to_end(&mut prefix)
        .map_err(|e| {
            let message = format!("cannot read: {}", crate::error::os_message(&e));
            Error::new(ErrorKind::Read, message).in_file(path)
        })?;
    let source = Cursor::new(prefix).chain(file);
    from_source(source, length, options)
        .map(|loaded| LoadedMeasured {
            path: path.to_owned(),
            ..loaded
        })
        .map_err(|e| e.in_file(path))
}

/// [`load_measured`] from memory; names no path.
///
/// # Errors
/// As [`load_measured`].
pub(crate) fn measured_from_bytes(
    bytes: &[u8],
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let (prefix, rest) = bytes.split_at(bytes.len().min(PREFIX));
    let source = Cursor::new(prefix.to_vec()).chain(rest);
    from_source(source, bytes.len() as u64, options)
}

fn from_source(
    source: Chain<Cursor<Vec<u8>>, impl Read>,
    length: u64,
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    match brdf_formats::detect_prefix(source.get_ref().0.get_ref(), length) {
        Some(format) if format.name == "merl" => merl(format, source, length, options),
        _ => {
            let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
            let mut source = source.take(length);
            source.read_to_end(&mut bytes).map_err(|e| {
                let message = format!("cannot read: {}", crate::error::os_message(&e));
                Error::new(ErrorKind::Read, message)
            })?;
            let key = content_hash(&bytes);
            let file = brdf_formats::read(bytes).map_err(broken)?;
            parsed(&file, (length, key), options)
        }
    }
}

fn parsed(
    file: &File,
    (length, key): (u64, u64),
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let format = file.format();
    let invalid = |e: brdf_table::CloudError| Error::invalid(e.to_string());
    match file {
        File::Astm(astm) => {
            let cloud = SampleCloud::from_astm(astm).map_err(invalid)?;
            scattered(format, &cloud, length, options)
        }
        File::PbrtText(text) => {
            let cloud = SampleCloud::from_pbrt_text(text).map_err(invalid)?;
            scattered(format, &cloud, length, options)
        }
        File::Merl(merl_file) => merl(format, Cursor::new(merl_file.to_bytes()), length, options),
        File::Rgl(rgl) => {
            if !matches!(
                options.interpolation,
                InterpolationName::Auto | InterpolationName::Linear
            ) {
                return Err(misplaced(options.interpolation));
            }
            let table = Arc::new(RglTable::new(rgl).map_err(broken)?);
            Ok(LoadedMeasured {
                measured: Arc::clone(&table) as Arc<dyn Measured>,
                format,
                path: Default::default(),
                bytes: length,
                detail: Detail::Rgl {
                    description: rgl.description(),
                },
                form: Form::Rgl(table, key),
            })
        }
        _ => Err(Error::unsupported(format!(
            "{} files are read but cannot be rendered yet",
            format.title
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
    format: &'static Format,
    source: impl Read,
    length: u64,
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let interpolation = match options.interpolation {
        InterpolationName::Auto | InterpolationName::Linear => Interpolation::Linear,
        InterpolationName::Nearest => Interpolation::Nearest,
        other => return Err(misplaced(other)),
    };
    let policy = match options.negatives {
        NegativeName::Auto => CellPolicy::default(),
        NegativeName::Clamp => CellPolicy::PerChannel,
        NegativeName::Keep => CellPolicy::AllNegative,
    };
    let mut stream = MerlStream::new(source, length).map_err(broken)?;
    let dims = stream.dims().map(|n| n as usize);
    // 360 azimuths instead of 180 cover the full circle: such tables need not be reciprocal.
    let phi = if dims[2] > 180 {
        PhiDomain::Full
    } else {
        PhiDomain::Reciprocal
    };
    let invalid = |e: brdf_table::GridError| Error::invalid(e.to_string());
    let basis = Basis::Rgb(RgbSpace::srgb());
    let mut builder = TableBuilder::new(dims, phi, basis, MERL_SCALE.to_vec()).map_err(invalid)?;
    while let Some(values) = stream.next_chunk().map_err(broken)? {
        builder.push(values).map_err(invalid)?;
    }
    let (table, cells) = builder.finish(policy).map_err(invalid)?;
    if cells.measured == 0 {
        return Err(Error::invalid("expected measured cells, found none"));
    }
    let gridded = Gridded {
        table: Arc::new(table),
        interpolation,
    };
    Ok(LoadedMeasured {
        measured: Arc::new(gridded.clone()),
        format,
        path: Default::default(),
        bytes: length,
        detail: Detail::Grid { dims, cells },
        form: Form::Grid(gridded),
    })
}

fn misplaced(name: InterpolationName) -> Error {
    Error::invalid(format!(
        "expected an interpolation that goes with this format (nearest or linear for grids, linear for RGL), found \"{name}\""
    ))
}

fn scattered(
    format: &'static Format,
    cloud: &SampleCloud,
    length: u64,
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let mode = match options.interpolation {
        InterpolationName::Auto | InterpolationName::ThinPlate => {
            return thin_plate(format, cloud, length, options.negatives);
        }
        InterpolationName::Nearest => LayerMode::Nearest,
        InterpolationName::Linear => LayerMode::Linear,
        InterpolationName::SquaredLambda => LayerMode::SquaredLambda,
    };
    Ok(LoadedMeasured {
        measured: Arc::new(LayeredTable::new(cloud, mode)) as Arc<dyn Measured>,
        format,
        path: Default::default(),
        bytes: length,
        detail: Detail::Rows {
            rows: cloud.len(),
            negative_values: cloud.negatives().iter().sum(),
        },
        form: Form::Opaque,
    })
}

fn thin_plate(
    format: &'static Format,
    cloud: &SampleCloud,
    length: u64,
    negatives: NegativeName,
) -> Result<LoadedMeasured, Error> {
    let policies = Policies {
        negative: match negatives {
            NegativeName::Auto | NegativeName::Keep => NegativePolicy::Keep,
            NegativeName::Clamp => NegativePolicy::Clamp,
        },
        ..Policies::default()
    };
    let plate = ThinPlate::with_policies(cloud, policies)
        .map(Arc::new)
        .map_err(|e| Error::invalid(e.to_string()))?;
    Ok(LoadedMeasured {
        measured: Arc::clone(&plate) as Arc<dyn Measured>,
        format,
        path: Default::default(),
        bytes: length,
        detail: Detail::Scattered {
            rows: cloud.len(),
            fill: Box::new(plate.report()),
        },
        form: Form::ThinPlate(plate),
    })
}
