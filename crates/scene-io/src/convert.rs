//! From one measured file to another format, and linear combinations: what `gonio convert` and `gonio mix` do.

use crate::error::{Error, ErrorKind};
use crate::material::{
    Detail, LoadedMeasured, MaterialOptions, load_measured, measured_from_bytes,
};
use crate::scene::ColourChoice;
use crate::{load, write};
use brdf::{Measured, Projected, Status};
use brdf_formats::{AstmFile, Channels, File, PbrtTextFile};
use brdf_measure::{Instrument, measure_astm};
use brdf_table::{Gridded, HalfDiffTable, Interpolation, PhiDomain, mix};
use sampling::{Rng, warp};
use spectrum::{Basis, RgbSpace};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What a conversion did.
#[derive(Clone, Debug, Default)]
pub struct Conversion {
    /// One line each: what the output cannot say that the input did.
    pub lost: Vec<String>,
    /// sqrt(sum (out - in)^2 / sum in^2) of luminance times both cosines, over random pairs of directions: the output read
    /// back and evaluated like any file. 0 when the content was copied.
    pub round_trip_error: f64,
}

/// Pairs of directions that the round trip is judged by.
const PAIRS: u32 = 20_000;
/// The grid of MERL's own files.
const MERL_DIMS: [usize; 3] = [90, 90, 180];
/// The same for materials that are not reciprocal.
const FULL_CIRCLE: [usize; 3] = [90, 90, 360];

/// Writes `input` as `output`, in the format that the extension of `output` stands for.
///
/// # Errors
/// Unreadable input, an extension without a writer, content the format has no place for.
pub fn convert(
    input: &Path,
    output: &Path,
    options: &MaterialOptions,
) -> Result<Conversion, Error> {
    let target = output_format(output)?;
    let loaded = load_measured(input, options)?;
    if target == loaded.format.name && options.colour == ColourChoice::default() {
        write::bytes(output, &load::bytes(input, load::MAX_FILE_BYTES)?)?;
        return Ok(Conversion::default());
    }
    let mut lost = Vec::new();
    let bytes = match target {
        "merl" => {
            let table = linear_srgb_table(&loaded, &mut lost)?;
            to_merl(&table, &mut lost)?
        }
        "astm" => to_astm(&loaded, &mut lost)?,
        _ => to_pbrt_text(&loaded, &mut lost)?,
    };
    let again = measured_from_bytes(&bytes, &MaterialOptions::default())?;
    let round_trip_error = difference(&*loaded.measured, &*again.measured);
    write::bytes(output, &bytes)?;
    Ok(Conversion {
        lost,
        round_trip_error,
    })
}

/// Writes the weighted sum of `parts` as a MERL file.
///
/// # Errors
/// Unreadable inputs, an output that is not a MERL file, weights that are not finite.
pub fn mix_files(
    parts: &[(&Path, f64)],
    output: &Path,
    options: &MaterialOptions,
) -> Result<Conversion, Error> {
    if output_format(output)? != "merl" {
        return Err(Error::unsupported(
            "expected an output ending in .binary: mixtures are written on the MERL grid",
        )
        .in_file(output));
    }
    let (mut tables, mut lost) = (Vec::new(), Vec::new());
    for (path, weight) in parts {
        let table = linear_srgb_table(&load_measured(path, options)?, &mut lost)?;
        tables.push((table, *weight));
    }
    if tables
        .iter()
        .any(|(t, _)| t.phi_domain() == PhiDomain::Full)
    {
        // one part that is not reciprocal makes the sum so
        for (table, _) in &mut tables {
            *table = Arc::new(table.resample(FULL_CIRCLE, PhiDomain::Full, Interpolation::Linear));
        }
    }
    let borrowed: Vec<(&HalfDiffTable, f64)> = tables.iter().map(|(t, w)| (&**t, *w)).collect();
    let mixed = mix(&borrowed).map_err(|e| Error::invalid(e.to_string()))?;
    let bytes = to_merl(&mixed, &mut lost)?;
    let again = measured_from_bytes(&bytes, &MaterialOptions::default())?;
    let mixed = Gridded {
        table: Arc::new(mixed),
        interpolation: Interpolation::Linear,
    };
    let round_trip_error = difference(&mixed, &*again.measured);
    write::bytes(output, &bytes)?;
    Ok(Conversion {
        lost,
        round_trip_error,
    })
}

