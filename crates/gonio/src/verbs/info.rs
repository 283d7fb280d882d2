//! `gonio info FILE`: what a file is and holds.

use super::Context;
use super::eval::Channels;
use crate::args::Info;
use anyhow::Result;
use brdf_formats::File;
use scene_io::material::{Detail, Identity, identify};
use serde::Serialize;
use spectrum::Basis;
use std::fmt::{self, Write};
use std::path::Path;

#[derive(Serialize)]
struct Report {
    file: String,
    format: &'static str,
    title: &'static str,
    dims: Vec<usize>,
    #[serde(flatten)]
    channels: Channels,
    /// Who says what the channels are: `file`, `convention` or `user`.
    channels_from: &'static str,
    primaries: Option<[[f64; 2]; 3]>,
    primaries_name: Option<String>,
    white: Option<[f64; 2]>,
    white_from: Option<&'static str>,
    /// Factor from file values to f_r, per channel.
    scale: Vec<f64>,
    scale_from: &'static str,
    valid_fraction: f64,
    negatives: Vec<usize>,
    bytes: u64,
    header: Vec<(String, String)>,
    reciprocal: bool,
    /// Names for `--interpolation`, the default first.
    interpolations: &'static [&'static str],
    docs: &'static str,
}

pub(crate) fn run(context: &Context, args: &Info) -> Result<()> {
    let path = context.places.data.find(&args.file, Path::new(""))?;
    let report = describe(&identify(&path, &args.colour.choice())?)?;
    context.report(&report, |out| print(&report, out))
}

fn describe(file: &Identity) -> Result<Report> {
    let basis = &file.basis;
    let space = match basis {
        Basis::Rgb(space) => Some(space.clone()),
        _ => None,
    };
    let content = content(file)?;
    Ok(Report {
        file: file.path.display().to_string(),
        format: file.format.name,
        title: file.format.title,
        dims: content.dims,
        channels: Channels::of(basis),
        channels_from: file.colour.channels_from.name(),
        primaries: space.as_ref().map(|s| s.primaries),
        primaries_name: space.as_ref().map(|s| s.name.clone()),
        white: space.as_ref().map(|s| s.white),
        white_from: space.map(|_| file.colour.white_from.name()),
        scale: file.colour.scale.clone(),
        scale_from: file.colour.scale_from.name(),
        valid_fraction: content.valid_fraction,
        negatives: content.negatives,
        bytes: file.bytes,
        header: content.header,
        reciprocal: file.reciprocal,
        interpolations: interpolations(file),
        docs: file.format.docs,
    })
}

/// What `--interpolation` may say for such a file, the default first.
fn interpolations(file: &Identity) -> &'static [&'static str] {
    match file.detail {
        Detail::Grid { .. } => &["linear", "nearest"],
        Detail::Scattered { .. } | Detail::Rows { .. } => &[
            "thin-plate",
            "linear",
            "layered-log",
            "squared-lambda",
            "nearest",
            "kd-nearest",
        ],
        _ => &["linear"],
    }
}

/// What only the file itself can tell.
struct Content {
    dims: Vec<usize>,
    valid_fraction: f64,
    negatives: Vec<usize>,
    header: Vec<(String, String)>,
}

fn content(file: &Identity) -> Result<Content> {
    if let Detail::Grid { dims, cells } = &file.detail {
        let negative = cells.all_negative + cells.partly_negative;
        return Ok(Content {
            dims: dims.to_vec(),
            valid_fraction: cells.measured as f64 / cells.cells.max(1) as f64,
            negatives: vec![negative],
            header: vec![(
                "not measured".into(),
                format!("{} cells", cells.cells - cells.measured),
            )],
        });
    }
    let bytes = scene_io::load::bytes(&file.path, scene_io::load::MAX_FILE_BYTES)?;
    let rows = |count: usize, width: usize, values: &mut dyn Iterator<Item = &[f64]>| {
        let mut negatives = vec![0; width];
        for row in values {
            for (n, v) in negatives.iter_mut().zip(row) {
                *n += usize::from(*v < 0.0);
            }
        }
        (vec![count], negatives)
    };
    let (dims, negatives, header) = match brdf_formats::read(bytes)? {
        File::Astm(f) => {
            let (dims, negatives) = rows(
                f.row_count(),
                f.value_columns().len(),
                &mut (0..f.row_count()).map(|r| f.values(r)),
            );
            (dims, negatives, f.fields().collect())
        }
        File::PbrtText(f) => {
            let (dims, negatives) = rows(
                f.row_count(),
                f.wavelengths_nm().len(),
                &mut (0..f.row_count()).map(|r| f.values(r)),
            );
            (
                dims,
                negatives,
                f.comments().map(|c| ("comment".to_owned(), c)).collect(),
            )
        }
        File::Rgl(f) => {
            let view = f.view()?;
            (
                view.values.shape.clone(),
                vec![view.values.data.iter().filter(|v| **v < 0.0).count()],
                vec![("description".into(), view.description)],
            )
        }
        _ => (Vec::new(), Vec::new(), Vec::new()),
    };
    Ok(Content {
        dims,
        valid_fraction: 1.0,
        negatives,
        header,
    })
}

fn print(r: &Report, out: &mut String) -> fmt::Result {
    writeln!(out, "{}", r.file)?;
    writeln!(out, "  format     {} ({})", r.title, r.docs)?;
    writeln!(out, "  size       {} bytes, dims {:?}", r.bytes, r.dims)?;
    match &r.channels {
        Channels::Channels(names) => writeln!(out, "  channels   {}", names.join(", "))?,
        Channels::WavelengthsNm(nm) => {
            writeln!(
                out,
                "  channels   {} bands, {} to {} nm ({})",
                nm.len(),
                nm.first().unwrap_or(&0.0),
                nm.last().unwrap_or(&0.0),
                r.channels_from
            )?;
        }
    }
    if let (Some(name), Some(p), Some(w)) = (&r.primaries_name, &r.primaries, &r.white) {
        writeln!(
            out,
            "  primaries  {name}: R {:?} G {:?} B {:?} ({})",
            p[0], p[1], p[2], r.channels_from
        )?;
        let from = r.white_from.unwrap_or_default();
        writeln!(out, "  white      {w:?} ({from})")?;
    }
    let scale: Vec<String> = if r.scale.len() > 3 {
        // one factor for all bands
        r.scale.iter().take(1).map(|s| format!("{s:.6}")).collect()
    } else {
        r.scale.iter().map(|s| format!("{s:.6}")).collect()
    };
    let (scale, from) = (scale.join(", "), r.scale_from);
    writeln!(out, "  scale      {scale} from numbers to f_r ({from})")?;
    writeln!(
        out,
        "  valid      {:.2} % of the entries",
        100.0 * r.valid_fraction
    )?;
    writeln!(out, "  negatives  {:?}", r.negatives)?;
    writeln!(
        out,
        "  reciprocal {}",
        if r.reciprocal {
            "by its layout"
        } else {
            "not guaranteed: rendered as measured"
        }
    )?;
    writeln!(out, "  between    {}", r.interpolations.join(", "))?;
    for (key, value) in &r.header {
        writeln!(out, "  {key}: {value}")?;
    }
    Ok(())
}
