//! The fit of one material, and what is written of it.

use super::report::{Exported, Model, Report};
use super::{Fit as Arguments, Usage, pictures, progress};
use crate::args::Reading;
use crate::verbs::Context;
use anyhow::{Result, bail};
use brdf::{Brdf, Measured, Status};
use brdf_fit::export::exports;
use brdf_fit::{Family, Fit, FitData, Samples, fit_all};
use brdf_models::{ParsedModel, parse_model};
use scene_io::load::{MAX_FILE_BYTES, bytes};
use scene_io::material::{LoadedMeasured, Surface, load_measured};
use scene_io::scene::MaterialSpec;
use scene_io::sealed::content_hash;
use std::path::{Path, PathBuf};

/// Cells of the grid on which models and gridded files are compared: MERL's [Matusik2003].
const DIMS: [usize; 3] = [90, 90, 180];
/// Cells for files that are no grid, which have no finer detail than their few thousand rows.
const COARSE: [usize; 3] = [45, 45, 90];
/// Pairs on which exports choose the nearest material of a renderer.
const EXPORT_PAIRS: usize = 1 << 14;

/// What is fitted.
pub(super) enum Source {
    File(PathBuf, Reading),
    Model(ParsedModel<3>),
}

impl Source {
    /// A model if the text describes one and no such file exists, else a file.
    pub(super) fn of(context: &Context, text: &str, reading: Reading) -> Result<Self> {
        Ok(match MaterialSpec::from_argument(text) {
            MaterialSpec::Model(spec) => Self::Model(parse_model(&spec.model)?),
            _ => Self::File(
                context.places.data.find(text.as_ref(), "".as_ref())?,
                reading,
            ),
        })
    }

    pub(super) fn name(&self) -> String {
        match self {
            Self::File(path, _) => path.display().to_string(),
            Self::Model(model) => model.to_string(),
        }
    }

    /// Of the content and of everything asked, and of the program, whose fits may change.
    pub(super) fn key(&self, args: &Arguments, families: &[Box<dyn Family>]) -> Result<String> {
        let content = match self {
            Self::File(path, _) => content_hash(&bytes(path, MAX_FILE_BYTES)?),
            Self::Model(model) => content_hash(model.to_string().as_bytes()),
        };
        let names: Vec<&str> = families.iter().map(|f| f.name()).collect();
        let asked = format!(
            "{} {} {} {} {} {:?}",
            env!("CARGO_PKG_VERSION"),
            args.metric,
            args.lobes,
            args.cutoff,
            names.join(","),
            args.reading,
        );
        Ok(format!(
            "{content:016x}-{:016x}",
            content_hash(asked.as_bytes())
        ))
    }
}

/// A fitted material.
pub(super) struct Fitted {
    pub(super) report: Report,
    /// Best first.
    pub(super) fits: Vec<Fit>,
    pub(super) data: FitData,
}

pub(super) fn fit_source(
    context: &Context,
    source: &Source,
    args: &Arguments,
    families: &[Box<dyn Family>],
) -> Result<Fitted> {
    let samples = match source {
        Source::File(path, reading) => of_file(context, path, *reading)?,
        Source::Model(model) => Samples::on_grid(DIMS, 3, |wi, wo, out| {
            out.copy_from_slice(&model.built.brdf.eval(wi, wo));
            true
        }),
    };
    let samples = if args.cutoff < 90.0 {
        samples.within(args.cutoff)
    } else {
        samples
    };
    let data = FitData::new(samples, args.metric);
    let mut fits = Vec::new();
    let mut refused = None;
    for result in fit_all(families, &data, &progress(context)) {
        match result {
            Ok(fit) => fits.push(fit),
            Err(e) => refused = Some(e),
        }
    }
    fits.sort_by(|a, b| a.error.total_cmp(&b.error));
    if fits.is_empty() {
        match refused {
            Some(e) => bail!("{}: {e}", source.name()),
            None => return Err(Usage("expected at least one model".into()).into()),
        }
    }
    let report = Report {
        file: source.name(),
        metric: args.metric.to_string(),
        lobes: args.lobes,
        cutoff_deg: args.cutoff,
        samples: data.samples().len(),
        key: source.key(args, families)?,
        models: fits.iter().map(Model::of).collect(),
        written: Vec::new(),
        exports: Vec::new(),
    };
    Ok(Fitted { report, fits, data })
}

/// The measured cells of a grid, or the interpolant of scattered rows, in linear sRGB.
fn of_file(context: &Context, path: &Path, reading: Reading) -> Result<Samples> {
    let options = reading.options();
    let loaded = load_measured(path, &options)?;
    let surface = Surface::of_file(&loaded, &options, &context.places.cache)?;
    let brdf = surface.brdf();
    Ok(match dims(&loaded) {
        Some(dims) => {
            let channels = loaded.measured.basis().len();
            Samples::on_grid(dims, 3, |wi, wo, out| {
                out.copy_from_slice(&brdf.eval(wi, wo));
                loaded
                    .measured
                    .eval_native(wi, wo, &mut vec![0.0; channels])
                    != Status::Filled
            })
        }
        None => Samples::on_grid(COARSE, 3, |wi, wo, out| {
            out.copy_from_slice(&brdf.eval(wi, wo));
            true
        }),
    })
}

/// Half the circle stands for all of it, whatever the file stores.
fn dims(loaded: &LoadedMeasured) -> Option<[usize; 3]> {
    let [h, d, p] = loaded.table()?.dims();
    Some([h, d, p.min(DIMS[2])])
}

/// Pictures and exports of the best fit.
pub(super) fn write(
    context: &Context,
    source: &Source,
    args: &Arguments,
    fitted: &mut Fitted,
) -> Result<()> {
    let folder = &args.output;
    let Some(best) = fitted.fits.first() else {
        return Ok(());
    };
    let few = fitted.data.samples().subset(args.metric, EXPORT_PAIRS);
    // both families have two shapes a lobe
    let one_lobe = |name: &str| -> Result<Fit> {
        let mut done = fitted.fits.iter();
        match done.find(|f| f.name == name && f.shape.len() == 2) {
            Some(fit) => Ok(fit.clone()),
            None => {
                let data = FitData::new(few.clone(), args.metric);
                Ok(brdf_fit::fit(&*brdf_fit::family(name, 1)?, &data)?)
            }
        }
    };
    let (ggx, abg) = (one_lobe("ggx")?, one_lobe("abg")?);
    let mut written = Vec::new();
    for export in exports(best, (&ggx, &abg), &few)? {
        let path = folder.join(export.file);
        scene_io::write::bytes(&path, export.text.as_bytes())?;
        written.push(path);
        fitted.report.exports.push(Exported {
            target: export.target.into(),
            model: export.model,
            error: export.error,
        });
    }
    written.push(pictures::polar(context, source, &fitted.fits, folder)?);
    if !args.no_spheres {
        written.push(pictures::spheres(context, source, &fitted.fits, folder)?);
    }
    fitted.report.written = written;
    Ok(())
}

pub(super) fn write_json(path: &Path, report: &Report) -> Result<()> {
    let mut text = serde_json::to_string_pretty(report)?;
    text.push('\n');
    Ok(scene_io::write::bytes(path, text.as_bytes())?)
}