/// The name of the format that the extension of an output stands for.
///
/// # Errors
/// If nothing that can be written has this extension.
pub fn output_format(output: &Path) -> Result<&'static str, Error> {
    let extension = output
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default();
    let known = brdf_formats::FORMATS.iter().filter(|f| f.writer.is_some());
    let found = known.clone().find(|f| f.extensions.contains(&extension));
    found.map(|f| f.name).ok_or_else(|| {
        let endings: Vec<String> = known
            .flat_map(|f| f.extensions)
            .map(|e| format!(".{e}"))
            .collect();
        Error::unsupported(format!(
            "expected an output ending in {}, found {extension:?}",
            endings.join(", ")
        ))
        .in_file(output)
    })
}

/// The material on MERL's grid in linear sRGB: its own table if it is one, else sampled at the cells' centres.
///
/// Materials that are not reciprocal need the full circle of `phi_d`: twice the cells.
///
/// Values that a policy filled are kept, and counted in `lost`: the format cannot tell them from measured ones.
fn linear_srgb_table(
    loaded: &LoadedMeasured,
    lost: &mut Vec<String>,
) -> Result<Arc<HalfDiffTable>, Error> {
    let srgb = Basis::Rgb(RgbSpace::srgb());
    if let Some(table) = loaded.table().filter(|t| *t.basis() == srgb) {
        return Ok(Arc::clone(table));
    }
    let matrix = loaded.measured.basis().to_linear_srgb();
    let rows = matches!(
        loaded.detail,
        Detail::Scattered { .. } | Detail::Rows { .. }
    );
    let (dims, phi) = match loaded.measured.symmetry().reciprocal {
        true => (MERL_DIMS, PhiDomain::Reciprocal),
        // rows cover half of the circle and are mirrored: there is no more to evaluate
        false if rows => (MERL_DIMS, PhiDomain::Mirror),
        false => (FULL_CIRCLE, PhiDomain::Full),
    };
    let filled = AtomicUsize::new(0);
    let table = HalfDiffTable::from_fn(dims, phi, srgb, |wi, wo, out| {
        let mut native = vec![0.0; matrix.len()];
        if loaded.measured.eval_native(wi, wo, &mut native) == Status::Filled {
            filled.fetch_add(1, Ordering::Relaxed);
        }
        for (value, row) in native.iter().zip(&matrix) {
            (0..3).for_each(|c| out[c] += value * row[c]);
        }
        Status::Interpolated
    });
    let filled = filled.into_inner() * if phi == PhiDomain::Mirror { 2 } else { 1 };
    if filled > 0 {
        lost.push(format!(
            "{filled} values lie where nothing was measured and were filled: the file cannot say which"
        ));
    }
    Ok(Arc::new(match phi {
        // the centres of its cells are centres of the half circle's: nothing is interpolated
        PhiDomain::Mirror => table.resample(FULL_CIRCLE, PhiDomain::Full, Interpolation::Nearest),
        _ => table,
    }))
}

fn linear_srgb(loaded: &LoadedMeasured) -> Result<Projected<Arc<dyn Measured>, 3>, Error> {
    let matrix = loaded.measured.basis().to_linear_srgb();
    Projected::new(Arc::clone(&loaded.measured), matrix)
        .ok_or_else(|| Error::invalid("expected as many channels as the basis has"))
}

fn to_merl(table: &HalfDiffTable, lost: &mut Vec<String>) -> Result<Vec<u8>, Error> {
    let (file, loss) = table.to_merl().map_err(|e| Error::invalid(e.to_string()))?;
    if loss.filled_cells > 0 {
        lost.push(format!(
            "{} cells were not measured: written as -1",
            loss.filled_cells
        ));
    }
    if loss.negative_channels > 0 {
        lost.push(format!(
            "{} negative values: most readers take them for \"not measured\"",
            loss.negative_channels
        ));
    }
    if table.dims()[2] > MERL_DIMS[2] {
        lost.push(
            "not reciprocal: 360 azimuths are written, which readers of exactly 90x90x180 refuse"
                .into(),
        );
    }
    if let Some(name) = loss.primaries {
        lost.push(format!(
            "the primaries ({name}): the format has no place for them"
        ));
    }
    Ok(file.into_bytes())
}

/// Rows stay rows; anything else is sampled in Cornell's directions.
fn to_astm(loaded: &LoadedMeasured, lost: &mut Vec<String>) -> Result<Vec<u8>, Error> {
    let bytes = load::bytes(&loaded.path, load::MAX_FILE_BYTES)?;
    if let File::PbrtText(text) =
        brdf_formats::read(bytes).map_err(|e| Error::invalid(e.to_string()))?
    {
        lost.push("the comments: the header has no place for them".into());
        let fields = [
            ("SAMPLE_NAME", "converted from pbrt-v2 text"),
            ("SAMPLE_TYPE", "isotropic"),
        ];
        let rows = scaled(text.rows(), &loaded.colour.scale);
        let bands = Channels::Wavelengths(text.wavelengths_nm().to_vec());
        let file = AstmFile::new(&fields, bands, rows);
        return Ok(file.map_err(|e| Error::invalid(e.to_string()))?.to_bytes());
    }
    lost.push("everything between Cornell's directions (1489 rows) and beyond 80 degrees".into());
    if !matches!(loaded.measured.basis(), Basis::Rgb(_)) {
        lost.push("the spectrum: linear sRGB was written as RGB".into());
    }
    let basis = Basis::Rgb(RgbSpace::trinitron());
    let name = loaded
        .path
        .file_stem()
        .map(|s| s.to_string_lossy().into_owned())
        .unwrap_or_default();
    let file = measure_astm(
        &linear_srgb(loaded)?,
        &basis,
        &name,
        &Instrument::default(),
        0,
    );
    Ok(file.map_err(|e| Error::invalid(e.to_string()))?.to_bytes())
}

fn to_pbrt_text(loaded: &LoadedMeasured, lost: &mut Vec<String>) -> Result<Vec<u8>, Error> {
    let bytes = load::bytes(&loaded.path, load::MAX_FILE_BYTES)?;
    let file = brdf_formats::read(bytes).map_err(|e| Error::invalid(e.to_string()))?;
    let (File::Astm(astm), Basis::Bands(nm)) = (&file, loaded.measured.basis()) else {
        let found = loaded.measured.basis().names().join(",");
        let message = format!(
            "expected rows of spectra for pbrt-v2 text, found {} ({})",
            loaded.format.title,
            found.chars().take(40).collect::<String>()
        );
        return Err(Error::new(ErrorKind::Unsupported, message).in_file(&loaded.path));
    };
    lost.push("the header: pbrt-v2 text has comments only".into());
    let comments = [" converted from ASTM E1392"];
    let rows = scaled(astm.rows(), &loaded.colour.scale);
    let text = PbrtTextFile::new(&comments, nm.clone(), rows);
    Ok(text.map_err(|e| Error::invalid(e.to_string()))?.to_bytes())
}

/// Rows of four angles and a value a channel, the values times `factors`.
fn scaled(rows: &[f64], factors: &[f64]) -> Vec<f64> {
    let mut rows = rows.to_vec();
    for row in rows.chunks_exact_mut(4 + factors.len()) {
        row[4..].iter_mut().zip(factors).for_each(|(v, f)| *v *= f);
    }
    rows
}

/// Relative RMS difference of luminance times both cosines, over cosine-distributed pairs of directions.
fn difference(a: &dyn Measured, b: &dyn Measured) -> f64 {
    let luminance = |m: &dyn Measured| {
        let weights = m.basis().luminance_weights();
        move |m: &dyn Measured, wi, wo, buffer: &mut Vec<f64>| -> f64 {
            buffer.resize(weights.len(), 0.0);
            m.eval_native(wi, wo, buffer);
            buffer.iter().zip(&weights).map(|(v, w)| v * w).sum()
        }
    };
    let (of_a, of_b) = (luminance(a), luminance(b));
    let (mut buffer, mut rng) = (Vec::new(), Rng::new(0));
    let (mut error, mut size) = (0.0, 0.0);
    for _ in 0..PAIRS {
        let (wi, wo) = (
            warp::cosine_hemisphere(rng.uniform2()),
            warp::cosine_hemisphere(rng.uniform2()),
        );
        let (x, y) = (of_a(a, wi, wo, &mut buffer), of_b(b, wi, wo, &mut buffer));
        error += (y - x) * (y - x);
        size += x * x;
    }
    if size > 0.0 {
        (error / size).sqrt()
    } else {
        error.sqrt()
    }
}
